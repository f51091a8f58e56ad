"""What the gap workflow says of campaigns whose answers are known, counted and drawn."""
