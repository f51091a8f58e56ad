"""How a misfit depends on a variable: bins with errors, and a test against no dependence."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from scipy import stats

#: Bins of a variable that changes within a run.
BINS = 8
#: Natural logarithm of the smallest probability that is computed exactly.
SMALLEST = -600.0


@dataclass(frozen=True)
class Dependence:
    """A misfit in bins of a variable.

    Attributes
    ----------
    variable : key of `VARIABLES`
    centre : (b,) mean of the variable in each bin
    value, error : (b,) misfit in the bin and its standard error
    statistic : F of the bins' values against one value for all
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


def bin_edges(values: np.ndarray, per_run: bool) -> np.ndarray:
    """Edges of bins with about as many values in each; one bin for each value that repeats."""
    values = values[np.isfinite(values)]
    if not values.size:
        return np.empty(0)
    unique = np.unique(values)
    if per_run and len(unique) <= BINS:
        between = 0.5 * (unique[1:] + unique[:-1])
        return np.concatenate([[-np.inf], between, [np.inf]])
    edges = np.unique(np.quantile(values, np.linspace(0.0, 1.0, BINS + 1)[1:-1]))
    return np.concatenate([[-np.inf], edges, [np.inf]])


def membership(values: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """(n, b) 1 where a value is in a bin; a value that is NaN is in none."""
    place = np.searchsorted(edges, values, side="left") - 1
    inside = (place[:, None] == np.arange(len(edges) - 1)) & np.isfinite(values)[:, None]
    return inside.astype(float)


def log10_chance(statistic: float, freedom: tuple[int, int]) -> float:
    """log10 of the probability that F reaches the statistic by chance."""
    if not (statistic > 0.0 and min(freedom) > 0):
        return 0.0
    chance = float(stats.f.logsf(statistic, *freedom))
    if chance > SMALLEST:
        return chance / math.log(10.0)
    # beyond what a double holds: the leading factor of the tail
    return -0.5 * freedom[1] * math.log10(1.0 + freedom[0] * statistic / freedom[1])
