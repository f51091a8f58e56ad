"""Kinds that no catalogue holds, kept back: written last, never developed on, to be run once.

Whoever works on the method that names effects does not look in here and does not run the suite
`held_back` before the method is finished: the figure from it counts the first time only. The form
is that of `out_of_catalogue`.
"""

from __future__ import annotations

from math import exp, pi, sin, sqrt, tanh

import numpy as np
from numba import njit

from .apparatus import GRAVITY
from .friction_law import OTHER
from .laws import Named, Reference

HYSTERESIS, SPRING_DRIFT, SAG_WAVE, MAGNET, PLATE, DRAUGHT, WEAK_MOTOR = range(101, 108)
GUSTS = 6
KINDS = Named()


@njit
def held_back(p, slow, t, h, s, friction):
    """Push, factors of load, spring and friction, and extra belt speed of the kind in a record."""
    push, load, spring, mu, extra = 0.0, 1.0, 1.0, 1.0, 0.0
    weight = p.mass * GRAVITY
    size = p.other[0]
    if p.other_form == HYSTERESIS:  # size: stiffness over the springs'; number: m of give
        slow[OTHER] = min(max(slow[OTHER], s[0] - p.other[1]), s[0] + p.other[1])
        push = -size * 4.0 * p.stiffness * (s[0] - slow[OTHER])
    elif p.other_form == SPRING_DRIFT:  # size: share of the stiffness; number: s
        spring = max(1.0 + size * (1.0 - exp(-t / p.other[1])), 0.3)
    elif p.other_form == SAG_WAVE:  # size: share of the load; number: Hz
        load = 1.0 + min(size, 0.9) * sin(2 * pi * (p.other[1] * t + p.phase))
    elif p.other_form == MAGNET:  # size: share of the weight; numbers: place and reach, m
        d = (s[0] - p.other[1]) / p.other[2]
        push = -weight * size * d * exp(0.5 - 0.5 * d * d)
    elif p.other_form == PLATE:  # size: share of mu; numbers: place and width of the change, m
        mu = max(1.0 + size * tanh((s[0] - p.other[1]) / p.other[2]), 0.1)
    elif p.other_form == DRAUGHT:  # size: share of the weight; numbers: phases
        for i in range(GUSTS):
            turns = 0.11 * 1.73**i * t + p.other[1 + i] + 7.13 * (i + 1) * p.phase
            push += weight * size * sin(2 * pi * turns) / sqrt(GUSTS)
    elif p.other_form == WEAK_MOTOR:  # size: share of the speed lost at a pull of a weight; s
        rate = (-size * p.belt_speed * friction / weight - slow[OTHER]) / p.other[1]
        slow[OTHER] += h * rate
        extra = slow[OTHER]
    return push, load, spring, mu, extra


@KINDS.of(HYSTERESIS)
def spring_hysteresis(size: float, rng: np.random.Generator, r: Reference):
    """Springs that rub in their mounts: a part of their force hangs back at every turn."""
    return 0.3 * size, rng.uniform(0.1, 0.3) * r.deflection


@KINDS.of(SPRING_DRIFT)
def spring_drift(size: float, rng: np.random.Generator, r: Reference):
    """Springs that stiffen or soften as the room warms them, in the same way in every run."""
    return 0.2 * size * rng.choice((-1, 1)), rng.uniform(5, 15)


@KINDS.of(SAG_WAVE)
def belt_sag_wave(size: float, rng: np.random.Generator, r: Reference):
    """A belt that hangs through and swings up and down: a load that goes with time."""
    return 0.2 * size, rng.uniform(0.7, 4.0)


@KINDS.of(MAGNET)
def magnet(size: float, rng: np.random.Generator, r: Reference):
    """Something at one place of the frame that draws the block to it."""
    place = 0.8 * r.deflection
    return 0.05 * size, rng.uniform(0.8, 1.2) * place, rng.uniform(0.15, 0.3) * place


@KINDS.of(PLATE)
def support_plate(size: float, rng: np.random.Generator, r: Reference):
    """A plate under the belt that presses more on one side of a place in the frame."""
    place = 0.8 * r.deflection
    return 0.2 * size, rng.uniform(0.8, 1.2) * place, rng.uniform(0.05, 0.2) * place


@KINDS.of(DRAUGHT)
def air_draught(size: float, rng: np.random.Generator, r: Reference):
    """Gusts on the block, of many lengths."""
    return 0.03 * size, *rng.uniform(0, 1, GUSTS)


@KINDS.of(WEAK_MOTOR)
def weak_motor(size: float, rng: np.random.Generator, r: Reference):
    """A belt that loses speed as the block pulls on it, and takes it up again late."""
    return size, rng.uniform(0.05, 0.3)
