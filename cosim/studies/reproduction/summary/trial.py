"""A model that has been searched: its table, its best draw, and whether chance does as well.

Chance: parametric bootstrap of the best of all. Figures are drawn from the plain model (its own
scatter and the observations' standard deviations), and the whole catalogue is fitted to them again,
from the tables of draws, so that choosing the best of many is part of what chance may do.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.stats import chi2

from .candidates import Candidate, Span
from .draws import Draw, Target, best, chi_square, distances, gap, misfit, scatter, spread

#: misfit by which a draw may be worse than the best and still lie in the 95 % interval (one number)
WITHIN = 3.84


@dataclass(frozen=True)
class FittedSummary:
    """A model beside the observed figures.

    values: block.parameter -> number. shown, scatter (n,): mean of each figure over the seeds and
    its standard deviation from seed to seed. residuals (n,): distance in the observations'
    standard deviations. gap: their root mean square. lack_of_fit: probability of figures this far
    off or farther, were the model (its scatter included) true.
    """

    values: Mapping[str, float]
    shown: np.ndarray
    scatter: np.ndarray
    residuals: np.ndarray
    gap: float
    held_out_gap: float
    lack_of_fit: float


@dataclass(frozen=True)
class Trial:
    """A candidate, everything that was tried of it, and the scatter of its kin (n,)."""

    candidate: Candidate
    draws: tuple[Draw, ...] = field(repr=False)
    target: Target
    kin: np.ndarray = field(repr=False)

    @classmethod
    def of(
        cls, candidate: Candidate, draws: Sequence[Draw], target: Target, kin: np.ndarray
    ) -> Trial:
        """From a table in which at least one draw has several seeds."""
        return cls(candidate, tuple(draws), target, kin)

    @property
    def close(self) -> list[Draw]:
        """Draws that were run with all seeds."""
        return [one for one in self.draws if one.seeds > 1]

    @property
    def best(self) -> Draw:
        """Least misfit of those."""
        return best(self.close, self.target, self.kin)

    @property
    def misfit(self) -> float:
        """Of the best."""
        return misfit(self.best, self.target, self.kin)

    @property
    def bic(self) -> float:
        """Misfit plus the price of the numbers that were added."""
        return self.misfit + self.price

    @property
    def price(self) -> float:
        """ln n for each number that was added."""
        return self.candidate.added * math.log(len(self.target.sizes))

    @property
    def held_out(self) -> np.ndarray:
        """(n,) distances of the figures, each predicted by the best fit to all the others."""
        found = []
        for i in range(len(self.target.sizes)):
            other = best(self.close, self.target.without(i), self.kin)
            found.append(distances(other.mean, self.target)[i])
        return np.array(found)

    @property
    def held_out_gap(self) -> float:
        """Root mean square of those."""
        return float(np.sqrt(np.mean(self.held_out**2)))

    @property
    def lack_of_fit(self) -> float:
        """Probability of figures this far off, were the best draw's model true."""
        freedom = len(self.target.sizes) - self.candidate.added - self._free_friction
        found = chi_square(self.best, self.target, self.kin)
        return float(chi2.sf(found, max(freedom, 1)))

    @property
    def _free_friction(self) -> int:
        """Coefficients that nothing is known of: a known one brings its own observation."""
        spans = self.candidate.spans
        return sum(s.key.startswith("friction.") and s.prior is None for s in spans)

    @property
    def friction_spans(self) -> tuple[Span, ...]:
        """What is searched of friction: the first spans of every candidate."""
        return tuple(s for s in self.candidate.spans if s.key.startswith("friction."))

    def intervals(self) -> dict[str, tuple[float, float]]:
        """block.parameter -> range over the draws that are nearly as good as the best."""
        limit = self.misfit + WITHIN
        good = [d for d in self.draws if misfit(d, self.target, self.kin) <= limit]
        return {
            span.key: (
                min(one.values[span.key] for one in good),
                max(one.values[span.key] for one in good),
            )
            for span in self.candidate.spans
        }

    def fitted(self) -> FittedSummary:
        """The best draw beside the observed figures."""
        return fitted(self.best, self)


def fitted(one: Draw, trial: Trial) -> FittedSummary:
    """A draw of the trial's candidate beside the observed figures."""
    return FittedSummary(
        values=dict(one.values),
        shown=one.mean,
        scatter=scatter(one, trial.kin),
        residuals=distances(one.mean, trial.target),
        gap=gap(one.mean, trial.target),
        held_out_gap=trial.held_out_gap,
        lack_of_fit=trial.lack_of_fit,
    )


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
