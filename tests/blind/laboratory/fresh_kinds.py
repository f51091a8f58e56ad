"""Kinds that no catalogue holds, of the Iwan contact's suites. The form is `out_of_catalogue`'s."""

from __future__ import annotations

from math import exp, pi, sin

import numpy as np
from numba import njit

from .apparatus import GRAVITY
from .friction_law import OTHER
from .laws import Named, Reference

FIRST_KIND = 201
SECOND_MASS, BELT_MASS, RATTLE, BOUC_WEN, HUMIDITY, TURNING_TILT, SPIN_UP = range(201, 208)
KINDS = Named()


@njit
def fresh_kind(p, slow, t, h, s, friction):
    """Push, factors of load, spring and friction, and extra belt speed of the kind in a record."""
    push, load, mu, extra = 0.0, 1.0, 1.0, 0.0
    weight = p.mass * GRAVITY
    size = p.other[0]
    if p.other_form == SECOND_MASS:  # size: mass over the block's; numbers: rad/s, damping ratio
        if t < h:
            slow[OTHER], slow[OTHER + 1] = s[0], s[3]
        pull = p.other[1] ** 2 * (slow[OTHER] - s[0])
        pull += 2 * p.other[2] * p.other[1] * (slow[OTHER + 1] - s[3])
        slow[OTHER + 1] -= h * pull
        slow[OTHER] += h * slow[OTHER + 1]
        push = size * p.mass * pull
    elif p.other_form == BELT_MASS:  # size: give under the weight, m; numbers: rad/s, damping ratio
        pull = p.other[1] ** 2 * (size * friction / weight + slow[OTHER])
        slow[OTHER + 1] -= h * (pull + 2 * p.other[2] * p.other[1] * slow[OTHER + 1])
        slow[OTHER] += h * slow[OTHER + 1]
        extra = slow[OTHER + 1]
    elif p.other_form == RATTLE:  # size: share of the load; numbers: Hz of three tones
        for i in range(3):
            load += size / 3.0 * sin(2 * pi * (p.other[1 + i] * t + (i + 1) * p.phase))
        load = max(load, 0.1)
    elif p.other_form == BOUC_WEN:  # size: stiffness over the springs'; number: m of give
        z, move = slow[OTHER], h * s[3] / p.other[1]
        slow[OTHER] += move - 0.5 * (abs(move) * z * abs(z) + move * z * z)
        push = -size * 4.0 * p.stiffness * p.other[1] * z
    elif p.other_form == HUMIDITY:  # size: share of mu; numbers: a second, s to dry
        count = np.floor(t * p.other[1])
        for i in range(2):  # pulses at irregular times, each of its own height
            draw = np.sin(91.7 * (count - i + 1.0) + 47.1 * p.phase) * 15731.743
            draw -= np.floor(draw)
            since = t - (count - i + draw) / p.other[1]
            if since > 0.0:
                mu += size * (0.4 + draw) * exp(-since / p.other[2])
    elif p.other_form == TURNING_TILT:  # size: slope; number: Hz
        push = weight * size * sin(2 * pi * (p.other[1] * t + p.phase))
    elif p.other_form == SPIN_UP:  # size: share of the weight; numbers: Hz at first, Hz a second
        push = weight * size * sin(2 * pi * ((p.other[1] + 0.5 * p.other[2] * t) * t + p.phase))
    return push, load, 1.0, mu, extra


@KINDS.of(SECOND_MASS)
def second_mass(size: float, rng: np.random.Generator, r: Reference):
    """A second mass, hung on the block by a soft spring beside it: 1.2 to 2.5 Hz."""
    return 0.3 * size, 2 * np.pi * rng.uniform(1.2, 2.5), rng.uniform(0.01, 0.04)


@KINDS.of(BELT_MASS)
def springy_belt(size: float, rng: np.random.Generator, r: Reference):
    """A belt on a spring, with a mass of its own: it rings at 4 to 9 Hz."""
    return 0.01 * size, 2 * np.pi * rng.uniform(4, 9), rng.uniform(0.03, 0.1)


@KINDS.of(RATTLE)
def rattling_load(size: float, rng: np.random.Generator, r: Reference):
    """A normal force that shakes at three tones of 1.5 to 9 Hz."""
    return 0.4 * size, *rng.uniform((1.5, 3.0, 5.5), (3.0, 5.5, 9.0))


@KINDS.of(BOUC_WEN)
def hysteretic_springs(size: float, rng: np.random.Generator, r: Reference):
    """Springs whose force hangs back in a rounded loop (Bouc and Wen)."""
    return 0.3 * size, rng.uniform(0.15, 0.4) * r.deflection


@KINDS.of(HUMIDITY)
def humidity_pulses(size: float, rng: np.random.Generator, r: Reference):
    """Breaths of damp air at irregular times: friction rises at once and dries back in a second."""
    return 0.2 * size, rng.uniform(0.25, 0.6), rng.uniform(0.4, 1.2)


@KINDS.of(TURNING_TILT)
def turning_tilt(size: float, rng: np.random.Generator, r: Reference):
    """A table that is not level and turns below the whole rig, once in 5 to 12 s."""
    return 0.03 * size, 1 / rng.uniform(5, 12)


@KINDS.of(SPIN_UP)
def machine_spins_up(size: float, rng: np.random.Generator, r: Reference):
    """A machine beside the rig that runs up and shakes it ever faster."""
    return 0.03 * size, rng.uniform(0.3, 1.0), rng.uniform(0.05, 0.25)
