"""From where a rig is started to find the steady motions that it has.

Dry friction lets several steady motions exist side by side, and the start decides between them.
Where kinetic friction does not depend on speed, a block that slides evenly at the place where its
springs balance friction goes on to do so: that motion always exists, and runs from rest or from a
ramp may never come near it.
"""

from dataclasses import replace
from math import pi

from ..arrays import STATE
from ..packing import GRAVITY
from ..parameters import Parameters
from .live import DRY, Interface, RunEnded, Work, simulated

OWN, DISTURBED, REST, RIDING, BALANCED = "own", "disturbed", "rest", "riding", "balanced"
RAMP, SHORT_RAMP, LONG_RAMP, TURNED = "ramp", "short_ramp", "long_ramp", "turned"
#: How each start is told. All but the scenario's own are a little aside and turned.
STARTS = {
    OWN: "as the scenario starts",
    DISTURBED: "as the scenario starts, but 0.1 mm aside and turned by 1 mrad",
    REST: "from rest on a surface at full speed",
    RIDING: "riding on a surface at full speed",
    RAMP: "on a surface that runs up to its speed",
    SHORT_RAMP: "on a surface that runs up in a third of the time",
    LONG_RAMP: "on a surface that runs up in three times the time",
    BALANCED: "at rest where the springs balance the friction of sliding",
    TURNED: "from rest, 10 mm aside and turned by 20 degrees",
}
#: Of the disturbed starts, m and rad, and of the one that is far aside.
ASIDE, TURN = 1e-4, 1e-3
FAR_ASIDE, FAR_TURN = 0.01, 0.35
#: Speed ramp where the scenario has none, s, and the other ramps as parts of it.
RAMP_TIME = 10.0
SHORTER, LONGER = 1.0 / 3.0, 3.0
#: Times of the slowest relaxation after which a place is found to a millionth.
RELAXATIONS = 15.0


def other_starts(parameters: Parameters) -> dict[str, Parameters]:
    """The same rig from the `STARTS` that need no computing, not yet disturbed."""
    surface, initial = parameters.surface, parameters.initial
    ramp = surface.run_up_time or RAMP_TIME
    curvature = parameters.turning_surface.curvature
    if parameters.rig.surface == "slab":
        curvature = 1.0 / parameters.rig.slab_radius
    still = {"x": 0.0, "vx": 0.0, "vy": 0.0, "omega": 0.0}
    carried = still | {"vx": surface.speed, "omega": surface.speed * curvature}
    far = still | {"y": initial.y + FAR_ASIDE, "phi": initial.phi + FAR_TURN}
    return {
        DISTURBED: parameters,
        REST: started(parameters, still, 0.0),
        RIDING: started(parameters, carried, 0.0),
        RAMP: started(parameters, still, ramp),
        SHORT_RAMP: started(parameters, still, SHORTER * ramp),
        LONG_RAMP: started(parameters, still, LONGER * ramp),
        TURNED: started(parameters, far, 0.0),
    }


def disturbed(parameters: Parameters) -> Parameters:
    """The same rig from the same start, but a little aside and turned, as every rig is."""
    initial = parameters.initial
    return started(parameters, {"y": initial.y + ASIDE, "phi": initial.phi + TURN})


def started(
    parameters: Parameters, state: dict[str, float], run_up_time: float | None = None
) -> Parameters:
    """The same rig from another state, less what is guided, and with another ramp, s."""
    guided = {"y", "phi"} - set(parameters.rig.degrees_of_freedom)
    state = {name: value for name, value in state.items() if name not in guided}
    if run_up_time is not None:
        parameters = parameters.with_values("surface", run_up_time=run_up_time)
    return parameters.with_values("initial", **state)


def balanced(parameters: Parameters, interface: Interface = DRY) -> Parameters:
    """The same rig at rest where springs and friction balance.

    Found by a run with so much damping that the block creeps there, slower than the surface.
    RunEnded where it cannot.
    """
    rig, speed = parameters.rig, abs(parameters.surface.speed)
    if speed == 0.0 or parameters.natural_frequency == 0.0:
        raise RunEnded("nothing slides without a surface that moves, and springs")
    force = max(parameters.friction.mu_s, parameters.friction.mu_k) * rig.mass * GRAVITY
    rate = 2.0 * pi * parameters.natural_frequency
    coefficient = max(2.0 * rig.mass * rate, 4.0 * force / speed)
    relaxation = coefficient / (rig.mass * rate**2)
    still = started(parameters, dict.fromkeys(STATE, 0.0), 0.0)
    damped = still.with_values("structural_damping", coefficient=coefficient)
    uncounted = replace(interface, work=Work())
    run = simulated(damped, RELAXATIONS * relaxation, relaxation, uncounted)
    place = {name: float(run[name][-1]) for name in ("x", "y", "phi")}
    return started(parameters, dict.fromkeys(STATE, 0.0) | place, 0.0)
