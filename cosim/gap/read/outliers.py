"""Samples that are no part of the motion, taken out without harm to corners.

A sample is an outlier where everything that its neighbours say of it is wrong by the same jump:
the line through the two samples before, the line through the two after, the chord between and the
cubic through all four. At a corner (re-stick, break-away) one side still predicts the sample.
"""

from __future__ import annotations

import numpy as np

from cosim.gap.read.noise import difference_noise

#: Deviation from every prediction, in its own standard deviations, that noise does not reach: four
#: predictions at once, each beyond 5, is less than one sample in 1e7.
THRESHOLD = 5.0
#: The jump stands out from the disagreement of the neighbours among themselves by this factor.
CLEAR = 3.0
#: Losing a mark spoils up to this many samples in a row.
LONGEST = 3
PASSES = 5


def without_outliers(time: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, int]:
    """``values`` with outliers as NaN, and their number.

    Parameters
    ----------
    time : (n,) array, s, increasing
    values : (n,) array, NaN where missing
    """
    kept = values.copy()
    for _ in range(PASSES):
        noise = difference_noise(time, kept)
        bad = np.zeros(len(kept), dtype=bool)
        for width in range(1, LONGEST + 1):
            bad |= _outlying(time, kept, noise, width)
        if not bad.any():
            break
        kept[bad] = np.nan
    return kept, int(np.count_nonzero(np.isfinite(values) & np.isnan(kept)))


def _outlying(time: np.ndarray, values: np.ndarray, noise: float, width: int) -> np.ndarray:
    """Samples that lie in a row of ``width`` that their neighbours all contradict."""
    there = np.flatnonzero(np.isfinite(values))
    found = np.zeros(len(values), dtype=bool)
    if len(there) < width + 4 or not noise > 0.0:
        return found
    t, v = time[there], values[there]
    starts = np.arange(2, len(there) - width - 1)
    around = np.stack([starts - 2, starts - 1, starts + width, starts + width + 1])
    clear = np.ones(len(starts), dtype=bool)
    sign = np.zeros(len(starts))
    for place in range(width):
        deviation, allowance = _contradiction(t, v, around, starts + place, noise)
        clear &= np.abs(deviation) > allowance
        sign += np.sign(deviation)
    for place in range(width):
        found[there[starts[clear] + place]] = True
    return found


def _contradiction(
    t: np.ndarray, v: np.ndarray, around: np.ndarray, target: np.ndarray, noise: float
) -> tuple[np.ndarray, np.ndarray]:
    """Smallest deviation of the targets from the predictions, and what would be no outlier."""
    weights = [
        _lagrange(t, around[:2], target),
        _lagrange(t, around[2:], target),
        _lagrange(t, around[1:3], target),
        _lagrange(t, around, target),
    ]
    rows = (around[:2], around[2:], around[1:3], around)
    predicted = np.stack([np.sum(w * v[r], axis=0) for w, r in zip(weights, rows, strict=True)])
    sd = np.stack([np.sqrt(1.0 + np.sum(w * w, axis=0)) for w in weights]) * noise
    middle = np.median(predicted, axis=0)
    spread = np.median(np.abs(predicted - middle), axis=0)
    deviation = v[target] - predicted
    least = np.min(np.abs(deviation) / sd, axis=0)
    same_side = np.abs(np.sum(np.sign(deviation), axis=0)) == len(deviation)
    size = np.where(same_side & (least > THRESHOLD), np.abs(v[target] - middle), 0.0)
    return size, CLEAR * spread


def _lagrange(t: np.ndarray, nodes: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Weights (k, n) of the polynomial through k samples at the target's time."""
    at = t[target]
    weights = np.ones((len(nodes), len(target)))
    for i, node in enumerate(nodes):
        for j, other in enumerate(nodes):
            if i != j:
                weights[i] *= (at - t[other]) / (t[node] - t[other])
    return weights
