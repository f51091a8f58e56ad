"""Co-simulation masters side by side on a pair of small units."""
