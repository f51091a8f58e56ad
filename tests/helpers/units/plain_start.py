"""The plain model as start values of a mechanical unit, which starts as a rig that can be built."""

from stickslip import Parameters

from cosim.scenario.defaults import stated

#: Name -> value: no pretension, no run-up, friction along x alone, no damping.
PLAIN = {name: Parameters().flat()[name] for name in stated()}
