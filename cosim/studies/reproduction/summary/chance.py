"""How often chance alone makes some effect of the catalogue look as good as the best one does.

Parametric bootstrap of the best of all: figures are drawn from the plain model (its own scatter and
the observations' standard deviations), and the whole catalogue is fitted to them again, from the
tables of draws, so that choosing the best of many is part of what chance may do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .score import spread
from .trial import Trial

BOOTSTRAPS = 999


@dataclass(frozen=True)
class Table:
    """Draws as arrays: means (d, n), variances of a realisation (d, n), prices (d,)."""

    means: np.ndarray
    variances: np.ndarray
    prices: np.ndarray

    @classmethod
    def of(cls, trials: Sequence[Trial]) -> Table:
        """All draws of all trials; a price is the surprise and that of the numbers added."""
        means, variances, prices = [], [], []
        for trial in trials:
            for one in trial.draws:
                means.append(one.mean)
                variances.append(spread(one, trial.kin))
                prices.append(one.surprise + trial.price)
        return cls(np.array(means), np.array(variances), np.array(prices))

    def least(self, sizes: np.ndarray, sds: np.ndarray) -> float:
        """The least BIC of all draws for the figures ``sizes``."""
        wider = 1.0 + self.variances / sds**2
        terms = ((self.means - sizes) / sds) ** 2 / wider + np.log(wider)
        return float((terms.sum(axis=1) + self.prices).min())


def p_of_the_best(plain: Trial, others: Sequence[Trial], seed: int) -> float:
    """Probability, under the plain model, of an improvement like that of the best of ``others``."""
    rng = np.random.default_rng(seed)
    target, rows = plain.target, plain.best.shown
    before, after = Table.of([plain]), Table.of(others)

    def gained(sizes: np.ndarray) -> float:
        return before.least(sizes, target.sds) - after.least(sizes, target.sds)

    found = gained(target.sizes)
    as_good = 0
    for _ in range(BOOTSTRAPS):
        row = rows[rng.integers(len(rows))]
        as_good += gained(row + target.sds * rng.standard_normal(len(row))) >= found
    return (1 + as_good) / (1 + BOOTSTRAPS)
