"""Noise of a tracker from its own data.

A combination of four neighbouring samples that no parabola shows in (the third difference, with
weights for the times as they are, of unit norm) holds the noise and next to nothing of the motion.
Stretches with a gap are left out. The scale is Huber's: as good as the plain standard deviation for
Gaussian noise within 5 %, and little moved by corners or by outliers that were not recognised.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from scipy import stats

#: Samples beyond this many standard deviations count as if they were there (Huber's proposal 2).
HUBER = 2.0
#: A gap: longer than this many median intervals.
GAP = 2.5


def difference_noise(time: np.ndarray, values: np.ndarray) -> float:
    """Standard deviation of a sample's noise; NaN with fewer than 8 stretches of 4 samples.

    Parameters
    ----------
    time : (n,) array, s, increasing
    values : (n,) array, NaN where missing
    """
    combined = third_differences(time, values)
    return huber_scale(combined) if len(combined) >= 8 else math.nan


def third_differences(time: np.ndarray, values: np.ndarray, lag: int = 1) -> np.ndarray:
    """Combinations of four samples, ``lag`` apart, that no parabola shows in, of unit norm."""
    there = np.isfinite(values)
    t, v = time[there], values[there]
    count = len(t) - 3 * lag
    if count < 1:
        return np.empty(0)
    nodes = np.stack([t[i * lag : i * lag + count] for i in range(4)])
    weights = np.ones((4, count))
    for i in range(4):
        for j in range(4):
            if i != j:
                weights[i] /= nodes[i] - nodes[j]
    weights /= np.sqrt(np.sum(weights**2, axis=0))
    samples = np.stack([v[i * lag : i * lag + count] for i in range(4)])
    whole = np.max(np.diff(nodes, axis=0), axis=0) <= GAP * lag * np.median(np.diff(time))
    return np.sum(weights * samples, axis=0)[whole]


def huber_scale(values: np.ndarray) -> float:
    """Standard deviation about zero, robust: Huber's proposal 2 with the location known."""
    scale = float(np.median(np.abs(values))) / stats.norm.ppf(0.75)
    if scale == 0.0:  # half of the samples repeat: a coarse reading of the tracker
        return float(np.sqrt(np.mean(values**2)))
    inside = stats.norm.cdf(HUBER) - stats.norm.cdf(-HUBER)
    within = inside - 2.0 * HUBER * stats.norm.pdf(HUBER)
    expected = within + HUBER**2 * (1.0 - inside)
    for _ in range(50):
        clipped = np.minimum(np.abs(values), HUBER * scale)
        better = math.sqrt(float(np.mean(clipped**2)) / expected)
        if abs(better - scale) <= 1e-9 * scale:
            break
        scale = better
    return scale


def agree(estimates: Sequence[float], counts: Sequence[int]) -> bool:
    """Whether estimates of a standard deviation from so many samples each may be one and the same.

    A difference-based estimate of n samples scatters by about sqrt(2.3 / (2 n)); a spread of up to
    5 of these, or 5 %, is no reason to treat runs differently.
    """
    log = np.log(np.asarray(estimates, dtype=float))
    spread = np.maximum(5.0 * np.sqrt(2.3 / (2.0 * np.asarray(counts, dtype=float))), 0.05)
    return bool(np.all(np.abs(log - np.median(log)) <= spread))
