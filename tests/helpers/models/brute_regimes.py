"""Every regime of a rig by force: long runs of one length from many starts, of all kinds."""

import numpy as np
from stickslip import Parameters
from stickslip.steady_motion import RunEnded
from stickslip.steady_motion.regimes import regime_of
from stickslip.steady_motion.starts import OWN, started

GRAVITY = 9.81


def drawn_rig(draw):
    """A rig at random: a tenth without pretension, a fifth undamped, slow enough to stick."""
    mu_k = draw.uniform(0.03, 0.3)
    mass, stiffness = draw.uniform(0.4, 2.2), draw.uniform(18.0, 75.0)
    rate = np.sqrt(4.0 * stiffness / mass)
    speed = draw.uniform(0.1, 1.4) * mu_k * GRAVITY / rate
    pretension = draw.choice([0.0, draw.uniform(0.0, 0.04)], p=[0.1, 0.9])
    damping = draw.choice([0.0, draw.uniform(0.0, 0.01)], p=[0.2, 0.8])
    return Parameters(
        rig=dict(mass=mass, spring_length=0.2, spring_natural_length=0.2 - pretension),
        springs=dict(stiffness=stiffness),
        friction=dict(mu_s=mu_k * draw.uniform(1.05, 1.7), mu_k=mu_k),
        lateral_friction=dict(ratio=1.0),
        structural_damping=dict(coefficient=2.0 * mass * rate * damping, rotational=1e-4),
        surface=dict(speed=speed, run_up_time=draw.choice([0.0, 3.0, 10.0])),
    )


def drawn_starts(parameters, draw, count):
    """In turn: carried by the surface, sliding about its place, at rest with and without a ramp.

    Half of them are as straight as a rig can be made, half are 5 mm aside and turned by 9 degrees.
    """
    load, stiffness = parameters.rig.mass * GRAVITY, 4.0 * parameters.springs.stiffness
    slides, holds = (
        mu * load / stiffness for mu in (parameters.friction.mu_k, parameters.friction.mu_s)
    )
    speed, rate = parameters.surface.speed, np.sqrt(stiffness / parameters.rig.mass)
    for i in range(count):
        kind, straight, ramp = i // 2 % 3, i % 2 == 0, 0.0
        state = {"x": draw.uniform(-slides, holds), "vx": 0.0}
        if kind == 0:
            state["vx"] = speed
        elif kind == 1:
            swing, phase = draw.uniform(0.0, 1.5) * speed, draw.uniform(0.0, 2.0 * np.pi)
            state["x"] = slides + swing / rate * np.cos(phase)
            state["vx"] = min(-swing * np.sin(phase), speed)
        else:
            ramp = float(draw.choice([0.0, draw.uniform(0.5, 40.0)]))
        state["y"] = draw.normal() * (1e-4 if straight else 5e-3)
        state["phi"] = draw.normal() * (1e-3 if straight else 0.15)
        yield started(parameters, state, ramp)


def by_force(parameters, draw, steady, count):
    """Distinct regimes of those starts, and all runs: some have come to none by their end."""
    distinct, runs = [], []
    for start in drawn_starts(parameters, draw, count):
        try:
            found = regime_of(start, steady + start.surface.run_up_time)
        except RunEnded:
            continue
        runs.append(found)
        if found.repeats and not any(found.is_as(known) for known in distinct):
            distinct.append(found)
    return distinct, runs


def searched(found):
    """The distinct regimes of `regimes` that a rig can keep to: not its undisturbed own run."""
    distinct = []
    for start, regime in found.items():
        known = any(regime.is_as(other) for other in distinct)
        if start != OWN and regime.repeats and not known:
            distinct.append(regime)
    return distinct


def missed(these, those):
    """Of ``these`` regimes, the ones that are not among ``those``."""
    return [one for one in these if not any(one.is_as(other) for other in those)]
