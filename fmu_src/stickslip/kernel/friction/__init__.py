"""The law of friction: its coefficients, the integral over the disc, force and moment."""
