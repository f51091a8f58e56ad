"""How sure the drift is, and which of the unknown numbers matters: Sobol indices (SALib).

Variance-based sensitivity after Saltelli 2010; Sobol's sequence, first-order and total indices
with bootstrapped 95 % intervals.
"""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, replace

import numpy as np
from SALib.analyze import sobol as analyse
from SALib.sample import sobol as sample

from .case import Case
from .drift import run_drift

#: key of a case -> lowest, highest, drawn evenly in the logarithm; the first three of the rig's
#: description, the conductance from poor to next to perfect contact.
RANGES: dict[str, tuple[float, float, bool]] = {
    "h": (5.0, 25.0, False),
    "conductivity": (0.25, 2.0, False),
    "conductance": (1e3, 1e5, True),
}
#: Interval that is told, quantiles.
INTERVAL = (0.05, 0.95)


@dataclass(frozen=True)
class Influence:
    """Sobol indices of one unknown, with half-widths of their 95 % intervals."""

    key: str
    first_order: float
    first_order_half_width: float
    total: float
    total_half_width: float


@dataclass(frozen=True)
class Uncertainty:
    """Drift after 20 s, K: 5 %, 50 % and 95 % quantiles; influences, the largest first."""

    low: float
    median: float
    high: float
    influences: tuple[Influence, ...]
    evaluations: int


def uncertainty(case: Case, samples: int) -> Uncertainty:
    """Over RANGES in place of the case's own numbers; samples: a power of two."""
    problem = {
        "num_vars": len(RANGES), "names": list(RANGES),
        "bounds": [[math.log(low), math.log(high)] if logarithmic else [low, high]
                   for low, high, logarithmic in RANGES.values()],
    }
    points = sample.sample(problem, samples, calc_second_order=False, seed=1)
    for column, (_, _, logarithmic) in enumerate(RANGES.values()):
        if logarithmic:
            points[:, column] = np.exp(points[:, column])
    drifts = np.array([
        run_drift(replace(case, **dict(zip(RANGES, map(float, point), strict=True))))
        for point in points])
    low, median, high = np.quantile(drifts, [INTERVAL[0], 0.5, INTERVAL[1]])
    return Uncertainty(float(low), float(median), float(high), _influences(problem, drifts),
                       len(drifts))


def _influences(problem: dict, drifts: np.ndarray) -> tuple[Influence, ...]:
    """Nothing has an influence on a drift that is always the same."""
    if np.ptp(drifts) == 0.0:
        return tuple(Influence(key, 0.0, 0.0, 0.0, 0.0) for key in RANGES)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", FutureWarning)
        found = analyse.analyze(problem, drifts, calc_second_order=False, seed=1)
    influences = [
        Influence(key, *(float(found[name][i]) for name in ("S1", "S1_conf", "ST", "ST_conf")))
        for i, key in enumerate(RANGES)]
    return tuple(sorted(influences, key=lambda one: -one.total))
