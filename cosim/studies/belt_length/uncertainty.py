"""How sure the drift is, and what the doubt is made of: Sobol indices (SALib), single changes.

Variance-based sensitivity after Saltelli 2010: Sobol's sequence, first-order and total indices with
bootstrapped 95 % intervals. They need some 1e5 drifts, so a polynomial stands in for the model in
each of the three answers that a rise is made of (`unknowns`); how much of the variance it
misses is measured on runs of the model that it has not seen.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import NDArray
from SALib.analyze import sobol as analyse
from SALib.sample import sobol as sample
from scipy.stats import qmc

from .case import Case
from .surrogate import fitted
from .unknowns import (
    ENTRY,
    INTERFACE,
    SHAPING,
    UNKNOWNS,
    Melts,
    Unknown,
    answers,
    combined,
    needs,
    with_one,
)

Array = NDArray[np.float64]

#: Interval that is told, quantiles.
INTERVAL = (0.05, 0.95)
#: Of Sobol's sequence for the indices: their 95 % intervals are then below 0.05.
SEQUENCE = 2**13
#: Fewest runs of the model through which a polynomial is laid; a quarter more test it.
FEWEST_SAMPLES = 32
_TESTED = 0.25


@dataclass(frozen=True)
class Influence:
    """Sobol indices of one unknown, with half-widths of their 95 % intervals."""

    key: str
    first_order: float
    first_order_half_width: float
    total: float
    total_half_width: float


@dataclass(frozen=True)
class SingleChange:
    """The drift, K, with one unknown at either end of its range, the rest as the case is.

    with_others: what else is not as the case is, key -> value: one of nothing is seen in something.
    basis: where the range comes from.
    """

    key: str
    says: str
    unit: str
    low: float
    high: float
    drift_low: float
    drift_high: float
    with_others: dict[str, float]
    basis: str


@dataclass(frozen=True)
class Uncertainty:
    """Drift at the end of the runs, K: 5 %, 50 % and 95 % quantiles; influences and single
    changes, the largest first.

    interface_...: the same quantiles of the interface's rise at constant speed. evaluations: runs
    of the model; ...unexplained: share of the variance that the polynomials miss on the runs that
    they have not seen.
    """

    low: float
    median: float
    high: float
    influences: tuple[Influence, ...]
    single_changes: tuple[SingleChange, ...]
    evaluations: int
    unexplained: float
    interface_low: float
    interface_median: float
    interface_high: float
    interface_unexplained: float

    @property
    def widest_interval(self) -> float:
        """Largest half-width of the indices' 95 % intervals."""
        return max(max(one.first_order_half_width, one.total_half_width) for one in self.influences)

    def table(self) -> list[dict[str, object]]:
        """Single change and indices of each unknown, side by side."""
        indices = {one.key: asdict(one) for one in self.influences}
        return [asdict(one) | indices[one.key] for one in self.single_changes]


def uncertainty(case: Case, samples: int) -> Uncertainty | None:
    """Over UNKNOWNS in place of the case's own numbers; None where the ice comes to melt.

    samples: runs of the model for the polynomials, a power of two from FEWEST_SAMPLES.
    """
    tested = round(_TESTED * samples)
    draws = qmc.Sobol(len(SHAPING), rng=1)
    points = _levelled(np.concatenate((draws.random(samples), draws.random(tested))))
    values = _values(SHAPING, points)
    try:
        parts = np.array(
            [
                answers(case, {key: float(column[i]) for key, column in values.items()})
                for i in range(len(points))
            ]
        )
        single_changes = _single_changes(case)
    except Melts:
        return None
    entry, interface = (
        _in_place(points[:samples], parts[:samples, rise]) for rise in (ENTRY, INTERFACE)
    )

    problem = {
        "num_vars": len(UNKNOWNS),
        "names": [one.key for one in UNKNOWNS],
        "bounds": [[0.0, 1.0]] * len(UNKNOWNS),
    }
    drawn = sample.sample(problem, SEQUENCE, calc_second_order=False, seed=1)
    drifts = entry(drawn)
    low, median, high = _quantiles(drifts)
    # one point in each block of the sequence has all unknowns drawn anew
    interface_low, interface_median, interface_high = _quantiles(
        interface(drawn[:: len(UNKNOWNS) + 2])
    )
    return Uncertainty(
        low,
        median,
        high,
        _influences(problem, drifts),
        single_changes,
        samples + tested + 2 * len(UNKNOWNS),
        _unexplained(points[samples:], parts[samples:, ENTRY], entry),
        interface_low,
        interface_median,
        interface_high,
        _unexplained(points[samples:], parts[samples:, INTERFACE], interface),
    )


