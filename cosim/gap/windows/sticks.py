"""Sticks of a run, in rows of its file, from its smoothed track."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from cosim.gap.data import MeasuredRun
from cosim.gap.weak_form.track import SmoothTrack, mask, smooth

#: Shortest stick, in 1 / omega, and the part of its speed by which the surface may get ahead of the
#: block in the mean, beside noise: the crest of a swing that just reaches the surface's speed, too,
#: is within 6 % of it for 0.7 / omega, smoothed for longer, and is slower by 6 % in 1.2 / omega.
SHORTEST, AHEAD, SIGMAS = 1.2, 0.04, 3.0
#: A run is smoothed once: what is asked for its sticks asks many times.
smoothed = lru_cache(maxsize=64)(smooth)


@dataclass(frozen=True)
class Stick:
    """A stretch in which the block moves with the surface.

    Attributes
    ----------
    start, end : re-stick and break-away, s on the track's clock
    first, last : indices of the first and the last sample that are surely inside
    start_sd, end_sd : their standard deviations, s; infinite where the track (or what lies between
        two gaps) begins or ends in the stick, and re-stick or break-away was not seen
    """

    start: float
    end: float
    first: int
    last: int
    start_sd: float = math.inf
    end_sd: float = math.inf

    @property
    def duration(self) -> float:
        """s"""
        return self.end - self.start


@lru_cache(maxsize=64)
def sticks_of(run: MeasuredRun) -> tuple[Stick, ...]:
    """The stretches in which the block moves with the surface, as seen in the data."""
    track = smoothed(run)
    slips = mask(track.slips, track.time.size)
    rows = np.flatnonzero(np.isfinite(run.motion.x))
    found = []
    for inside in track.sticks:
        first, begins = _end_of(track, slips, inside[0], -1)
        last, ends = _end_of(track, slips, inside[1] - 1, 1)
        start, end = float(track.time[first]), float(track.time[last])
        low, high = np.searchsorted(run.motion.time[rows], [start, end])
        if high - low > 1 and _moves_along(track, first, last):
            found.append(Stick(start, end, int(rows[low]), int(rows[high - 1]), begins, ends))
    return tuple(found)


def _moves_along(track: SmoothTrack, first: int, last: int) -> bool:
    """Whether the block stays where it is on the surface: else a swing just reached its speed."""
    run, duration = track.run, (last - first) * track.interval
    ahead = abs(float(track.surface_place[last] - track.surface_place[first]))
    most = AHEAD * abs(run.surface_speed) * duration + SIGMAS * run.noise["x"]
    return duration > SHORTEST / run.natural_frequency and ahead < most


def _end_of(track: SmoothTrack, slips: np.ndarray, at: int, step: int) -> tuple[int, float]:
    """Where a stick ends to one side, and its standard deviation, s; infinite: not in a slip."""
    while 0 <= at + step < slips.size and track.seen[at + step] and not slips[at + step]:
        at += step
    is_seen = 0 <= at + step < slips.size and slips[at + step]
    return at, track.interval if is_seen else math.inf
