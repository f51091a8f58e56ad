"""A surface that runs up to its speed while the tracker already sees the block.

All that is asked of a run takes its surface to move at the set-point: a run counts from there. The
first rise of x tells: a block that is held follows the surface, in a parabola where its speed grows
evenly, and where the parabola is as steep as the set-point says the surface has its speed.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.signal import savgol_filter

from cosim.gap.data.measured import MeasuredRun
from cosim.gap.data.units import swing

#: Levels of the first rise, parts of it, between which its time is taken.
LOW, HIGH = 0.25, 0.9
#: Part of the swings by which x falls after its first rise.
FALLS = 0.3
#: Part of a free vibration that the rise takes at least on a surface that runs up, and of the
#: surface's speed that it has at most: a block that slides past rises in 0.23 of a vibration. One
#: that is held has the speed of a steady surface, 0.96 of it where it creeps; of an even run-up,
#: between these levels, 0.72 of the speed at which it lets go.
LONG, SLOW = 0.35, 0.84
#: How many times as long as read off a run-up may be: that of 3 and of 10 s is read to 6 %; and by
#: which part of a vibration besides, as noise bends a short parabola.
LONGER, LATER = 1.1, 0.5
#: Part of a record in which the surface comes to its speed: else there is nothing to keep.
LATEST = 0.9


def after_run_up(
    runs: Sequence[MeasuredRun],
) -> tuple[tuple[MeasuredRun, ...], list[str]]:
    """Runs that begin where the surface has its speed, and a remark on each that is cut."""
    kept, remarks = [], []
    for run in runs:
        end = run_up(run) if run.track is not None else 0.0
        if 0.0 < end < LATEST * run.motion.duration:
            run = replace(run, track=run.motion.since(end))
            remarks.append(
                f"{run.name}: the surface runs up to its speed: the first {end:.3g} s, and what is "
                "slid and heated in them, are left out"
            )
        kept.append(run)
    return tuple(kept), remarks


def run_up(run: MeasuredRun) -> float:
    """When the surface has its speed, s from the first row, by the first rise of x; 0: at once."""
    time, x = _smoothed(run)
    fallen = np.flatnonzero(np.maximum.accumulate(x) - x > FALLS * swing(run.motion.x))
    if not fallen.size:
        return 0.0
    top = int(np.argmax(x[: fallen[0]]))
    rise = float(x[top] - x[: top + 1].min())
    levels = x[top] - rise * (1.0 - np.array([LOW, HIGH]))
    low, high = (time[np.flatnonzero(x[: top + 1] < level).max(initial=0)] for level in levels)
    lasts, way = float(high - low), (HIGH - LOW) * rise
    period = 2.0 * math.pi / run.natural_frequency
    if lasts < LONG * period or way > SLOW * abs(run.surface_speed) * lasts:
        return 0.0
    there = (time >= low) & (time <= high)
    bent, slope, _ = np.polyfit(time[there] - low, x[there], 2)
    if bent <= 0.0:
        return 0.0
    left = max(abs(run.surface_speed) - slope, 0.0) / (2.0 * bent)
    return float(low + LONGER * left + LATER * period)


def _smoothed(run: MeasuredRun) -> tuple[np.ndarray, np.ndarray]:
    """(n,) even times, s, and places along the surface's motion, m, smoothed over a radian."""
    track = run.motion
    seen = np.isfinite(track.x)
    time = np.arange(track.time[0], track.time[-1], track.interval)
    x = np.sign(run.surface_speed) * np.interp(time, track.time[seen], track.x[seen])
    size = 2 * max(2, round(0.5 / run.natural_frequency / track.interval)) + 1
    return time, savgol_filter(x, size, 2) if size < x.size else x
