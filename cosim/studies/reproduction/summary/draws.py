"""Draws of a model: numbers that are tried, the figures that come of them, how far off these are.

The *misfit* is -2 log likelihood less that of a perfect model: it takes the scatter of the model's
own figures from seed to seed (the study's scheme is chaotic) as part of what the model predicts, at
the price of a wider prediction, and adds how far the known numbers were stretched. The *gap* is the
root mean square distance of the model's mean figures from the observed ones, in the observations'
standard deviations: what is drawn and reported.

The search for the numbers: evenly over what is expected, then about what was best. Neighbouring
numbers may give quite different figures (the scheme is chaotic), so nothing is differentiated. All
draws are kept, as a table, from which everything else is read. Each is run with the same seeds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import chi2, qmc

from ....gap.data import Campaign
from ....gap.data.errors import CampaignError
from .models import Candidate, Values, figures, motion_of

Array = np.ndarray

# which way the reporter's y axis points is not known, nor which way a symmetric rig swerves
MIRRORED = ("mean_y",)
#: Runs of a draw; more than three, or the variance of Student's t has no end.
SEEDS = 4
#: Variance of the next realisation about a draw's mean, over that of its realisations: mean and
#: scatter are both from a few seeds, so it is that of Student's t.
WIDER = (1.0 + 1.0 / SEEDS) * (SEEDS - 1) / (SEEDS - 3)
#: misfit by which a draw may be worse than the best and still lie in the 95 % interval (one number)
WITHIN = 3.84


class Observation(NamedTuple):
    """A published figure: of which run (place in the campaign and name), and how well it is known.

    size: its value, without a sign that says nothing; sd: its standard deviation.
    """

    run: int
    name: str
    figure: str
    size: float
    sd: float


def observations(campaign: Campaign) -> tuple[Observation, ...]:
    """All figures of all runs that have a ``summary``; CampaignError where there is none."""
    found = tuple(
        Observation(i, run.name, figure, abs(value) if figure in MIRRORED else value, sd)
        for i, run in enumerate(campaign.runs)
        for figure, (value, sd) in (run.summary or {}).items()
    )
    if not found:
        raise CampaignError(f"{campaign.path}: run: no run has a summary, allowed is at least one")
    return found


def predict(campaign: Campaign, seen: tuple[Observation, ...], values: Values, seed: int) -> Array:
    """(n,) what a model with ``values`` shows of each observation.

    A figure that the motion has not counts as zero: as far away as nothing at all.
    """
    by_run = {
        i: figures(motion_of(campaign, campaign.runs[i], values, seed))
        for i in sorted({one.run for one in seen})
    }
    shown = [by_run[one.run][one.figure] for one in seen]
    mirrored = [one.figure in MIRRORED for one in seen]
    return np.nan_to_num(np.where(mirrored, np.abs(shown), shown))


@dataclass(frozen=True)
class Target:
    """What is to be met: sizes and standard deviations (n,) of the figures."""

    sizes: Array
    sds: Array

    def without(self, i: int) -> Target:
        """All but the i-th figure: that one counts for nothing."""
        return replace(self, sds=np.where(np.arange(len(self.sds)) == i, np.inf, self.sds))

    def distances(self, mean: Array) -> Array:
        """(..., n) of figures from the observed ones, in standard deviations."""
        return np.asarray((mean - self.sizes) / self.sds)

    def misfit(self, means: Array, variances: Array) -> Array:
        """(d,) -2 log likelihood of figures (d, n) with the variances of a realisation."""
        wider = 1.0 + variances / self.sds**2  # variance of the prediction, in sds squared
        return np.asarray((self.distances(means) ** 2 / wider + np.log(wider)).sum(axis=1))

    def gap(self, mean: Array) -> Array:
        """(...) root mean square distance, in standard deviations."""
        return np.asarray(np.sqrt(np.mean(self.distances(mean) ** 2, axis=-1)))


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
class Draws:
    """Numbers tried of a candidate, a row a draw, what came of them, and how far off they are.

    shares (d, p): the spans' numbers as shares of their ranges, NaN for one that a draw has not;
    values (d,): mappings, settings included; shown (d, SEEDS, n): the observations' figures.
    """

    candidate: Candidate
    target: Target
    shares: Array
    values: Array
    shown: Array

    @property
    def effect(self) -> str:
        """What the candidate has beside what was found before."""
        return self.candidate.effects[-1]

    def __add__(self, other: Draws) -> Draws:
        """Both, of one candidate."""
        tables = ("shares", "values", "shown")
        both: Any = {t: np.concatenate([getattr(self, t), getattr(other, t)]) for t in tables}
        return replace(self, **both)

    def with_effect_off(self, candidate: Candidate) -> Draws:
        """The same as draws of a candidate with one effect more, which is off."""
        more = np.full((len(self.values), len(candidate.spans) - self.shares.shape[1]), np.nan)
        values = np.array([candidate.off | one for one in self.values], dtype=object)
        shares = np.hstack([self.shares, more])
        return replace(self, candidate=candidate, shares=shares, values=values)

    @cached_property
    def surprise(self) -> Array:
        """(d,) squared distance of known numbers from what is known."""
        return np.array([self.candidate.surprise(one) for one in self.values])

    @cached_property
    def mean(self) -> Array:
        """(d, n) mean of each figure over the seeds."""
        return np.asarray(self.shown.mean(axis=1))

    @cached_property
    def scatter(self) -> Array:
        """(d, n) standard deviation of each draw's figures from seed to seed."""
        return np.asarray(self.shown.std(axis=1, ddof=1))

    @cached_property
    def misfit(self) -> Array:
        """(d,) -2 log likelihood, less that of a draw that meets every figure without scatter."""
        return self._misfit_to(self.target)

    def _misfit_to(self, target: Target) -> Array:
        return np.asarray(target.misfit(self.mean, WIDER * self.scatter**2) + self.surprise)

    @cached_property
    def best(self) -> int:
        """The row of the least misfit."""
        return int(np.argmin(self.misfit))

    @property
    def best_values(self) -> Mapping[str, float]:
        """The numbers of that row."""
        return dict(self.values[self.best])

    def good(self, count: int) -> Array:
        """(count, p) shares of the best draws that have all the numbers."""
        own = np.flatnonzero(np.isfinite(self.shares).all(axis=1))
        return np.asarray(self.shares[own[np.argsort(self.misfit[own], kind="stable")][:count]])

    @property
    def price(self) -> float:
        """ln n for each number that was added."""
        return self.candidate.added * math.log(len(self.target.sizes))

    @property
    def bic(self) -> float:
        """Misfit of the best plus the price of the numbers that were added."""
        return float(self.misfit[self.best]) + self.price

    @property
    def gap(self) -> float:
        """Of the best, standard deviations."""
        return float(self.target.gap(self.mean[self.best]))

    @cached_property
    def held_out_gap(self) -> float:
        """Root mean square distance of the figures, each predicted by the fit to the others."""
        rows = range(len(self.target.sizes))
        fits = [np.argmin(self._misfit_to(self.target.without(i))) for i in rows]
        return float(self.target.gap(self.mean[fits, rows]))

    @cached_property
    def lack_of_fit(self) -> float:
        """Probability of figures this far off, were the best draw's model true.

        Of coefficients a known one brings its own observation.
        """
        target, best = self.target, self.best
        free = sum(span.of_friction and span.prior is None for span in self.candidate.spans)
        freedom = len(target.sizes) - self.candidate.added - free
        variance = target.sds**2 + WIDER * self.scatter[best] ** 2
        off = np.sum((self.mean[best] - target.sizes) ** 2 / variance) + self.surprise[best]
        return float(chi2.sf(off, max(freedom, 1)))

    def intervals(self) -> dict[str, tuple[float, float]]:
        """block.parameter -> range over the draws that are nearly as good as the best."""
        values = self.values[self.misfit <= self.misfit[self.best] + WITHIN]
        tried = {span.key: [one[span.key] for one in values] for span in self.candidate.spans}
        return {key: (min(numbers), max(numbers)) for key, numbers in tried.items()}

    def fitted(self, row: int | None = None) -> FittedSummary:
        """A draw beside the observed figures, the best where none is given."""
        row = self.best if row is None else row
        return FittedSummary(
            values=dict(self.values[row]),
            shown=self.mean[row],
            scatter=self.scatter[row],
            residuals=self.target.distances(self.mean[row]),
            gap=float(self.target.gap(self.mean[row])),
            held_out_gap=self.held_out_gap,
            lack_of_fit=self.lack_of_fit,
        )


