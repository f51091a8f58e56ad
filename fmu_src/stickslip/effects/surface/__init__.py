"""Effects of how the surface moves."""
