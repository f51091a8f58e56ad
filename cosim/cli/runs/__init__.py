"""Commands of one run: coupled, mechanics alone, any system of units."""
