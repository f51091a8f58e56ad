"""Kinds that no catalogue holds, to develop on: they should be named as nothing that is in one.

Each kind is a draw of its numbers (`other` in the record, the size of it first) and a branch of
`out_of_catalogue`, which advances the kind's own states by a step and says what it does: a push,
N; factors of load, spring force and friction; and what it adds to the belt's speed, m/s.
"""

from __future__ import annotations

from math import exp, pi, sin, tanh

import numpy as np
from numba import njit

from .apparatus import GRAVITY, Record
from .friction_law import OTHER
from .laws import Named, Reference

GUIDES, SLACK, LOOSE, LIFT, SOFT_BELT, THUMPS, BELT_DRIFT, ROCKING = range(1, 9)
KINDS = Named()


@njit
def out_of_catalogue(p, slow, t, h, s, friction):
    """Push, factors of load, spring and friction, and extra belt speed of the kind in a record."""
    push, load, spring, mu, extra = 0.0, 1.0, 1.0, 1.0, 0.0
    weight = p.mass * GRAVITY
    size = p.other[0]
    if p.other_form == GUIDES:  # size: share of the weight
        push = -size * weight * tanh(s[3] / 2e-3)
    elif p.other_form == LOOSE:  # size: mass over the block's; numbers: rad/s, damping ratio
        jerk = s[3] - slow[OTHER + 2]
        slow[OTHER + 2] = s[3]
        slow[OTHER + 1] -= jerk + h * (
            p.other[1] ** 2 * slow[OTHER] + 2 * p.other[2] * p.other[1] * slow[OTHER + 1]
        )
        slow[OTHER] += h * slow[OTHER + 1]
        push = (size * p.mass) * (
            p.other[1] ** 2 * slow[OTHER] + 2 * p.other[2] * p.other[1] * slow[OTHER + 1]
        )
        load = 1.0 + size
    elif p.other_form == LIFT:  # size: share of the weight taken off at 1 cm; number: m/s for it
        load = 1.0 - size * s[0] / 0.01 - size * s[3] / p.other[1]
        load = min(max(load, 0.2), 1.8)
    elif p.other_form == SOFT_BELT:  # size: give of the belt, m, under the weight; number: s
        give = size * friction / weight
        rate = (give - slow[OTHER]) / p.other[1]
        slow[OTHER] += h * rate
        extra = -rate
    elif p.other_form == THUMPS:  # size: m/s each gives; numbers: a second, s long
        count = np.floor(t * p.other[1] + p.phase)
        # irregular: each falls somewhere in its own interval and has a size and sign of its own
        draw = np.sin(12.9898 * (count + 1.0) + 78.233 * p.phase) * 43758.5453
        draw -= np.floor(draw)
        centre = (count + 0.15 + 0.7 * draw - p.phase) / p.other[1]
        d = (t - centre) / p.other[2]
        push = p.mass * size * (2 * draw - 1) * exp(-d * d) / (p.other[2] * pi**0.5)
    elif p.other_form == BELT_DRIFT:  # size: share of the speed over the run; number: s
        extra = p.belt_speed * size * (t / p.other[1] - 0.5)
    elif p.other_form == ROCKING:  # size: slope; number: Hz
        push = weight * size * sin(2 * pi * (p.other[1] * t + p.phase))
    return push, load, spring, mu, extra


@KINDS.of(GUIDES)
def guide_friction(size: float, rng: np.random.Generator, r: Reference):
    """Dry friction between the block and what guides it, in the frame."""
    return (0.03 * size,)


@KINDS.add
def slack_springs(p: Record, size: float, rng: np.random.Generator, r: Reference) -> None:
    """Cords for springs: they pull, and give way instead of pushing."""
    p["slack"] = min(size, 1.0)


@KINDS.add
def loose_mass(p: Record, size: float, rng: np.random.Generator, r: Reference) -> None:
    """Something sprung inside the block, weighed with it: 3 to 7 Hz, lightly damped."""
    share = min(0.15 * size, 0.5)
    p["other_form"] = LOOSE
    p["mass"] /= 1 + share
    p["inverse_mass_y"] *= 1 + share
    p["other"][:3] = share, 2 * pi * rng.uniform(3, 7), rng.uniform(0.01, 0.05)


@KINDS.of(LIFT)
def lifting_springs(size: float, rng: np.random.Generator, r: Reference):
    """Springs mounted above the plane: they lift with travel and with speed."""
    return 0.05 * size, rng.uniform(0.1, 0.4)


@KINDS.of(SOFT_BELT)
def soft_belt(size: float, rng: np.random.Generator, r: Reference):
    """A belt that stretches between its rollers and lags behind the pull on it."""
    return 0.01 * size, rng.uniform(0.02, 0.08)


@KINDS.of(THUMPS)
def thumps(size: float, rng: np.random.Generator, r: Reference):
    """Knocks from outside, at no particular time."""
    return 0.05 * size, rng.uniform(0.4, 1.0), 0.015


@KINDS.of(BELT_DRIFT)
def belt_drift(size: float, rng: np.random.Generator, r: Reference):
    """A motor that warms up: the belt gains or loses speed steadily over each run."""
    return 0.08 * size * rng.choice((-1, 1)), r.duration


@KINDS.of(ROCKING)
def rocking_table(size: float, rng: np.random.Generator, r: Reference):
    """A floor that sways slowly."""
    return 0.03 * size, rng.uniform(0.12, 0.5)
