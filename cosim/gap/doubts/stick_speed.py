"""Whether the block goes with the surface at the stated speed where it sticks.

Two figures, neither of which takes the stated speed for granted. The block is at most as fast as
the surface, for friction stops pulling there: more of its velocities above it than noise makes are
a surface that is faster. And where it moves along a straight line, again and again, it sticks: the
slope is the surface's speed, less what the contact creeps, which is slower than the slowest
surface and as much in one run as in another.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

from cosim.gap.data import Campaign, MeasuredRun

from .doubt import Doubt, far, rounded
from .springs import PART
from .windows import scatter, triples

#: Part of the speed by which a contact that is sheared, or loaded by the springs, has the block
#: swing past the surface.
SHEARED = 0.02
#: Most part of velocities above the surface's speed, beside noise: outliers that nobody took out.
ABOVE = 0.02
#: A straight stretch lasts this part of a free vibration.
STRAIGHT = 1.0 / 3.0
#: Root mean square of what a straight line leaves of a vibration's fastest third, in amplitudes.
_BENT = 0.029
#: Such a stretch of a vibration would leave so many standard deviations of its chi-square.
POWER = 8.0
#: The least travel of a stick, as part of the range of x; fewest sticks, and as part of all cycles.
TRAVEL, FEWEST, SHARE = 0.2, 3, 0.5
#: Most part of the slowest surface's speed by which a contact creeps.
CREEPS = 0.3
#: What makes another speed in stick by itself.
EXPLAINED_BY = (
    "measurement.scale", "measurement.clock", "measurement.rotation", "speed_ripple",
    "turning_surface", "measurement.quantisation",
)  # fmt: skip


@dataclass(frozen=True)
class Slope:
    """Of a run: the velocity in stick along the surface and its standard error, m/s."""

    run: MeasuredRun
    value: float
    error: float

    @property
    def lack(self) -> float:
        """By how much it is slower than the surface, m/s."""
        return abs(self.run.surface_speed) - self.value


def doubts_of_stick_speed(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for each run whose sticks are faster, or slower, than the surface is said to be."""
    known = math.hypot(campaign.errors.surface_speed, SHEARED)
    limit = far(2 * len(runs))
    faster = {run.name: fast for run in runs if (fast := overtaking(run, limit * known))}
    slopes = [slope for run in runs if (slope := stick_slope(run)) is not None]
    doubts = []
    for run in runs:
        here = next((slope for slope in slopes if slope.run is run), None)
        off = here is not None and is_off(here, slopes, runs, limit, known)
        if here is not None and off:
            doubts.append(doubt_of_speed(run, here.value, limit * known))
        elif run.name in faster:
            doubts.append(doubt_of_speed(run, faster[run.name], limit * known))
    return doubts


def is_off(
    here: Slope, slopes: Sequence[Slope], runs: Sequence[MeasuredRun], limit: float, known: float
) -> bool:
    """Whether a slope is another than the speed and the creep of the other runs allow."""
    speed = abs(here.run.surface_speed)
    slowest = min(abs(run.surface_speed) for run in runs)
    others = [max(slope.lack, 0.0) for slope in slopes if slope is not here]
    creep = min(2.0 * float(np.median(others)), CREEPS * slowest) if others else CREEPS * slowest
    error = limit * math.hypot(known * speed, here.error)
    return not -error <= here.lack <= creep + error


def doubt_of_speed(run: MeasuredRun, value: float, off: float) -> Doubt:
    """value : m/s along the surface; off : part of the speed within which it is expected."""
    along = math.copysign(1.0, run.surface_speed)
    return Doubt(
        "stick_speed", run.name, along * value, run.surface_speed, "m/s",
        f"{run.name}: where it goes with the surface the block moves at "
        f"{rounded(along * value)} m/s, expected is surface_speed = {run.surface_speed:g} m/s "
        f"within {100.0 * off:.2g} % and the creep of the contact: check surface_speed, the scale "
        "of x and the times",
        True, EXPLAINED_BY,
    )  # fmt: skip


