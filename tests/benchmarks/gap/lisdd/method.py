"""LISDD: localised, identifiable sparse discovery of discrepancy (Y. Wang, arXiv:2606.23215, 2026).

From its abstract, which is all that was at hand: the known physics is fitted on a clean regime that
is found automatically; regimes with too much residual energy are flagged; in them one term of a
library is chosen by exhaustive holdout; a sample-split F-test confirms it, exact in finite samples;
over several discrepant regions the false discovery rate is controlled (not needed here: one region
is tested). What the abstract leaves open is decided here as the comments say.

The known physics is linear, y = P theta + e with e normal, independent and of the same variance.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import f as f_distribution

Array = NDArray[np.float64]

FLAG_LEVEL = 0.05  # of all regimes' energies together: what is flagged is then tested


@dataclass(frozen=True)
class Regression:
    """A discrepancy problem: n samples.

    y : (n,) what is observed; physics : (n, p) columns of the known model; library : term -> (n,)
    column; regime : (n,) int, the part of the operating space in which a sample lies
    """

    y: Array
    physics: Array
    library: Mapping[str, Array]
    regime: NDArray[np.int64]

    def part(self, rows: NDArray[np.bool_]) -> Regression:
        """Some of the samples."""
        library = {name: column[rows] for name, column in self.library.items()}
        return Regression(self.y[rows], self.physics[rows], library, self.regime[rows])


@dataclass(frozen=True)
class Found:
    """term : of the library that fits best; p : of the F-test, of it; flagged : regimes."""

    term: str
    p: float
    flagged: tuple[int, ...]


def fitted(columns: Array, y: Array) -> Array:
    """Least squares coefficients."""
    return np.asarray(np.linalg.lstsq(columns, y, rcond=None)[0], np.float64)


def squares(columns: Array, y: Array) -> float:
    """Sum of squares that least squares leave."""
    left = y - columns @ fitted(columns, y)
    return float(left @ left)


def energy_p(data: Regression, rows: NDArray[np.bool_], clean: NDArray[np.bool_]) -> float:
    """p of the residual energy of some samples, the physics fitted to clean ones (Chow's test).

    The clean samples' fit is extended by those in question: a free value each, so many more
    parameters. F = ((S_both - S_clean) / n_rows) / (S_clean / (n_clean - p)).
    """
    both = clean | rows
    inner = squares(data.physics[clean], data.y[clean])
    outer = squares(data.physics[both], data.y[both])
    extra, free = int(rows.sum()), int(clean.sum()) - data.physics.shape[1]
    return float(f_distribution.sf((outer - inner) / extra / (inner / free), extra, free))


def clean_regime(data: Regression) -> int:
    """The regime in which the physics, fitted there alone, leaves least per degree of freedom."""
    left = {}
    for name in np.unique(data.regime):
        rows = data.regime == name
        free = int(rows.sum()) - data.physics.shape[1]
        if free > 0:
            left[int(name)] = squares(data.physics[rows], data.y[rows]) / free
    return min(left, key=left.__getitem__)


def flagged_regimes(data: Regression) -> tuple[int, ...]:
    """Regimes that do not continue the clean one, taken up in the order of their energy.

    Bonferroni over the regimes: one is flagged in FLAG_LEVEL of the cases where nothing is missing,
    but for the choice of the clean one, which the confirming test does not rest on.
    """
    clean = data.regime == clean_regime(data)
    others = [int(name) for name in np.unique(data.regime[~clean])]
    level = FLAG_LEVEL / max(len(others), 1)
    while others:
        p = {name: energy_p(data, data.regime == name, clean) for name in others}
        best = max(p, key=p.__getitem__)
        if p[best] < level:
            return tuple(sorted(others))
        clean |= data.regime == best
        others.remove(best)
    return ()


def chosen_term(data: Regression, random: np.random.Generator) -> str:
    """Exhaustive holdout: each term fitted to one half and scored on the other, both ways."""
    half = random.permutation(len(data.y)) < len(data.y) // 2
    scores = {}
    for name, column in data.library.items():
        columns, error = np.column_stack([data.physics, column]), 0.0
        for rows in (half, ~half):
            left = data.y[~rows] - columns[~rows] @ fitted(columns[rows], data.y[rows])
            error += float(left @ left)
        scores[name] = error
    return min(scores, key=scores.__getitem__)


def f_test(data: Regression, rows: NDArray[np.bool_], term: str) -> float:
    """p of a term that acts in some samples only, beside the physics fitted to all of them.

    F = (S_0 - S_1) / (S_1 / (n - p - 1)) has Fisher's distribution with 1 and n - p - 1 degrees of
    freedom where the term is not there, whatever chose it, as long as that saw other samples.
    """
    local = np.where(rows, data.library[term], 0.0)
    with_term = np.column_stack([data.physics, local])
    left = squares(with_term, data.y)
    free = len(data.y) - with_term.shape[1]
    gained = squares(data.physics, data.y) - left
    return float(f_distribution.sf(gained / (left / free), 1, free))


def discover(data: Regression, random: np.random.Generator) -> Found:
    """Localise and choose on one half of the samples, test on the other.

    Where no regime is flagged the term is sought and tested everywhere, so that there is always a
    p-value, uniform where nothing is missing. A term that is found in some regimes acts there.
    """
    first = random.permutation(len(data.y)) < len(data.y) // 2
    exploring, confirming = data.part(first), data.part(~first)
    flagged = flagged_regimes(exploring)
    sought = flagged or tuple(int(name) for name in np.unique(data.regime))
    term = chosen_term(_local(exploring, sought), random)
    return Found(term, f_test(confirming, np.isin(confirming.regime, sought), term), flagged)


def _local(data: Regression, regimes: tuple[int, ...]) -> Regression:
    """The same with the library's terms switched off elsewhere."""
    rows = np.isin(data.regime, regimes)
    library = {name: np.where(rows, column, 0.0) for name, column in data.library.items()}
    return Regression(data.y, data.physics, library, data.regime)
