"""Friction outside the kernel: what may be said of it, and the law that comes of all of it."""
