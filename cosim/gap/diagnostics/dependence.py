"""How a misfit depends on a variable: a curve with errors, and a test against no dependence."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from scipy import stats

#: Corners of the polygon over a variable that changes within a run.
BINS = 8
#: Part of the values beyond the first and the last corner, where the curve is level.
EDGE = 0.05
#: Natural logarithm of the smallest probability that is computed exactly.
SMALLEST = -600.0


@dataclass(frozen=True)
class Dependence:
    """A misfit as a polygon over a variable.

    Attributes
    ----------
    variable : key of `VARIABLES`
    centre : (b,) the variable at the polygon's corners
    value, error : (b,) misfit there and its standard error
    statistic : F of the polygon against one value for all
    freedom : its two degrees of freedom
    log10_p : logarithm of the probability of as large an F by chance, not corrected for the number
        of variables that were looked at
    """

    variable: str
    centre: np.ndarray = field(repr=False)
    value: np.ndarray = field(repr=False)
    error: np.ndarray = field(repr=False)
    statistic: float
    freedom: tuple[int, int]
    log10_p: float


def nodes_of(values: np.ndarray, kind: str) -> np.ndarray:
    """Where a dependence is told: at each value that repeats, or so that bins are equally full.

    kind : "per run", "phase" (0 to 1, once around) or "within"
    """
    values = values[np.isfinite(values)]
    if not values.size:
        return values
    if kind == "phase":
        return np.arange(BINS) / BINS
    unique = np.unique(values)
    if kind == "per run" and len(unique) <= BINS:
        return unique
    return np.unique(np.quantile(values, np.linspace(EDGE, 1.0 - EDGE, BINS)))


def shares(values: np.ndarray, nodes: np.ndarray, kind: str) -> np.ndarray:
    """(n, b) how much of each value belongs to each node; the sum is 1, or 0 for a NaN.

    Between two nodes the shares are linear: what is fitted is a polygon, not a flight of stairs.
    """
    there = np.isfinite(values)
    if kind == "per run" and len(nodes) > 1:
        nearest = np.abs(values[:, None] - nodes).argmin(axis=1)
        return (nearest[:, None] == np.arange(len(nodes))) * there[:, None].astype(float)
    if kind == "phase":
        apart = np.abs(values[:, None] - nodes)
        apart = np.minimum(apart, 1.0 - apart) * len(nodes)
        return np.nan_to_num(np.maximum(1.0 - apart, 0.0))
    hats = np.stack([np.interp(values, nodes, row) for row in np.eye(len(nodes))], axis=1)
    return np.nan_to_num(hats) * there[:, None]


def log10_chance(statistic: float, freedom: tuple[int, int]) -> float:
    """log10 of the probability that F reaches the statistic by chance."""
    if not (statistic > 0.0 and min(freedom) > 0):
        return 0.0
    chance = float(stats.f.logsf(statistic, *freedom))
    if chance > SMALLEST:
        return chance / math.log(10.0)
    # beyond what a double holds: the leading factor of the tail
    return -0.5 * freedom[1] * math.log10(1.0 + freedom[0] * statistic / freedom[1])