GOOD = 4  # of the best draws about which others are made
DIFFERENCE, EDGE = 1e-3, 1e-3  # of shares: for a derivative, and from the end of a range
MOST_STEPS = 25  # of the least squares
OFF = 0.75  # share at which an effect of either sign is surely on
STEP = 0.08  # standard deviation of a step about a good draw, as share of the range


@dataclass(frozen=True)
class Bench:
    """Runs the campaign's model for draws, a few at a time.

    seed: of the whole search; jobs: threads; step: called with the number of draws just done.
    """

    campaign: Campaign
    seen: tuple[Observation, ...]
    seed: int = 0
    jobs: int = 2
    step: Callable[[int], object] = lambda _count: None

    @property
    def smooth(self) -> bool:
        """Do figures follow the numbers smoothly? Those of the study's scheme do not."""
        return self.campaign.scheme == "exact"

    @cached_property
    def target(self) -> Target:
        """What is to be met."""
        return Target(*np.transpose([(one.size, one.sd) for one in self.seen]))

    def draw(self, candidate: Candidate, shares: Array) -> Draws:
        """Draws (d, p) of a candidate, each with all seeds."""
        shares = np.atleast_2d(shares)
        values = np.array([candidate.values(row) for row in shares], dtype=object)
        runs = product(values, range(self.seed, self.seed + SEEDS))
        with ThreadPoolExecutor(max_workers=self.jobs) as pool:
            rows = list(pool.map(lambda run: self.shown(*run), runs))
        shown = np.reshape(rows, (len(values), SEEDS, -1))
        return Draws(candidate, self.target, shares, values, shown)

    def shown(self, values: Values, seed: int) -> Array:
        """(n,) figures of one run of the model."""
        row = predict(self.campaign, self.seen, values, seed)
        self.step(1)
        return row


