"""The contact of ice and belt: its footprint, the heat that crosses it, the water in and off it."""
