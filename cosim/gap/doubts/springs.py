"""Whether the block swings as its mass and springs are stated.

In a slip the block vibrates freely, and three places h apart in time are on one circle,

    x(t + h) + x(t - h) = 2 c cos(omega h) + b (x(t + h) - x(t - h)) + const,     c = x(t) - const,

whatever the friction is, as long as it is constant or goes with the velocity (b). A regression over
all windows within slips tells omega, with the noise in the places taken out of its moments.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun

from .doubt import Doubt, far, listed, rounded
from .windows import Triples, scatter, triples

#: h as part of the stated period.
PART = 1.0 / 8.0
#: A window is in slip where both of its halves are slower than this part of the surface.
SLIPS = 0.6
#: The surface is so many times faster than slips are by this that noise of a velocity tells stick
#: from slip.
CLEAR = 4.0
#: Fewest windows, and periods that hold some, of a run.
WINDOWS, PERIODS = 20, 3
#: Standard deviation of what friction that goes with the place, or with what was slid, makes of the
#: stiffness: friction a F (1 + sin q x) is a spring of a F q, a few percent of those of the rig.
FRICTION = 0.02
#: What makes the springs other than stated by itself; a pattern as short as the block's stroke is a
#: spring of a F q that may be stiffer than `FRICTION`.
EXPLAINED_BY = ("spring_hardening", "measurement.clock", "surface_pattern")


@dataclass(frozen=True)
class Stiffness:
    """Of a run: the springs as the period has them, in parts of what is stated, and its error."""

    run: MeasuredRun
    ratio: float
    error: float


def doubts_of_springs(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for each set-up (mass and springs) whose period is that of others."""
    found = [one for run in runs if (one := stiffness_of(run)) is not None]
    setups = {(one.run.mass, one.run.stiffness) for one in found}
    limit, doubts = far(len(setups)), []
    for setup in sorted(setups):
        mine = [one for one in found if (one.run.mass, one.run.stiffness) == setup]
        middle = sorted(mine, key=lambda one: one.ratio)[len(mine) // 2]
        known = math.hypot(campaign.errors.stiffness, FRICTION)
        error = math.hypot(known, middle.error / middle.ratio)
        if abs(math.log(middle.ratio)) > limit * error:
            doubts.append(_doubt(mine, middle, limit * error))
    return doubts


def _doubt(mine: Sequence[Stiffness], middle: Stiffness, off: float) -> Doubt:
    run = middle.run
    stated = run.natural_frequency / (2.0 * math.pi)
    seen = stated * math.sqrt(middle.ratio)
    return Doubt(
        "springs", listed([one.run.name for one in mine]), seen, stated, "Hz",
        f"{listed([one.run.name for one in mine])}: slips swing at {rounded(seen)} Hz, expected "
        f"is {rounded(stated)} Hz within {100.0 * math.expm1(0.5 * off):.2g} %, that of "
        f"{run.mass:g} kg on four springs of {run.stiffness:g} N/m: check mass and stiffness "
        f"({rounded(middle.ratio * run.stiffness)} N/m, or "
        f"{rounded(run.mass / middle.ratio)} kg, would swing so)",
        True, EXPLAINED_BY,
    )  # fmt: skip


def stiffness_of(run: MeasuredRun) -> Stiffness | None:
    """None where slips are too few, or noise does not tell them from sticks."""
    period = 2.0 * math.pi / run.natural_frequency
    seen = triples(run.motion, PART * period)
    speed, noise = abs(run.surface_speed), run.noise["x"]
    if (1.0 - SLIPS) * speed < CLEAR * math.sqrt(2.0) * scatter(run) / seen.lag:
        return None
    first, second = seen.velocities
    way = math.copysign(1.0, run.surface_speed)
    slips = (way * first < SLIPS * speed) & (way * second < SLIPS * speed)
    number = np.floor(seen.time[slips] / period).astype(int)
    if slips.sum() < WINDOWS or np.unique(number).size < PERIODS:
        return None
    told = _cosine(seen, slips, number, noise)
    if told is None:
        return None
    cosine, error = told
    angle = math.acos(cosine)
    ratio = (angle / seen.lag / run.natural_frequency) ** 2
    return Stiffness(run, ratio, 2.0 * ratio * error / (angle * math.sin(angle)))


def _cosine(
    seen: Triples, rows: np.ndarray, number: np.ndarray, noise: float
) -> tuple[float, float] | None:
    """cos(omega h) and its standard error, windows of one period (``number``) taken as one."""
    columns = np.stack([seen.here[rows], (seen.after - seen.before)[rows]], axis=1)
    columns -= columns.mean(axis=0)
    both = (seen.before + seen.after)[rows]
    both = both - both.mean()
    moments = columns.T @ columns - len(both) * noise**2 * np.diag([1.0, 2.0])
    if np.linalg.eigvalsh(moments)[0] <= 0.0:  # no motion beside the noise
        return None
    slopes = np.linalg.solve(moments, columns.T @ both)
    scores = np.zeros((number.max() + 1, 2))
    np.add.at(scores, number, columns * (both - columns @ slopes)[:, None])
    inverse = np.linalg.inv(moments)
    error = 0.5 * math.sqrt((inverse @ scores.T @ scores @ inverse)[0, 0])
    cosine = 0.5 * float(slopes[0])
    return (cosine, error) if abs(cosine) + error < 1.0 else None
