"""Search for the numbers of a model: evenly over what is expected, then about what was best.

The study's scheme is chaotic: neighbouring numbers may give quite different figures, so nothing is
differentiated. All draws are kept, as a table, from which everything else is read.

Chance: parametric bootstrap of the best of all. Figures are drawn from the plain model (its own
scatter and the observations' standard deviations), and the whole catalogue is fitted to them again,
from the tables of draws, so that choosing the best of many is part of what chance may do.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import chi2, qmc

from cosim.studies.reproduction.summary.candidates import Candidate, Span
from cosim.studies.reproduction.summary.draws import (
    ENOUGH_SEEDS,
    Bench,
    Draw,
    Target,
    best,
    chi_square,
    distances,
    draw,
    gap,
    misfit,
    scatter,
    scatter_of_kin,
    spread,
)

SEEDS = 6  # rows of a draw that is run with all seeds
FIRST, MORE = 12, 40  # draws of a model: to begin with, and where it is in the running
CLOSELY = 6  # of them run with all seeds
DIFFERENCE, EDGE = 1e-3, 1e-3  # of shares: for a derivative, and from the end of a range
MOST_STEPS = 25  # of the least squares
OFF = 0.75  # share at which an effect of either sign is surely on
STEP = 0.08  # standard deviation of a step about a good draw, as share of the range


def even_shares(candidate: Candidate, count: int, seed: int) -> np.ndarray:
    """(count, d) shares, evenly spread; the first has friction as it is known."""
    sobol = qmc.Sobol(len(candidate.spans), rng=np.random.default_rng(seed))
    spread = sobol.random_base2(int(np.ceil(np.log2(count))))[: count - 1]
    known = [0.5 if span.key.startswith("friction.") else OFF for span in candidate.spans]
    return np.vstack([known, spread])


def screening(
    bench: Bench,
    candidate: Candidate,
    count: int = FIRST,
    before: Draw | None = None,
    share: float = 0.5,
) -> list[Draw]:
    """Draws evenly over the ranges, one seed each.

    before: the best draw of the model without the last effect; ``share`` of the draws stay close
    to it in all but the new numbers, so that what it has reached is not lost.
    """
    table = even_shares(candidate, count, bench.seed)
    if before is not None:
        stay, own = slice(int(round((1.0 - share) * len(table))), None), len(before.shares)
        table[stay, :own] = _inside(before.shares + STEP * (table[stay, :own] - 0.5))
    return bench.run([draw(candidate, shares, len(bench.seen)) for shares in table])


def near(bench: Bench, candidate: Candidate, good: Sequence[Draw], count: int) -> list[Draw]:
    """Draws about ``good`` ones, a seed each."""
    rng = np.random.default_rng(bench.seed + 1)
    centres = np.array([one.shares for one in good])[np.arange(count) % len(good)]
    shares = _inside(centres + STEP * rng.standard_normal(centres.shape))
    return bench.run([draw(candidate, one, len(bench.seen)) for one in shares])


def _inside(shares: np.ndarray) -> np.ndarray:
    """Shares that left their range, reflected into it."""
    return 1.0 - np.abs(1.0 - np.abs(shares))


def polished(bench: Bench, candidate: Candidate, start: Draw, target: Target) -> Draw:
    """The least squares from ``start`` on, where the model is smooth; one seed."""
    n = len(target.sizes)

    def residuals(shares: np.ndarray) -> np.ndarray:
        one = bench.run([draw(candidate, shares, n)])[0]
        return np.append(distances(one.mean, target), np.sqrt(one.surprise))

    inside = np.clip(start.shares, EDGE, 1.0 - EDGE)
    # counted and cut figures jump a little: the soft loss keeps a step from hanging on one of them
    found = least_squares(
        residuals, inside, bounds=(0.0, 1.0), method="dogbox", x_scale="jac", loss="soft_l1",
        diff_step=DIFFERENCE, max_nfev=MOST_STEPS,
    )  # fmt: skip
    return bench.run([draw(candidate, found.x, n)])[0]


def ordered(draws: Sequence[Draw], target: Target, kin: np.ndarray) -> list[Draw]:
    """The draws from the least misfit on."""
    return sorted(draws, key=lambda one: misfit(one, target, kin))


def with_all_seeds(
    bench: Bench,
    draws: Sequence[Draw],
    target: Target,
    kin: np.ndarray,
    count: int,
    seeds: int = SEEDS,
) -> list[Draw]:
    """The table with the best ``count`` draws run with ``seeds``."""
    order = ordered(draws, target, kin)
    again = [one for one in order[:count] if one.seeds == 1]
    return bench.run(again, seeds - 1) + [one for one in order if not _among(one, again)]


def _among(one: Draw, others: Sequence[Draw]) -> bool:
    return any(one is other for other in others)


def search(
    bench: Bench, candidate: Candidate, draws: Sequence[Draw], target: Target, kin: np.ndarray
) -> list[Draw]:
    """``draws`` of a model in the running and more: evenly, about the best, and closely."""
    more = [
        draw(candidate, shares, len(bench.seen))
        for shares in even_shares(candidate, MORE // 2, bench.seed + 2)
    ]
    draws = [*draws, *bench.run(more)]
    good = ordered(draws, target, kin)[:4]
    draws += near(bench, candidate, good, MORE - MORE // 2)
    draws = with_all_seeds(bench, draws, target, kin, CLOSELY)
    # a second time with the model's own scatter, about the draws that hold for all seeds
    own = scatter_of_kin(draws)
    again = near(bench, candidate, ordered(_close(draws), target, own)[:2], CLOSELY)
    return with_all_seeds(bench, [*draws, *again], target, own, CLOSELY)


def refined(
    bench: Bench,
    candidate: Candidate,
    draws: Sequence[Draw],
    target: Target,
    kin: np.ndarray,
    running: bool,
) -> list[Draw]:
    """The table after as much of a search as the model is worth."""
    if bench.smooth:
        order = ordered(draws, target, kin)
        draws = [*draws, polished(bench, candidate, order[0], target)]
        return with_all_seeds(bench, draws, target, kin, 2, ENOUGH_SEEDS)
    if running:
        return search(bench, candidate, draws, target, kin)
    return with_all_seeds(bench, draws, target, kin, 2, ENOUGH_SEEDS)


def widen(
    bench: Bench,
    candidate: Candidate,
    draws: Sequence[Draw],
    target: Target,
    within: float,
    count: int,
) -> list[Draw]:
    """``draws`` and more for ranges, a seed each, about all ``within`` that of the best misfit."""
    own = scatter_of_kin(draws)
    draws = list(draws)
    for _ in range(2):
        order = ordered(draws, target, own)
        least = misfit(order[0], target, own)
        good = [one for one in order if misfit(one, target, own) <= least + within]
        draws += near(bench, candidate, good, count // 2)
    return draws


def _close(draws: Sequence[Draw]) -> list[Draw]:
    return [one for one in draws if one.seeds > 1]


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
