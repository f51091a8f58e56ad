"""Commands of studies: many runs, a map, a verdict."""