def even_shares(candidate: Candidate, count: int, seed: int) -> Array:
    """(count, p) shares, evenly spread; the first has friction as it is known."""
    sobol = qmc.Sobol(len(candidate.spans), rng=np.random.default_rng(seed))
    spread = sobol.random_base2(int(np.ceil(np.log2(count))))[: count - 1]
    return np.vstack([[0.5 if span.of_friction else OFF for span in candidate.spans], spread])


def screening(bench: Bench, candidate: Candidate, count: int, before: Draws, share: float) -> Draws:
    """Draws evenly over the ranges.

    before: of the model without the last effect; ``share`` of the draws stay close to the best of
    these in all but the new numbers, so that what it has reached is not lost.
    """
    table = even_shares(candidate, count, bench.seed)
    (reached,) = before.good(1)
    stay, own = slice(round((1.0 - share) * len(table)), None), len(reached)
    table[stay, :own] = _inside(reached + STEP * (table[stay, :own] - 0.5))
    return bench.draw(candidate, table)


def near_rounds(bench: Bench, draws: Draws, count: int) -> Draws:
    """The draws and, twice, ``count`` about the best of all until then."""
    rng = np.random.default_rng(bench.seed + 1)
    for _ in range(2):
        centres = np.resize(draws.good(GOOD), (count, len(draws.candidate.spans)))
        steps = STEP * rng.standard_normal(centres.shape)
        draws += bench.draw(draws.candidate, _inside(centres + steps))
    return draws


def _inside(shares: Array) -> Array:
    """Shares that left their range, reflected into it."""
    return np.asarray(1.0 - np.abs(1.0 - np.abs(shares)))


def polished(bench: Bench, candidate: Candidate, start: Array) -> Draws:
    """The least squares from shares (p,) on, where the model is smooth; of one seed."""

    def residuals(shares: Array) -> Array:
        values = candidate.values(shares)
        distances = bench.target.distances(bench.shown(values, bench.seed))
        return np.append(distances, math.sqrt(candidate.surprise(values)))

    inside = np.clip(start, EDGE, 1.0 - EDGE)
    # counted and cut figures jump a little: the soft loss keeps a step from hanging on one of them
    found = least_squares(
        residuals, inside, bounds=(0.0, 1.0), method="dogbox", x_scale="jac", loss="soft_l1",
        diff_step=DIFFERENCE, max_nfev=MOST_STEPS,
    )  # fmt: skip
    return bench.draw(candidate, found.x)
