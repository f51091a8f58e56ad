"""Commands that make what others use: units for other tools."""
