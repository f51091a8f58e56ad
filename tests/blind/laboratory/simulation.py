"""Run an apparatus: from a state, for a time, by the integrator of its contact."""

from __future__ import annotations

from math import sqrt
from pathlib import Path

import numpy as np
from numba import njit
from numpy.typing import NDArray

from .apparatus import ELASTO_PLASTIC, GRAVITY, IWAN, LUGRE, SMOOTH, Record
from .contacts import elasto_plastic_step, jump_step, lugre_step, smooth_step
from .forces import belt_speed, disturbance
from .friction_law import TRAVEL, age_contact, kinetic_and_excess
from .iwan import march_iwan
from .rows import BRISTLES, COLUMNS, FRICTION, IWAN_COLUMNS, REST, SLIP, SLOWS

STEP = 1e-4  # s
SAMPLE = 1e-3  # s between the rows that are kept

# what numba has kept is good as long as the function's own file is as it was, so it thinks: it does
# not look at the files of the functions that this one calls
HERE = Path(__file__).resolve().parent
CHANGED = max(file.stat().st_mtime for file in HERE.glob("*.py"))
for kept in HERE.glob("__pycache__/*.march*.nbi"):
    if kept.stat().st_mtime < CHANGED:
        kept.unlink(missing_ok=True)


@njit(cache=True)
def march(records, start, begin, count, every, h):
    """Rows at begin, and after every `every` steps of h, s; shape (count + 1, COLUMNS)."""
    p = records[0]
    row = start.copy()
    s, z, slow = row[:BRISTLES], row[BRISTLES:SLOWS], row[SLOWS:FRICTION]
    rows = np.empty((count + 1, COLUMNS))
    total, friction = np.zeros(3), row[FRICTION]
    rows[0] = row
    rows[0, SLIP] = 0.0
    for k in range(count):
        for j in range(every):
            t = begin + (k * every + j) * h
            push, load, springs, mu, extra = disturbance(p, slow, t, h, s, friction)
            load *= p.mass * GRAVITY
            belt = belt_speed(p, t + 0.5 * h) + extra
            kinetic, excess = kinetic_and_excess(p, slow, s[0], load)
            given = (p, s, z, push, springs, load, kinetic * mu, excess * mu, belt, h, total)
            if p.contact == LUGRE:
                friction = lugre_step(*given)
            elif p.contact == ELASTO_PLASTIC:
                friction = elasto_plastic_step(*given)
            elif p.contact == SMOOTH:
                friction = smooth_step(*given)
            else:
                friction = jump_step(*given)
            ux, uy = s[3] - belt, s[4] if p.planar else 0.0
            slip = sqrt(ux * ux + uy * uy)
            slow[TRAVEL] += belt * h
            age_contact(p, slow, slip, abs(friction * ux), h)
        rows[k + 1] = row
        rows[k + 1, FRICTION], rows[k + 1, SLIP] = friction, slip
    return rows


def at_rest_on_belt(p: Record, x: float, y: float = 0.0, phi: float = 0.0) -> NDArray:
    """A row to start from: the block placed at x, m, and carried along by the belt."""
    row = np.zeros(IWAN_COLUMNS if p["contact"] == IWAN else COLUMNS)
    row[REST : REST + 1] = 1.0
    row[:3] = x, y, phi
    row[3] = p["belt_speed"]
    return row


def simulate(
    p: Record,
    start: NDArray,
    duration: float,
    *,
    begin: float = 0.0,
    sample: float = SAMPLE,
    step: float = STEP,
) -> NDArray:
    """Rows of a motion every `sample`, s, from a start row at time `begin`, s."""
    every = max(1, round(sample / step))
    loop = march_iwan if p["contact"] == IWAN else march
    return loop(p.reshape(1), start, begin, round(duration / sample), every, sample / every)
