"""The belt: its layers, the air along it, its supports, and its temperature in either frame.

`material_frame` holds the field in the belt's own coordinate, for the motion of a coupled run;
`rig_frame` as a Fourier series seen from the ice, for steady sliding in long steps.
"""
