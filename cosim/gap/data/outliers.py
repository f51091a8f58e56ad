"""Samples that are no part of the motion, taken out without harm to corners.

A sample is an outlier where everything that its neighbours say of it is wrong to the same side: the
chord between the nearest two and the cubic through two on either side by more than noise can do,
and the lines through the two before and the two after as well. At a corner (re-stick, break-away)
one of these lines still holds. The clearest outlier of a neighbourhood goes first: the good samples
beside it are then judged without it.
"""

from __future__ import annotations

import numpy as np
from scipy.ndimage import maximum_filter1d

from cosim.gap.data.noise import difference_noise

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
        found = [_outlying(time, kept, noise, width) for width in range(1, LONGEST + 1)]
        bad = next((rows for rows in found if rows.any()), None)
        if bad is None:
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
    score = np.min(
        [_contradiction(t, v, around, starts + place, noise) for place in range(width)], axis=0
    )
    clearest = (score > THRESHOLD) & (score == maximum_filter1d(score, 2 * LONGEST + 1))
    for place in range(width):
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
