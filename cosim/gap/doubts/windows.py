"""A record seen through short windows: three samples evenly apart, and straight stretches."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from cosim.gap.data import MeasuredRun, Track
from cosim.gap.data.sticks import coloured_noise

#: Part of a window by which its samples may lie off their places: jitter, not a gap.
JITTER = 0.1


def scatter(run: MeasuredRun) -> float:
    """Of a sample on any scale up to a small part of the period, m: noise, filtered or in steps."""
    seen = np.isfinite(run.motion.x)
    time, x = run.motion.time[seen], run.motion.x[seen]
    return max(run.noise["x"], coloured_noise(time, x, run.natural_frequency))


@dataclass(frozen=True)
class Triples:
    """x at t - h, t and t + h, (n,) arrays; h and t in s, x in m."""

    time: np.ndarray
    before: np.ndarray
    here: np.ndarray
    after: np.ndarray
    lag: float

    @property
    def velocities(self) -> tuple[np.ndarray, np.ndarray]:
        """Means over the first and over the second half, m/s."""
        return (self.here - self.before) / self.lag, (self.after - self.here) / self.lag


def triples(track: Track, lag: float) -> Triples:
    """Of every sample with neighbours about ``lag`` (s) away on both sides."""
    seen = np.isfinite(track.x)
    time, x = track.time[seen], track.x[seen]
    step = max(1, round(lag / track.interval))
    lag = step * track.interval
    middle = slice(step, len(time) - step)
    before, after = slice(None, max(len(time) - 2 * step, 0)), slice(2 * step, None)
    there = (np.abs(time[middle] - time[before] - lag) <= JITTER * lag) & (
        np.abs(time[after] - time[middle] - lag) <= JITTER * lag
    )
    return Triples(time[middle][there], x[before][there], x[middle][there], x[after][there], lag)
