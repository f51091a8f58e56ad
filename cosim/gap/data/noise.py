"""Noise of a tracker from its own data, and samples that are no part of the motion.

A combination of four neighbouring samples that no parabola shows in (the third difference, with
weights for the times as they are, of unit norm) holds the noise and next to nothing of the motion.
Stretches with a gap are left out. The scale is Huber's: as good as the plain standard deviation for
Gaussian noise within 5 %, and little moved by corners or by outliers that were not recognised.

Outliers are taken out without harm to corners. A sample is one where everything that its neighbours
say of it is wrong to the same side: the chord between the nearest two and the cubic through two on
either side by more than noise can do, and the lines through the two before and the two after as
well. At a corner (re-stick, break-away) one of these lines still holds. The clearest outlier of a
neighbourhood goes first: the good samples beside it are then judged without it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy import stats
from scipy.ndimage import maximum_filter1d
from scipy.optimize import fixed_point

from cosim.gap.data.errors import CampaignError
from cosim.gap.data.measured import CHANNELS, MeasuredRun

#: Part of all differences up to which half of them are the rounding of numbers that repeat.
REPEATS = 1e-9
#: Samples beyond this many standard deviations count as if they were there (Huber's proposal 2).
HUBER = 2.0
#: Variance of a standard deviate that is clipped there.
CLIPPED = stats.chi2.cdf(HUBER**2, 3) + HUBER**2 * stats.chi2.sf(HUBER**2, 1)
#: A gap: longer than this many median intervals.
GAP = 2.5
#: Deviation from chord and cubic, in their own standard deviations, that noise does not reach:
#: together with the lines' less than one sample in 1e6.
THRESHOLD = 5.0
#: The same for the lines, which only have to protect corners.
ONE_SIDED = 2.0
#: The jump stands out from the disagreement of the neighbours among themselves by this factor.
CLEAR = 3.0
#: Losing a mark spoils up to this many samples in a row.
LONGEST = 3
PASSES = 30


def difference_noise(time: np.ndarray, values: np.ndarray) -> float:
    """Standard deviation of a sample's noise; NaN with fewer than 8 stretches of 4 samples.

    Parameters
    ----------
    time : (n,) array, s, increasing
    values : (n,) array, NaN where missing
    """
    combined = _third_differences(time, values)
    return _huber_scale(combined) if len(combined) >= 8 else math.nan


def _third_differences(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Combinations of four neighbouring samples that no parabola shows in, of unit norm."""
    there = np.isfinite(values)
    t, v = time[there], values[there]
    if len(t) < 4:
        return np.empty(0)
    nodes, samples = (sliding_window_view(one, 4).T for one in (t, v))
    apart = nodes[:, None] - nodes[None] + np.eye(4)[:, :, None]
    weights = 1.0 / np.prod(apart, axis=1)
    weights /= np.linalg.norm(weights, axis=0)
    whole = np.max(np.diff(nodes, axis=0), axis=0) <= GAP * np.median(np.diff(time))
    return np.asarray(np.sum(weights * samples, axis=0)[whole])


def _huber_scale(values: np.ndarray) -> float:
    """Standard deviation about zero, robust: Huber's proposal 2 with the location known."""
    scale = float(np.median(np.abs(values))) / stats.norm.ppf(0.75)
    whole = float(np.sqrt(np.mean(values**2))) if values.size else math.nan
    if scale <= REPEATS * whole:  # half of the samples repeat: a coarse reading of the tracker
        return whole
    if not math.isfinite(scale):
        return math.nan
    size = np.abs(values / scale)  # squares of large numbers overflow

    def better(part: float) -> float:
        return math.sqrt(float(np.mean(np.minimum(size, HUBER * part) ** 2)) / CLIPPED)

    # it grows with its argument and is bounded, so that the plain iteration settles on any samples
    settled = fixed_point(better, 1.0, xtol=1e-9, maxiter=5000, method="iteration")
    return float(scale * settled)


def with_noise(
    runs: tuple[MeasuredRun, ...], given: Mapping[str, float]
) -> tuple[tuple[MeasuredRun, ...], dict[str, float], tuple[str, ...], list[str]]:
    """Runs with their noise, that of the campaign, which is estimated, and remarks.

    Runs that agree share one estimate, else each has its own, and the campaign their median.
    """
    found: dict[str, dict[str, float]] = {run.name: {} for run in runs}
    overall, remarks = dict(given), []
    for channel in CHANNELS:
        there = [run for run in runs if run.track and channel in run.track.channels]
        values = [given.get(channel, 0.0)] * len(there)
        if there and channel not in given:
            values = _estimated(channel, there)
            overall[channel] = float(np.median(values))
        if len(set(values)) > 1:
            span = f"{min(values):.2g} to {max(values):.2g}"
            own = f"noise of {channel} differs from run to run ({span}): each run has its own"
            remarks.append(own)
        for run, value in zip(there, values, strict=True):
            found[run.name][channel] = value
    estimated = tuple(name for name in overall if name not in given)
    return tuple(replace(run, noise=found[run.name]) for run in runs), overall, estimated, remarks


