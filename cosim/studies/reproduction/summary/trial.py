"""What a whole trial of a model amounts to: its best draw, its price, and what chance would do."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.stats import chi2

from cosim.gap.result import Ranked, Score

from .candidates import Candidate
from .draws import Array, Draws, Target

#: misfit by which a draw may be worse than the best and still lie in the 95 % interval (one number)
WITHIN = 3.84
BOOTSTRAPS = 999


@dataclass(frozen=True)
class FittedSummary:
    """A model beside the observed figures.

    values: block.parameter -> number. shown, scatter (n,): mean of each figure over the seeds and
    its standard deviation from seed to seed. residuals (n,): distance in the observations'
    standard deviations. gap: their root mean square. lack_of_fit: probability of figures this far
    off or farther, were the model (its scatter included) true.
    """

    values: Mapping[str, float]
    shown: Array
    scatter: Array
    residuals: Array
    gap: float
    held_out_gap: float
    lack_of_fit: float


@dataclass(frozen=True)
class Trial:
    """Everything that was tried of a candidate; at least one draw has several seeds."""

    draws: Draws

    @property
    def candidate(self) -> Candidate:
        """Of which all draws are."""
        return self.draws.candidate

    @cached_property
    def close(self) -> Draws:
        """Draws that were run with all seeds, from the least misfit on."""
        return self.draws.take(self.draws.seeds > 1).ordered

    @property
    def best(self) -> Draws:
        """The first of those, by itself."""
        return self.close.take(slice(1))

    @property
    def misfit(self) -> float:
        """Of the best."""
        return float(self.best.misfit[0])

    @property
    def price(self) -> float:
        """ln n for each number that was added."""
        return self.candidate.added * math.log(len(self.draws.target.sizes))

    @property
    def bic(self) -> float:
        """Misfit plus the price of the numbers that were added."""
        return self.misfit + self.price

    @cached_property
    def held_out_gap(self) -> float:
        """Root mean square distance of the figures, each predicted by the fit to the others."""
        found, target = [], self.draws.target
        for i in range(len(target.sizes)):
            other = np.argmin(replace(self.close, target=target.without(i)).misfit)
            found.append(target.distances(self.close.mean[other])[i])
        return float(np.sqrt(np.mean(np.square(found))))

    @cached_property
    def lack_of_fit(self) -> float:
        """Probability of figures this far off, were the best draw's model true.

        Of coefficients a known one brings its own observation.
        """
        spans, target = self.candidate.spans, self.draws.target
        free = sum(span.of_friction and span.prior is None for span in spans)
        freedom = len(target.sizes) - self.candidate.added - free
        variance = target.sds**2 + self.best.spread
        off = np.sum((self.best.mean - target.sizes) ** 2 / variance) + self.best.surprise[0]
        return float(chi2.sf(off, max(freedom, 1)))

    def intervals(self) -> dict[str, tuple[float, float]]:
        """block.parameter -> range over the draws that are nearly as good as the best."""
        good = self.draws.misfit <= self.misfit + WITHIN
        values = self.draws.take(good).values
        keys = [span.key for span in self.candidate.spans]
        return {
            key: (min(one[key] for one in values), max(one[key] for one in values)) for key in keys
        }

    def fitted(self, draw: Draws | None = None) -> FittedSummary:
        """A draw beside the observed figures, the best where none is given."""
        draw = self.best if draw is None else draw
        return FittedSummary(
            values=dict(draw.values[0]),
            shown=draw.mean[0],
            scatter=draw.scatter[0],
            residuals=draw.target.distances(draw.mean[0]),
            gap=float(draw.target.gap(draw.mean[0])),
            held_out_gap=self.held_out_gap,
            lack_of_fit=self.lack_of_fit,
        )


def ranked(tried: Sequence[Trial], plain: Trial) -> tuple[Ranked, ...]:
    """The best form of every effect, the least BIC first, of trials in that order."""
    best: dict[str, Trial] = {}
    for trial in tried:
        best.setdefault(trial.candidate.effects[-1], trial)
    weights = [math.exp(0.5 * (tried[0].bic - trial.bic)) for trial in best.values()]
    fits = [trial.fitted() for trial in best.values()]
    return tuple(
        Ranked(
            effect=effect,
            form=trial.candidate.form,
            evidence=0.5 * (plain.bic - trial.bic),
            probability=weight / sum(weights),
            gap=Score(fit.gap, fit.held_out_gap),
            parameters=dict(fit.values),
            intervals=trial.intervals(),
        )
        for (effect, trial), fit, weight in zip(best.items(), fits, weights, strict=True)
    )


def p_of_the_best(plain: Trial, others: Sequence[Trial], seed: int) -> float:
    """Probability, under the plain model, of an improvement like that of the best of ``others``.

    A parametric bootstrap: figures are drawn from the plain model (its own scatter and the
    observations' standard deviations), and everything that was drawn is fitted to them again, so
    that choosing the best of many is part of what chance may do.
    """
    rng, target = np.random.default_rng(seed), plain.draws.target
    rows = plain.best.shown[0, : plain.best.seeds[0]]
    before, after = _table([plain]), _table(others)

    def gained(sizes: Array) -> float:
        drawn = Target(sizes, target.sds)
        plainly, extended = (
            float((drawn.misfit(means, variances) + prices).min())
            for means, variances, prices in (before, after)
        )
        return plainly - extended

    found = gained(target.sizes)
    as_good = 0
    for _ in range(BOOTSTRAPS):
        row = rows[rng.integers(len(rows))]
        as_good += gained(row + target.sds * rng.standard_normal(len(row))) >= found
    return (1 + as_good) / (1 + BOOTSTRAPS)


def _table(trials: Sequence[Trial]) -> tuple[Array, Array, Array]:
    """Of all draws of all trials: means (d, n), variances of a realisation (d, n), prices (d,)."""
    means = np.concatenate([trial.draws.mean for trial in trials])
    variances = np.concatenate([trial.draws.spread for trial in trials])
    return means, variances, np.concatenate([t.draws.surprise + t.price for t in trials])
