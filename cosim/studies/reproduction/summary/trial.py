"""A model that has been searched: its table, its best draw, and what both say."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.stats import chi2

from .result import FittedSummary
from .score import Target, best, chi_square, distances, gap, misfit, scatter
from .table import Draw
from .ways import Span, Way

#: misfit by which a draw may be worse than the best and still lie in the 95 % interval (one number)
WITHIN = 3.84


@dataclass(frozen=True)
class Trial:
    """A way, everything that was tried of it, and the scatter of its kin (n,)."""

    way: Way
    draws: tuple[Draw, ...] = field(repr=False)
    target: Target
    kin: np.ndarray = field(repr=False)

    @classmethod
    def of(cls, way: Way, draws: Sequence[Draw], target: Target, kin: np.ndarray) -> Trial:
        """From a table in which at least one draw has several seeds."""
        return cls(way, tuple(draws), target, kin)

    @property
    def close(self) -> list[Draw]:
        """Draws that were looked at with all seeds."""
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
        return self.way.added * math.log(len(self.target.sizes))

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
        freedom = len(self.target.sizes) - self.way.added - self._free_friction
        found = chi_square(self.best, self.target, self.kin)
        return float(chi2.sf(found, max(freedom, 1)))

    @property
    def _free_friction(self) -> int:
        """Coefficients that nothing is known of: a known one brings its own observation."""
        spans = self.way.spans
        return sum(s.key.startswith("friction.") and s.prior is None for s in spans)

    @property
    def friction_spans(self) -> tuple[Span, ...]:
        """What is searched of friction: the first spans of every way."""
        return tuple(s for s in self.way.spans if s.key.startswith("friction."))

    def intervals(self) -> dict[str, tuple[float, float]]:
        """block.parameter -> range over the draws that are nearly as good as the best."""
        limit = self.misfit + WITHIN
        good = [d for d in self.draws if misfit(d, self.target, self.kin) <= limit]
        return {
            span.key: (
                min(one.values[span.key] for one in good),
                max(one.values[span.key] for one in good),
            )
            for span in self.way.spans
        }

    def fitted(self) -> FittedSummary:
        """The best draw beside the observed figures."""
        return fitted(self.best, self)


def fitted(one: Draw, trial: Trial) -> FittedSummary:
    """A draw of the trial's way beside the observed figures."""
    return FittedSummary(
        values=dict(one.values),
        shown=one.mean,
        scatter=scatter(one, trial.kin),
        residuals=distances(one.mean, trial.target),
        gap=gap(one.mean, trial.target),
        held_out_gap=trial.held_out_gap,
        lack_of_fit=trial.lack_of_fit,
    )