def _estimated(channel: str, runs: list[MeasuredRun]) -> list[float]:
    """Noise of each run, pooled where the runs agree."""
    values = [difference_noise(run.motion.time, run.motion[channel]) for run in runs]
    counts = [int(np.count_nonzero(np.isfinite(run.motion[channel]))) for run in runs]
    silent = [run.file for run, value in zip(runs, values, strict=True) if not value > 0.0]
    if silent:
        raise CampaignError(
            f"{silent[0]}: column {channel}: no noise can be estimated (no two samples differ, "
            f"or too few in a row), allowed is noise.{channel} in campaign.toml"
        )
    pooled = float(np.sqrt(np.average(np.square(values), weights=counts)))
    return [pooled] * len(runs) if _agree(values, counts) else values


def _agree(estimates: Sequence[float], counts: Sequence[int]) -> bool:
    """Whether estimates of a standard deviation from so many samples each may be one and the same.

    A difference-based estimate of n samples scatters by about sqrt(2.3 / (2 n)); a spread of up to
    5 of these, or 5 %, is no reason to treat runs differently.
    """
    log = np.log(np.asarray(estimates, dtype=float))
    spread = np.maximum(5.0 * np.sqrt(2.3 / (2.0 * np.asarray(counts, dtype=float))), 0.05)
    return bool(np.all(np.abs(log - np.median(log)) <= spread))


def without_outliers(time: np.ndarray, values: np.ndarray) -> np.ndarray:
    """``values`` with outliers as NaN.

    Parameters
    ----------
    time : (n,) array, s, increasing
    values : (n,) array, NaN where missing
    """
    kept = values.copy()
    for _ in range(PASSES):
        noise = difference_noise(time, kept)
        found = [_outlying(time, kept, noise, width) for width in range(1, LONGEST + 1)]
        bad = next((rows for rows in found if rows.any()), None)
        if bad is None:
            break
        kept[bad] = np.nan
    return kept


def _outlying(time: np.ndarray, values: np.ndarray, noise: float, width: int) -> np.ndarray:
    """First and last samples of rows of ``width`` whose neighbours contradict both.

    What lies between them is asked again without them: it may be good.
    """
    there = np.flatnonzero(np.isfinite(values))
    found = np.zeros(len(values), dtype=bool)
    if len(there) < width + 4 or not noise > 0.0:
        return found
    t, v = time[there], values[there]
    starts = np.arange(2, len(there) - width - 1)
    around = np.stack([starts - 2, starts - 1, starts + width, starts + width + 1])
    ends = {0, width - 1}
    score = np.min([_contradiction(t, v, around, starts + place, noise) for place in ends], axis=0)
    clearest = (score > THRESHOLD) & (score == maximum_filter1d(score, 2 * LONGEST + 1))
    for place in ends:
        found[there[starts[clearest] + place]] = True
    return found


def _contradiction(
    t: np.ndarray, v: np.ndarray, around: np.ndarray, target: np.ndarray, noise: float
) -> np.ndarray:
    """How far targets are from what neighbours say, in standard deviations; 0 for no outlier."""
    predictions = (around[1:3], around, around[:2], around[2:])  # chord, cubic, before, after
    weights = [_lagrange(t, nodes, target) for nodes in predictions]
    told = zip(weights, predictions, strict=True)
    predicted = np.stack([np.sum(w * v[nodes], axis=0) for w, nodes in told])
    sd = noise * np.stack([np.sqrt(1.0 + np.sum(w * w, axis=0)) for w in weights])
    deviation = v[target] - predicted
    score = np.abs(deviation) / sd
    middle = np.median(predicted, axis=0)
    disagreement = np.median(np.abs(predicted - middle), axis=0)
    contradicted = (
        (np.abs(np.sum(np.sign(deviation), axis=0)) == len(predictions))
        & (np.min(score[2:], axis=0) > ONE_SIDED)
        & (np.abs(v[target] - middle) > CLEAR * disagreement)
    )
    return np.where(contradicted, np.min(score[:2], axis=0), 0.0)


def _lagrange(t: np.ndarray, nodes: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Weights (k, n) of the polynomial through k samples at the target's time."""
    own = np.eye(len(nodes))[:, :, None]
    away, apart = t[target] - t[nodes], t[nodes][:, None] - t[nodes][None]
    return np.asarray(np.prod(np.where(own == 1.0, 1.0, away[None]) / (apart + own), axis=1))
