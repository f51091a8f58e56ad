"""Noise that a tracker's filter has passed: no longer white, and underestimated by differences.

White noise behind a filter K has the correlation r(j h) = int K(u) K(u + j h) du between samples j
intervals h apart. An estimate from combinations of neighbours (Sum w_i x_i, Sum w_i^2 = 1, no
parabola) then sees the part

    Sum_ij w_i w_j r((i - j) h) / r(0)

of its variance, and a sum of squares of n samples has fewer degrees of freedom than n,
n / Sum_j (r(j h) / r(0))^2. A filter before which there was noise makes a gap above 1 that no
physics repairs: the noise is what is wrong. A white part, added after the filter (rounding), covers
the coloured one where it is larger.
"""

from __future__ import annotations

import numpy as np

#: Third difference, of unit norm.
_WEIGHTS = np.array([1.0, -3.0, 3.0, -1.0]) / np.sqrt(20.0)
#: A filter's memory, in its widths.
_MEMORY = 12.0


def correlation(lags: np.ndarray, width: float = 0.0, constant: float = 0.0) -> np.ndarray:
    """(k,) of noise at lags (k,), s, behind a Gaussian (width, s) or an exponential (constant, s).

    exp(-lag^2 / (4 width^2)) and exp(-lag / constant).
    """
    result = (np.abs(lags) < 1e-300).astype(float)
    if width > 0.0:
        result = np.exp(-0.25 * (lags / width) ** 2)
    elif constant > 0.0:
        result = np.exp(-np.abs(lags) / constant)
    return result


def seen_by_differences(interval: float, width: float = 0.0, constant: float = 0.0) -> float:
    """Estimate from third differences over the true standard deviation, of samples so far apart."""
    apart = np.abs(np.subtract.outer(np.arange(4), np.arange(4))) * interval
    matrix = correlation(apart.ravel(), width, constant).reshape(4, 4)
    return float(np.sqrt(max(_WEIGHTS @ matrix @ _WEIGHTS, 0.0)))


def independent_part(interval: float, width: float = 0.0, constant: float = 0.0) -> float:
    """Degrees of freedom of a sum of squares, per sample."""
    count = int(np.ceil(_MEMORY * max(width, constant) / interval)) + 1
    lags = np.arange(-count, count + 1) * interval
    return float(1.0 / np.sum(correlation(lags, width, constant) ** 2))