def overtaking(run: MeasuredRun, margin: float) -> float:
    """Velocity along the surface that many samples exceed it with, m/s; 0.0 for none.

    margin : part of the speed by which it is not known
    """
    period = 2.0 * math.pi / run.natural_frequency
    seen = triples(run.motion, PART * period)
    speed = abs(run.surface_speed)
    if not seen.time.size:
        return 0.0
    velocity = math.copysign(1.0, run.surface_speed) * seen.velocities[0]
    limit = (1.0 + margin) * speed + 3.0 * math.sqrt(2.0) * scatter(run) / seen.lag
    part = float(np.mean(velocity > limit))
    return float(np.quantile(velocity, 1.0 - ABOVE)) if part > ABOVE else 0.0


def stick_slope(run: MeasuredRun) -> Slope | None:
    """None where the block does not stick long enough, or noise hides what is straight."""
    period = 2.0 * math.pi / run.natural_frequency
    seen = np.isfinite(run.motion.x)
    time, x = run.motion.time[seen], run.motion.x[seen]
    size = round(STRAIGHT * period / run.motion.interval) + 1
    if size < 6 or time.size < 4 * size:
        return None
    swing, noise = float(np.ptp(np.quantile(x, (0.01, 0.99)))), scatter(run)
    if (0.5 * _BENT * swing / noise) ** 2 * size < POWER * math.sqrt(2.0 * size):
        return None
    slope, left, first = _lines(time, x, size)
    straight = left < noise**2 * stats.chi2.ppf(0.99, size - 2) / (size - 2)
    straight &= np.abs(time[first + size - 1] - time[first] - STRAIGHT * period) < 0.3 * period
    sticks = [one for one in _stretches(x, slope, first, size, straight) if one[1] > TRAVEL * swing]
    if not throughout(np.array([at for *_, at in sticks]), x, swing):
        return None
    found = math.copysign(1.0, run.surface_speed) * np.array([value for value, *_ in sticks])
    middle = float(np.median(found))
    error = 1.2533 * float(np.std(found, ddof=1)) / math.sqrt(found.size)
    return Slope(run, middle, error)


def _lines(time: np.ndarray, x: np.ndarray, size: int) -> tuple[np.ndarray, ...]:
    """Slope and mean square residual of a straight line through every window, and where it begins.

    Every second sample begins a window: neighbours tell nothing new.
    """
    first = np.arange(0, time.size - size + 1, 2)
    rows = first[:, None] + np.arange(size)
    t = time[rows] - time[rows].mean(axis=1, keepdims=True)
    v = x[rows] - x[rows].mean(axis=1, keepdims=True)
    slope = (t * v).sum(axis=1) / (t * t).sum(axis=1)
    left = ((v - slope[:, None] * t) ** 2).sum(axis=1) / (size - 2)
    return slope, left, first


def _stretches(
    x: np.ndarray, slope: np.ndarray, first: np.ndarray, size: int, straight: np.ndarray
) -> list[tuple[float, float, int]]:
    """(slope, travel, first sample) of each row of straight windows."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], straight.astype(int), [0]])))
    return [
        (
            float(np.median(slope[begin:end])),
            abs(float(x[first[end - 1] + size - 1] - x[first[begin]])),
            int(first[begin]),
        )
        for begin, end in zip(edges[::2], edges[1::2], strict=True)
    ]


def throughout(sticks: np.ndarray, x: np.ndarray, swing: float) -> bool:
    """Whether sticks (first samples) come in most cycles of both halves of a record.

    A vibration that dies out has straight stretches too, at its end.
    """
    half = x.size // 2
    for low, high in ((0, half), (half, x.size)):
        turns = _turns(x[low:high], swing)
        count = np.count_nonzero((sticks >= low) & (sticks < high))
        if turns < 1 or count < max(1, SHARE * turns):
            return False
    return bool(sticks.size >= FEWEST)


def _turns(x: np.ndarray, swing: float) -> int:
    """How often x comes up through its middle, a fifth of its range to either side."""
    middle = 0.5 * float(np.sum(np.quantile(x, (0.01, 0.99))))
    side = np.sign(np.where(np.abs(x - middle) > 0.2 * swing, x - middle, 0.0))
    side = side[side != 0.0]
    return int(np.count_nonzero(np.diff(side) > 0.0))
