"""The rig about the block: the springs that hold it, the surface that carries it."""
