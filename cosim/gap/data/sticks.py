"""Sticks of a track: the stretches in which the block moves with the surface."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np

from cosim.gap.data.corners import SLIP_SIDE, STICK_SIDE, Corner, fit_corners
from cosim.gap.data.measured import Stick, Track
from cosim.gap.data.noise import huber_scale, third_differences
from cosim.gap.data.partition import STICK, partition

#: Samples per natural period that the partition needs; denser tracks are averaged for it.
DENSITY = 80
#: Parts of a natural period: a gap beyond which the track counts as two; the lag up to which
#: scatter that is not white counts as noise.
GAP, COLOUR = 0.5, 1.0 / 24.0
#: Two sticks are one where the second goes on where the first ends, within so many standard
#: deviations, or where the surface left the block behind by less than this part of its own travel:
#: in a slip the springs pull the block back, which makes it more than the whole.
SAME_LEVEL, LEFT_BEHIND = 4.0, 0.5
#: A stick moves with the surface, within so many standard errors and this part of its speed.
SAME_SPEED, SPEED_PART = 4.0, 0.2


def find_sticks(
    track: Track, speed: float, omega: float, noise: float, gap: float = GAP
) -> tuple[Stick, ...]:
    """Sticks in the order of time.

    Parameters
    ----------
    speed : of the surface, m/s
    omega : natural frequency, rad/s
    noise : standard deviation of a sample of x, m
    gap : part of a natural period without samples beyond which a stick is not followed
    """
    there = np.flatnonzero(np.isfinite(track.x))
    time, x = track.time[there], track.x[there]
    noise = max(noise, coloured_noise(time, x, omega))
    cuts = np.flatnonzero(np.diff(time) > gap * 2.0 * math.pi / omega) + 1
    sticks: list[Stick] = []
    for first, last in pairwise([0, *cuts, len(time)]):
        part = slice(first, last)
        found = _in_part(time[part], x[part], speed, omega, noise)
        sticks += [
            Stick(s.start, s.end, int(there[first + s.first]), int(there[first + s.last]),
                  s.start_sd, s.end_sd)
            for s in found
        ]  # fmt: skip
    return tuple(sticks)


def coloured_noise(time: np.ndarray, x: np.ndarray, omega: float) -> float:
    """Scatter of a sample on any scale up to a small part of the natural period, m."""
    longest = max(int(COLOUR * 2.0 * math.pi / omega / np.median(np.diff(time))), 1)
    lags = {min(2**i, longest) for i in range(longest.bit_length())}
    scales = [third_differences(time, x, lag) for lag in sorted(lags)]
    return max((huber_scale(values) for values in scales if len(values) >= 8), default=0.0)


def _in_part(
    time: np.ndarray, x: np.ndarray, speed: float, omega: float, noise: float
) -> list[Stick]:
    """Sticks of a track without gaps; ``noise`` is that of a sample."""
    period = 2.0 * math.pi / omega
    if len(time) < 8:
        return []
    samples = max(int(period / np.median(np.diff(time)) / DENSITY), 1)
    coarse_time, coarse_x = averaged(time, samples), averaged(x, samples)
    pieces = partition(coarse_time, coarse_x, speed, omega, noise / math.sqrt(samples))
    ranges = [
        (start * samples, min(end * samples, len(time)) if end < len(coarse_time) else len(time))
        for kind, start, end in pieces
        if kind == STICK
    ]
    ranges = _merged(time, x, ranges, speed, noise)
    ranges = [span for span in ranges if _moves_along(time, x, span, speed, noise)]
    return [_refined(time, x, ranges, place, speed, omega, noise) for place in range(len(ranges))]


def averaged(values: np.ndarray, samples: int) -> np.ndarray:
    """Means of so many neighbours; what is left over at the end is dropped."""
    whole = len(values) // samples * samples
    return values[:whole].reshape(-1, samples).mean(axis=1)


def _merged(
    time: np.ndarray, x: np.ndarray, ranges: list[tuple[int, int]], speed: float, noise: float
) -> list[tuple[int, int]]:
    """Sticks without those slips in which the block did not move on the surface."""
    merged = ranges[:1]
    for before, after in pairwise(ranges):
        left, samples = _left_behind(time, x, before, after, speed)
        travel = abs(speed) * (time[after[0]] - time[before[1] - 1])
        if left < max(SAME_LEVEL * noise / math.sqrt(samples), LEFT_BEHIND * travel):
            merged[-1] = (merged[-1][0], after[1])
        else:
            merged.append(after)
    return merged


def _moves_along(
    time: np.ndarray, x: np.ndarray, span: tuple[int, int], speed: float, noise: float
) -> bool:
    """Whether the slope of a stick is that of the surface: else a vibration was taken for one."""
    rows = slice(*span)
    away = time[rows] - np.mean(time[rows])
    spread = float(away @ away)
    off = abs(float(away @ x[rows]) / spread - speed)
    return off < SAME_SPEED * noise / math.sqrt(spread) + SPEED_PART * abs(speed)


def _left_behind(
    time: np.ndarray, x: np.ndarray, before: tuple[int, int], after: tuple[int, int], speed: float
) -> tuple[float, float]:
    """Travel of the surface under the block between two sticks, and half its samples.

    Negative where the block moved ahead of the surface.
    """
    size = min(before[1] - before[0], after[1] - after[0], 20)
    ends, starts = slice(before[1] - size, before[1]), slice(after[0], after[0] + size)
    level = [float(np.mean(speed * time[part] - x[part])) for part in (ends, starts)]
    return math.copysign(1.0, speed) * (level[1] - level[0]), size / 2.0


def _refined(
    time: np.ndarray,
    x: np.ndarray,
    ranges: list[tuple[int, int]],
    place: int,
    speed: float,
    omega: float,
    noise: float,
) -> Stick:
    """A stick with its corners between the samples."""
    first, end = ranges[place]
    before = ranges[place - 1][1] if place else 0
    after = ranges[place + 1][0] if place + 1 < len(ranges) else len(time)
    corners = []
    if first > 0:
        corners.append((0.5 * (time[first - 1] + time[first]), -1, time[before]))
    if end < len(time):
        corners.append((0.5 * (time[end - 1] + time[end]), 1, time[after - 1]))
    period = 2.0 * math.pi / omega
    together = time[end - 1] - time[first] < STICK_SIDE * period
    found: dict[int, Corner] = {}
    for group in [corners] if together else [[corner] for corner in corners]:
        found |= _fitted(time, x, group, (time[first], time[end - 1]), speed, omega, noise)
    start = found.get(-1, Corner(float(time[first]), math.inf))
    stop = found.get(1, Corner(float(time[end - 1]), math.inf))
    inside = np.flatnonzero((time >= start.time) & (time <= stop.time))
    if not inside.size:
        inside = np.arange(first, end)
    return Stick(start.time, stop.time, int(inside[0]), int(inside[-1]), start.sd, stop.sd)


def _fitted(
    time: np.ndarray,
    x: np.ndarray,
    group: list[tuple[float, int, float]],
    stick: tuple[float, float],
    speed: float,
    omega: float,
    noise: float,
) -> dict[int, Corner]:
    """Corners by their side; where the fit fails, the middle between two samples."""
    if not group:
        return {}
    period = 2.0 * math.pi / omega
    low, high = stick
    for at, side, other in group:
        # half of the slip at most: the rest belongs to the other corner
        reach = at + side * min(SLIP_SIDE * period, 0.5 * abs(other - at))
        low, high = (min(low, reach), high) if side < 0 else (low, max(high, reach))
    if len(group) == 1:
        at, side, _ = group[0]
        keep = at - side * STICK_SIDE * period
        low, high = (low, min(high, keep)) if side < 0 else (max(low, keep), high)
    near = (time >= low) & (time <= high)
    fit = fit_corners(
        time[near], x[near], [(at, side) for at, side, _ in group], speed, omega, noise
    )
    if fit is None:
        spacing = float(np.median(np.diff(time)))
        fit = [Corner(at, spacing) for at, _, _ in group]
    return {side: corner for (_, side, _), corner in zip(group, fit, strict=True)}
