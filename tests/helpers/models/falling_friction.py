"""Rigs whose friction falls with speed, steeply too, and whether disturbances of theirs grow."""

import numpy as np
from stickslip import Parameters, simulate
from stickslip.steady_motion import stability
from stickslip.steady_motion.stability import GRAZING, UNSTABLE

GRAVITY = 9.81
#: Disturbances, rad; cycles that are followed, and how near 1 a multiplier says nothing in those.
TURNS, CYCLES, MARGIN = (1e-6, 1e-5, 1e-4), 60, 0.02
#: From there on a motion has left its line, m.
LEFT = 2e-3


def drawn_rig(draw):
    """A rig at random, drawn as it is: without imperfections and on its line."""
    mu_k = draw.uniform(0.1, 0.3)
    mass, stiffness = draw.uniform(0.4, 2.2), draw.uniform(18.0, 75.0)
    rate = np.sqrt(4.0 * stiffness / mass)
    speed = draw.uniform(0.2, 1.2) * mu_k * GRAVITY / rate
    friction, law = {"mu_s": mu_k * draw.uniform(1.05, 1.6), "mu_k": mu_k}, {}
    kind = draw.integers(5)
    if kind == 0:
        friction["transition_speed"] = speed * 10.0 ** draw.uniform(-3.0, -1.0)
    elif kind == 1:
        law = {"linear": draw.uniform(0.05, 0.4) / speed}
    elif kind == 2:
        law = {"hyperbolic": draw.uniform(0.5, 5.0) / speed}
    elif kind == 3:
        law = {"stribeck": draw.uniform(0.1, 1.0)}
        law["stribeck_speed"] = speed * 10.0 ** draw.uniform(-2.0, 0.0)
    else:
        law = {"power": draw.uniform(0.2, 2.0), "exponent": draw.uniform(0.4, 2.0)}
        law["power_speed"] = speed * draw.uniform(0.05, 1.0)
    return Parameters(
        rig=dict(mass=mass, spring_natural_length=0.2 - draw.uniform(0.0, 0.03)),
        springs=dict(stiffness=stiffness), friction=dict(**friction),
        velocity_weakening=dict(**law), lateral_friction=dict(ratio=1.0),
        structural_damping=dict(coefficient=2.0 * mass * rate * draw.uniform(0.0, 0.01)),
        surface=dict(speed=speed, run_up_time=5.0),
    )  # fmt: skip


def grows(parameters, turn, begin, period):
    """Does a run that starts turned leave its line, or go further from it from cycle to cycle?

    Seen over `CYCLES` after the time ``begin`` (s), by its largest distance in tenths of them.
    """
    initial = parameters.initial.model_copy(update={"phi": turn})
    end = begin + CYCLES * period
    run = simulate(parameters.model_copy(update={"initial": initial}), end, 0.05 * period)
    if not run.complete:
        return True
    far = np.hypot(run["y"], parameters.rig.contact_radius * run["phi"])
    edges = np.linspace(begin, end, 11)
    tenths = [
        far[(run.time >= low) & (run.time <= high)].max()
        for low, high in zip(edges[:-1], edges[1:], strict=True)
    ]
    return max(tenths) > LEFT or (tenths[-1] > tenths[2] and tenths[-1] > 1e-12)


def compared(parameters):
    """``found``, and whether each disturbance grows; None where the multiplier is too near 1.

    A ramp in which disturbances grow a hundredfold decides by itself what a run from it shows.
    """
    found = stability(parameters)
    if found.verdict == GRAZING:
        return found, None
    near = any(abs(growth - 1.0) < MARGIN for growth in (found.growth, *found.others))
    if near or found.amplification > 100.0:
        return None
    return found, [grows(parameters, turn, 10.0, found.period) for turn in TURNS]


def agrees(found, grown):
    """Do the disturbed runs do what the multipliers say? True of what is not judged."""
    return grown is None or set(grown) == {found.verdict == UNSTABLE}
