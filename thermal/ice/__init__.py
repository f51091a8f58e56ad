"""The block of ice: a cylinder or a sample of any shape, as eigenmodes, and what melts off it."""
