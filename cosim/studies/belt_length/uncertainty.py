"""How sure the drift is, and what the doubt is made of: Sobol indices, single changes.

Variance-based sensitivity after Saltelli 2010: Sobol's sequence, first-order and total indices with
95 % intervals. They need some 1e5 drifts, so a polynomial stands in for the model in
each of the answers that a rise is made of (`rigs`); quantiles are of the model's own rises.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import sobol_indices, uniform
from scipy.stats import t as student

from thermal.arrays import Array

from .case import Case
from .rigs import MOST_MELTING, Rigs
from .unknowns import ENTRY, INTERFACE, Melts, Unknown, answers, combined, needs, weights, with_one

#: Interval that is told, quantiles.
INTERVAL = (0.05, 0.95)
#: Of Sobol's sequence for the indices, and how often, scrambled anew: their 95 % intervals, from
#: the spread of these, are then below 0.05.
SEQUENCE, REPLICATES = 2**10, 8


#: What is known of an unknown, by name, as the files have it.
Record = dict[str, Any]
#: Sobol indices, with half-widths of their 95 % intervals.
INDICES = ("first_order", "first_order_half_width", "total", "total_half_width")


@dataclass(frozen=True)
class Uncertainty:
    """Drift at the end of the runs, K: 5 %, 50 % and 95 % quantiles; influences and single
    changes, the largest first.

    influences: of each unknown its INDICES. single_changes: the drift, K, with one at either end of
    its range, drift_low and drift_high, the rest as the case is but for with_others (key -> value:
    one of nothing is seen in something); basis: where the range comes from.
    interface_...: the same quantiles of the interface's rise at constant speed. evaluations: runs
    of the model; unexplained: share of the variance that the polynomials of the influences miss, of
    each run by those without it. melts: share of the rigs in which the ice comes to melt; the rises
    are as if it did not.
    """

    low: float
    median: float
    high: float
    influences: tuple[Record, ...]
    single_changes: tuple[Record, ...]
    evaluations: int
    unexplained: float
    interface_low: float
    interface_median: float
    interface_high: float
    melts: float = 0.0

    def table(self) -> list[Record]:
        """Single change and indices of each unknown, side by side."""
        indices = {one["key"]: one for one in self.influences}
        return [one | indices[one["key"]] for one in self.single_changes]


def uncertainty(case: Case, samples: int, rigs: Rigs | None = None) -> Uncertainty | None:
    """Over what is not known, in place of the case's own numbers.

    None where the ice of more than MOST_MELTING of the rigs comes to melt.

    samples: rigs, a power of two from FEWEST_SAMPLES. rigs: those that are there already.
    """
    try:
        rigs = Rigs(case, samples) if rigs is None else rigs
        if rigs.melting > MOST_MELTING:
            return None
        single_changes = _single_changes(case, rigs.unknowns)
    except Melts:
        return None
    drifts = rigs.rises(ENTRY)
    return Uncertainty(
        *quantiles(drifts),
        _influences([one.key for one in rigs.unknowns], drifts, rigs.entry),
        single_changes,
        rigs.samples + 2 * len(single_changes),
        rigs.unexplained,
        *quantiles(rigs.rises(INTERFACE)),
        rigs.melting,
    )


def quantiles(rises: Array) -> tuple[float, float, float]:
    """At the ends of INTERVAL and in its middle: low, median, high."""
    low, median, high = np.quantile(rises, [INTERVAL[0], 0.5, INTERVAL[1]])
    return float(low), float(median), float(high)


def _single_changes(case: Case, unknowns: tuple[Unknown, ...]) -> tuple[Record, ...]:
    found = [
        {name: getattr(one, name) for name in ("key", "says", "unit", "low", "high")}
        | {f"drift_{end}": _drift_with(case, one.key, getattr(one, end)) for end in ("low", "high")}
        | {"with_others": needs(case, one.key), "basis": one.basis}
        for one in unknowns
        if not one.fixed
    ]
    return tuple(sorted(found, key=lambda one: -abs(one["drift_high"] - one["drift_low"])))


def _drift_with(case: Case, key: str, end: float) -> float:
    """Rise of the belt at entry, K, with one unknown at an end of its range."""
    values = with_one(case, key, end)
    # what does nothing in this rig need not be asked for, which saves more than half of the time
    columns = [column for column, weight in enumerate(weights(values)) if weight != 0.0]
    return float(combined(answers(case, values, columns)[[ENTRY]], values)[0])


def _influences(
    keys: Sequence[str], drifts: Array, drift_of: Callable[[Array], Array]
) -> tuple[Record, ...]:
    """Nothing has an influence on a drift that is always the same."""
    if np.ptp(drifts) == 0.0:
        return tuple({"key": key} | dict.fromkeys(INDICES, 0.0) for key in keys)
    replicates = np.stack([_indices(len(keys), drift_of, seed) for seed in range(REPLICATES)])
    quantile = student.ppf(0.975, REPLICATES - 1)
    doubt = quantile * replicates.std(axis=0, ddof=1) / np.sqrt(REPLICATES)
    rows = np.stack([replicates.mean(axis=0), doubt], axis=1).reshape(4, -1).T
    influences = [
        {"key": key} | dict(zip(INDICES, row, strict=True))
        for key, row in zip(keys, rows.tolist(), strict=True)
    ]
    return tuple(sorted(influences, key=lambda one: -one["total"]))


def _indices(count: int, drift_of: Callable[[Array], Array], seed: int) -> Array:
    """First-order and total (2, unknowns), from a scrambled sequence of its own."""
    found = sobol_indices(
        func=lambda shares: drift_of(shares.T), n=SEQUENCE, dists=[uniform()] * count, rng=seed
    )
    return np.stack([np.ravel(found.first_order), np.ravel(found.total_order)])
