"""Heat in belt and ice."""
