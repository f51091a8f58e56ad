"""The simulator: forces at the contact points of a hidden rig, and its motion in tiny fixed steps."""
