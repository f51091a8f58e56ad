"""The simulator: forces on a hidden rig, and its motion in tiny fixed steps."""
