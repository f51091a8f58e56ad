"""How the units are made, and made again when what they are made of has changed."""
