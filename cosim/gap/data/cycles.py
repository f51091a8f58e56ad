"""What a run looks like in a few numbers, each with its standard error."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from cosim.gap.data.measured import MeasuredRun, Stick, Track

#: A gap of more than this part of the natural period may hide a cycle.
GAP = 0.5
#: Slips that last longer than a free vibration (times omega) have unseen sticks in them; with more
#: than some of these, break-aways are no count of cycles.
WHOLE_SLIP, FEW = 2.0 * math.pi * 1.1, 0.3


@dataclass(frozen=True)
class Figure:
    """A number and its standard error; NaN where there is nothing to take it from."""

    value: float
    error: float


@dataclass(frozen=True)
class CycleFeatures:
    """Figures of one run, from its track alone.

    Attributes
    ----------
    break_away_x, restick_x : mean position at break-away and at re-stick, m
    stick_duration, slip_duration : means over the whole ones, s
    frequency : cycles per second, Hz
    slip_share : part of the time in slip; of the part between the first and the last corner
    mean_x, mean_y : means over time and whole cycles, m
    amplitude_x : half the range of x, mean over cycles, m
    stick_speed : slope of x in stick, m/s
    cycles : how many whole ones there are
    """

    break_away_x: Figure
    restick_x: Figure
    stick_duration: Figure
    slip_duration: Figure
    frequency: Figure
    slip_share: Figure
    mean_x: Figure
    mean_y: Figure
    amplitude_x: Figure
    stick_speed: Figure
    cycles: int


NOTHING = Figure(math.nan, math.nan)


def cycle_features(run: MeasuredRun) -> CycleFeatures:
    """Features of a run with a track; those of sticks are NaN where none is seen.

    A cycle lasts from break-away to break-away or, in a run without visible sticks, from one
    upward crossing of the mean to the next. Standard errors are those of means over cycles: they
    hold scatter from cycle to cycle as well as noise.
    """
    track, sticks = run.motion, run.sticks
    whole = [stick for stick in sticks if math.isfinite(stick.start_sd + stick.end_sd)]
    slips = [
        after.start - before.end
        for before, after in pairwise(sticks)
        if math.isfinite(before.end_sd + after.start_sd) and _unbroken(run, before, after)
    ]
    ends = [stick for stick in sticks if math.isfinite(stick.end_sd)]
    starts = [stick for stick in sticks if math.isfinite(stick.start_sd)]
    stick, slip = _mean([s.duration for s in whole]), _mean(slips)
    cycles = list(pairwise(_marks(run, slips)))
    return CycleFeatures(
        break_away_x=_mean([_line(run, s, s.end) for s in ends]),
        restick_x=_mean([_line(run, s, s.start) for s in starts]),
        stick_duration=stick,
        slip_duration=slip,
        frequency=_inverse(_mean([b - a for a, b in cycles])),
        slip_share=_share(slip, stick) if sticks else Figure(1.0, 0.0),
        mean_x=_cycle_means(track, "x", cycles),
        mean_y=_cycle_means(track, "y", cycles),
        amplitude_x=_mean([_half_range(track, a, b) for a, b in cycles]),
        stick_speed=_stick_speed(track, sticks),
        cycles=len(cycles),
    )


def _mean(values: list[float]) -> Figure:
    array = np.array([value for value in values if math.isfinite(value)])
    if not array.size:
        return NOTHING
    error = float(np.std(array, ddof=1)) / math.sqrt(array.size) if array.size > 1 else math.nan
    return Figure(float(np.mean(array)), error)


def _inverse(figure: Figure) -> Figure:
    if not figure.value > 0.0:
        return NOTHING
    return Figure(1.0 / figure.value, figure.error / figure.value**2)


def _share(slip: Figure, stick: Figure) -> Figure:
    """slip / (slip + stick), errors of the two taken as independent."""
    total = slip.value + stick.value
    if not total > 0.0:
        return NOTHING
    error = math.hypot(stick.value * slip.error, slip.value * stick.error) / total**2
    return Figure(slip.value / total, error)


def _line(run: MeasuredRun, stick: Stick, at: float) -> float:
    """x on the stick's line at a time, m; the stick's half next to it says where the line is."""
    half = max(0.5 * stick.duration, 3.0 * run.motion.interval)
    inside = slice(stick.first, stick.last + 1)
    time, x = run.motion.time[inside], run.motion.x[inside]
    near = np.isfinite(x) & (np.abs(time - at) <= half)
    if not near.any():
        return math.nan
    return float(np.mean(x[near] - run.surface_speed * (time[near] - at)))


def _unbroken(run: MeasuredRun, before: Stick, after: Stick) -> bool:
    """Whether nothing can be hidden in a gap between two sticks."""
    rows = slice(before.last, after.first + 1)
    time = run.motion.time[rows][np.isfinite(run.motion.x[rows])]
    return bool(np.max(np.diff(time), initial=0.0) < GAP * 2.0 * math.pi / run.natural_frequency)


def _marks(run: MeasuredRun, slips: list[float]) -> list[float]:
    """One time a cycle: break-aways, or upward crossings of the mean."""
    ends = [stick.end for stick in run.sticks if math.isfinite(stick.end_sd)]
    # where sticks of some cycles are too short to be seen, break-aways are several cycles apart
    long = sum(slip > WHOLE_SLIP / run.natural_frequency for slip in slips)
    return ends if slips and long <= FEW * len(slips) else _crossings(run)


def _crossings(run: MeasuredRun) -> list[float]:
    """Times at which x crosses its mean upwards; noise near the mean does not count twice."""
    there = np.isfinite(run.motion.x)
    time, x = run.motion.time[there], run.motion.x[there]
    level = x - np.mean(x)
    dead = max(0.2 * float(np.std(level)), 3.0 * run.noise.get("x", 0.0))
    marks, armed = [], False
    for i in range(1, len(x)):
        armed = armed or level[i] < -dead
        if armed and level[i] > dead:
            below = i - 1
            while level[below] > 0.0:
                below -= 1
            part = level[below] / (level[below] - level[below + 1])
            marks.append(float(time[below] + part * (time[below + 1] - time[below])))
            armed = False
    return marks


def _cycle_means(track: Track, channel: str, cycles: list[tuple[float, float]]) -> Figure:
    if channel not in track.channels:
        return NOTHING
    there = np.isfinite(track[channel])
    time, values = track.time[there], track[channel][there]
    means = []
    for start, end in cycles or [(time[0], time[-1])]:
        grid = np.array([start, *time[(time > start) & (time < end)], end])
        if len(grid) > 4:
            curve = np.interp(grid, time, values)
            means.append(float(np.trapezoid(curve, grid)) / (end - start))
    return _mean(means)


def _half_range(track: Track, start: float, end: float) -> float:
    inside = (track.time >= start) & (track.time <= end) & np.isfinite(track.x)
    return 0.5 * float(np.ptp(track.x[inside])) if np.count_nonzero(inside) > 2 else math.nan


def _stick_speed(track: Track, sticks: tuple[Stick, ...]) -> Figure:
    """Common slope of all sticks, each with its own level; the error from their differences."""
    above = below = 0.0
    slopes: list[tuple[float, float]] = []
    for stick in sticks:
        rows = slice(stick.first, stick.last + 1)
        there = np.isfinite(track.x[rows])
        time, x = track.time[rows][there], track.x[rows][there]
        if len(time) < 5:
            continue
        away = time - np.mean(time)
        above += float(away @ x)
        below += float(away @ away)
        slopes.append((float(away @ x) / float(away @ away), float(away @ away)))
    if len(slopes) < 2:
        return NOTHING
    slope = above / below
    weights = np.array([weight for _, weight in slopes])
    spread = np.array([value for value, _ in slopes]) - slope
    error = math.sqrt(float(np.sum(weights**2 * spread**2)) / below**2)
    return Figure(slope, error)
