"""What a camera writes of a motion, and what can be wrong with it: the observation model.

A misfit may come from the camera and not from the physics. Its faults are numbers like those of
the model, fitted in the same way, and never part of the model: a fault is no effect of a rig.
"""