def _in_place(points: Array, parts: Array) -> Callable[[Array], Array]:
    """A rise, K, at points of the unit cube of all unknowns, from its A, B and C at some points."""
    surrogates = [fitted(points, column) for column in parts.T]

    def rise(shares: Array) -> Array:
        shaping = _levelled(shares[:, [not one.linear for one in UNKNOWNS]])
        return combined(
            np.stack([one(shaping) for one in surrogates], axis=1), _values(UNKNOWNS, shares)
        )

    return rise


def _quantiles(rises: Array) -> tuple[float, float, float]:
    low, median, high = np.quantile(rises, [INTERVAL[0], 0.5, INTERVAL[1]])
    return float(low), float(median), float(high)


def _values(unknowns: tuple[Unknown, ...], shares: Array) -> dict[str, Array]:
    return {one.key: one.at(shares[:, i]) for i, one in enumerate(unknowns)}


def _levelled(shares: Array) -> Array:
    """Shares of SHAPING, those of an unknown with levels in the middle of its level."""
    return np.stack([one.levelled(shares[:, i]) for i, one in enumerate(SHAPING)], axis=1)


def _unexplained(points: Array, parts: Array, rise: Callable[[Array], Array]) -> float:
    """Share of a rise's variance over unseen runs; the linear unknowns are drawn for each."""
    drawn = np.random.default_rng(1).random((len(points), len(UNKNOWNS)))
    drawn[:, [not one.linear for one in UNKNOWNS]] = points
    true = combined(parts, _values(UNKNOWNS, drawn))
    return float(np.mean((rise(drawn) - true) ** 2) / np.var(true))


def _single_changes(case: Case) -> tuple[SingleChange, ...]:
    found = []
    for one in UNKNOWNS:
        found.append(
            SingleChange(
                one.key,
                one.says,
                one.unit,
                one.low,
                one.high,
                _drift_with(case, one, one.low),
                _drift_with(case, one, one.high),
                needs(case, one.key),
                one.basis,
            )
        )
    return tuple(sorted(found, key=lambda one: -abs(one.drift_high - one.drift_low)))


def _drift_with(case: Case, one: Unknown, end: float) -> float:
    """Rise of the belt at entry, K, with one unknown at an end of its range."""
    values = with_one(case, one.key, end)
    parts = answers(case, values)[ENTRY][None, :]
    return float(combined(parts, {k: np.array([v]) for k, v in values.items()})[0])


def _influences(problem: dict, drifts: Array) -> tuple[Influence, ...]:
    """Nothing has an influence on a drift that is always the same."""
    keys = problem["names"]
    if np.ptp(drifts) == 0.0:
        return tuple(Influence(key, 0.0, 0.0, 0.0, 0.0) for key in keys)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", FutureWarning)
        found = analyse.analyze(problem, drifts, calc_second_order=False, seed=1)
    influences = [
        Influence(key, *(float(found[name][i]) for name in ("S1", "S1_conf", "ST", "ST_conf")))
        for i, key in enumerate(keys)
    ]
    return tuple(sorted(influences, key=lambda one: -one.total))
