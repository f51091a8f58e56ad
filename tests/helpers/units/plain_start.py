"""The plain model as start values of a mechanical unit, which starts as a rig that can be built."""

from stickslip import Parameters

from cosim.scenario.defaults import stated

#: Name -> value: no pretension, no run-up, friction along x alone, no damping.
PLAIN = {name: Parameters().flat()[name] for name in stated()}


def values(tables):
    """Start values of the block's unit, by the names of FMI 2, of a model with these tables."""
    parameters = Parameters(**tables)
    return {**parameters.flat(), "surface_speed": parameters.surface.speed}
