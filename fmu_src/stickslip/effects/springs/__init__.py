"""Effects of springs and guides."""
