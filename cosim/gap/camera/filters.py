"""A tracker's filter at work on a path that is known at some times with its velocity.

Between the times the path is the cubic that has their places and velocities (Hermite): exact in a
stick, and of an error of A h^2 / 100 where the acceleration jumps by A within an interval h, a
hundredth of a usual noise at sixty frames a second. Before its first sample and after its last one
a filter has nothing: it is taken to hold these (the recursion of an exponential filter does so,
and "nearest" of a Gaussian one).
"""

from __future__ import annotations

import math

import numpy as np
from scipy.interpolate import CubicHermiteSpline

#: A Gaussian is cut off at so many standard deviations, where 6e-5 of it are left, and summed at so
#: many points a standard deviation: exact to exp(-2 pi^2 2.5^2) for what is smooth.
_REACH, _POINTS = 4.0, 2.5
#: Ends of the panels, in time constants, over which an exponential is integrated: 4e-6 of it is
#: left behind the last; and the points in each.
_PANELS, _IN_PANEL = (0.0, 0.5, 1.0, 2.0, 4.0, 7.5, 12.5), 4


def gaussian(width: float) -> tuple[np.ndarray, np.ndarray]:
    """Delays (k,), s, and weights (k,), of sum 1, of a Gaussian of that standard deviation, s."""
    count = int(_REACH * _POINTS)
    at = np.arange(-count, count + 1) / _POINTS
    weights = np.exp(-0.5 * at**2)
    return width * at, weights / weights.sum()


def exponential(constant: float) -> tuple[np.ndarray, np.ndarray]:
    """Delays (k,), s, and weights (k,), of sum 1, of a filter of the past, exp(-u / constant)."""
    points, weights = np.polynomial.legendre.leggauss(_IN_PANEL)
    begins, ends = np.array(_PANELS[:-1]), np.array(_PANELS[1:])
    half = 0.5 * (ends - begins)[:, None]
    at = (begins[:, None] + half * (1.0 + points)).ravel()
    weights = (half * weights).ravel() * np.exp(-at)
    return constant * at, weights / weights.sum()


def filtered(
    time: np.ndarray,
    path: np.ndarray,
    rates: np.ndarray,
    wanted: np.ndarray,
    kernel: tuple[np.ndarray, np.ndarray],
) -> np.ndarray:
    """(n, c) of a path (m, c) with velocities (m, c) at times (m,), filtered, at times (n,)."""
    delays, weights = kernel
    known = np.isfinite(path).all(axis=1) & np.isfinite(rates).all(axis=1)
    if known.sum() < 2:
        return np.full((wanted.size, path.shape[1]), math.nan)
    curve = CubicHermiteSpline(time[known], path[known], rates[known])
    result = np.zeros((wanted.size, path.shape[1]))
    for delay, weight in zip(delays, weights, strict=True):
        result += weight * curve(np.clip(wanted - delay, time[known][0], time[known][-1]))
    result[~np.isin(wanted, time[known])] = math.nan  # a model that gave up has no motion there
    return result
