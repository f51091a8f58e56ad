"""Whether numbers are in the units that they are stated in: seen before anything is smoothed."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from stickslip.packing import GRAVITY

from cosim.gap.data import MeasuredRun
from cosim.gap.result import Doubt

from .constants import HALF, LAG, MOST_FRICTION, SHORT_CYCLE, SWINGS, UNIT_SPEED


def doubts_of_units(runs: Sequence[MeasuredRun]) -> list[Doubt]:
    """One for each run whose times, mass and springs, or places cannot be in SI units."""
    found = [(run.name, _wrong(run)) for run in runs]
    return [Doubt("units", f"{name}: {text}", (name,), True) for name, text in found if text]


def _wrong(run: MeasuredRun) -> str:
    """What is in another unit, and in which; "" for nothing."""
    period, track = 2.0 * math.pi / run.natural_frequency, run.motion
    free = f"the free block of {run.mass:g} kg on springs of {run.stiffness:g} N/m swings in"
    if track.interval > HALF * period:
        return f"t: {track.interval:.3g} s between samples, but {free} {period:.3g} s: ms?"
    if track.duration < HALF * period:
        return f"t: {track.duration:.3g} s in all, but {free} {period:.3g} s: divided by 1000?"
    cycle = cycle_of(run)
    if cycle < SHORT_CYCLE * period:
        return f"x swings in {cycle:.3g} s, but {free} {period:.3g} s: mass in g, springs in N/mm?"
    swing = swing_of(run)
    load = run.total_stiffness * swing / (run.mass * GRAVITY)
    if load > MOST_FRICTION:
        return f"x swings by {swing:.3g} m, a spring force of {load:.3g} times the weight: mm?"
    fastest = _fastest(run, max(1, round(LAG * period / track.interval)))
    if load > SWINGS and abs(run.surface_speed) > UNIT_SPEED * fastest:
        return f"surface_speed = {run.surface_speed:g} m/s, but x moves at {fastest:.2g} m/s: mm/s?"
    return ""


def _fastest(run: MeasuredRun, lag: int) -> float:
    """Speed that x reaches in a hundredth of the time, over so many samples, m/s."""
    x, time = run.motion.x, run.motion.time
    return float(np.nanquantile(np.abs((x[lag:] - x[:-lag]) / (time[lag:] - time[:-lag])), 0.99))


def swing_of(run: MeasuredRun) -> float:
    """Range of x without its most extreme samples, m."""
    return float(np.ptp(np.nanquantile(run.motion.x, (0.01, 0.99))))


def cycle_of(run: MeasuredRun) -> float:
    """Median time between upward crossings of the mean of x, s; infinite where there are few."""
    seen = np.isfinite(run.motion.x)
    time, level = run.motion.time[seen], run.motion.x[seen] - np.nanmean(run.motion.x)
    clear = np.abs(level) > max(0.2 * float(np.std(level)), 3.0 * run.noise["x"])
    time, above = time[clear], level[clear] > 0.0
    up = time[1:][above[1:] & ~above[:-1]]
    return float(np.median(np.diff(up))) if up.size > 3 else math.inf
