"""Draws of a model: numbers that are tried, the figures that come of them, how far off these are.

The *misfit* is -2 log likelihood less that of a perfect model: it takes the scatter of the model's
own figures from seed to seed (the study's scheme is chaotic) as part of what the model predicts, at
the price of a wider prediction, and adds how far the known numbers were stretched. The *gap* is the
root mean square distance of the model's mean figures from the observed ones, in the observations'
standard deviations: what is drawn and reported.

The search for the numbers: evenly over what is expected, then about what was best. Neighbouring
numbers may give quite different figures (the scheme is chaotic), so nothing is differentiated. All
draws are kept, as a table, from which everything else is read.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property
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
SEEDS = 6  # most runs of a draw
#: misfit by which a draw may be worse than the best and still lie in the 95 % interval (one number)
WITHIN = 3.84
# seeds from which a draw's own scatter is taken; below, that of its kin
ENOUGH_SEEDS = 4


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
    values (d,): mappings, settings included; shown (d, seeds, n): the observations' figures, NaN
    where it was not run. kin (n,): scatter of a figure from seed to seed, for draws of too few
    seeds to tell their own. From `close` on: of all that was tried of the candidate, some of it
    with several seeds.
    """

    candidate: Candidate
    target: Target
    shares: Array
    values: Array
    shown: Array
    kin: Array | float = 0.0

    @classmethod
    def of(cls, candidate: Candidate, shares: Array, target: Target) -> Draws:
        """Draws (d, p) of a candidate that have not been run yet."""
        values = np.array([candidate.values(row) for row in shares], dtype=object)
        shown = np.full((len(values), SEEDS, len(target.sizes)), np.nan)
        return cls(candidate, target, np.asarray(shares, float), values, shown)

    @property
    def effect(self) -> str:
        """What the candidate has beside what was found before."""
        return self.candidate.effects[-1]

    def __len__(self) -> int:
        return len(self.values)

    def _rows(self, of: Callable[[str], Any]) -> Draws:
        """With other rows: of each table, by its name."""
        return replace(self, **{name: of(name) for name in ("shares", "values", "shown")})

    def __add__(self, other: Draws) -> Draws:
        """Both, of one candidate."""
        return self._rows(lambda name: np.concatenate([getattr(self, name), getattr(other, name)]))

    def take(self, rows: Array | slice) -> Draws:
        """Some of them: numbers of rows, which of all, or (d,) whether."""
        return self._rows(lambda name: getattr(self, name)[rows])

    def with_effect_off(self, candidate: Candidate) -> Draws:
        """The same as draws of a candidate with one effect more, which is off."""
        more = np.full((len(self), len(candidate.spans) - self.shares.shape[1]), np.nan)
        values = np.array([candidate.off | one for one in self.values], dtype=object)
        shares = np.hstack([self.shares, more])
        return replace(self, candidate=candidate, shares=shares, values=values)

    @property
    def surprise(self) -> Array:
        """(d,) squared distance of known numbers from what is known."""
        return np.array([self.candidate.surprise(one) for one in self.values])

    @property
    def seeds(self) -> Array:
        """(d,) how often each was run."""
        return np.asarray(np.isfinite(self.shown[:, :, 0]).sum(axis=1))

    @property
    def mean(self) -> Array:
        """(d, n) mean of each figure over the seeds."""
        return np.asarray(np.nanmean(self.shown, axis=1))

    @property
    def scatter(self) -> Array:
        """(d, n) standard deviation of each draw's figures from seed to seed."""
        n = self.seeds[:, None]
        squares = np.nansum((self.shown - self.mean[:, None]) ** 2, axis=1)
        return np.where(n >= ENOUGH_SEEDS, np.sqrt(squares / np.maximum(n - 1, 1)), self.kin)

    @property
    def spread(self) -> Array:
        """(d, n) variance of the next realisation about a draw's mean.

        Mean and scatter are both from a few seeds: Student's t, whose variance counts here.
        """
        n = self.seeds[:, None]
        wider = (1.0 + 1.0 / n) * (n - 1) / np.where(n > 3, n - 3, 1)
        return np.where(n < ENOUGH_SEEDS, 2.0 * self.kin**2, self.scatter**2 * wider)

    @property
    def misfit(self) -> Array:
        """(d,) -2 log likelihood, less that of a draw that meets every figure without scatter."""
        return np.asarray(self.target.misfit(self.mean, self.spread) + self.surprise)

    @property
    def ordered(self) -> Draws:
        """From the least misfit on."""
        return self.take(np.argsort(self.misfit, kind="stable"))

    @property
    def with_own_scatter(self) -> Draws:
        """With the typical scatter of those that tell it, its median, for those that do not."""
        told = self.take(self.seeds >= ENOUGH_SEEDS)
        return replace(self, kin=np.asarray(np.median(told.scatter, axis=0)))

    @cached_property
    def close(self) -> Draws:
        """Draws that were run with all seeds, from the least misfit on."""
        return self.take(self.seeds > 1).ordered

    @property
    def best(self) -> Draws:
        """The first of those, by itself."""
        return self.close.take(slice(1))

    @property
    def price(self) -> float:
        """ln n for each number that was added."""
        return self.candidate.added * math.log(len(self.target.sizes))

    @property
    def bic(self) -> float:
        """Misfit of the best plus the price of the numbers that were added."""
        return float(self.best.misfit[0]) + self.price

    @property
    def gap(self) -> float:
        """Of the best, standard deviations."""
        return float(self.target.gap(self.best.mean[0]))

    @cached_property
    def held_out_gap(self) -> float:
        """Root mean square distance of the figures, each predicted by the fit to the others."""
        found = []
        for i in range(len(self.target.sizes)):
            other = np.argmin(replace(self.close, target=self.target.without(i)).misfit)
            found.append(self.target.distances(self.close.mean[other])[i])
        return float(np.sqrt(np.mean(np.square(found))))

    @cached_property
    def lack_of_fit(self) -> float:
        """Probability of figures this far off, were the best draw's model true.

        Of coefficients a known one brings its own observation.
        """
        target = self.target
        free = sum(span.of_friction and span.prior is None for span in self.candidate.spans)
        freedom = len(target.sizes) - self.candidate.added - free
        variance = target.sds**2 + self.best.spread
        off = np.sum((self.best.mean - target.sizes) ** 2 / variance) + self.best.surprise[0]
        return float(chi2.sf(off, max(freedom, 1)))

    def intervals(self) -> dict[str, tuple[float, float]]:
        """block.parameter -> range over the draws that are nearly as good as the best."""
        values = self.values[self.misfit <= self.best.misfit[0] + WITHIN]
        tried = {span.key: [one[span.key] for one in values] for span in self.candidate.spans}
        return {key: (min(numbers), max(numbers)) for key, numbers in tried.items()}

    def fitted(self, draw: Draws | None = None) -> FittedSummary:
        """A draw beside the observed figures, the best where none is given."""
        draw = self.best if draw is None else draw
        return FittedSummary(
            values=dict(draw.values[0]),
            shown=draw.mean[0],
            scatter=draw.scatter[0],
            residuals=self.target.distances(draw.mean[0]),
            gap=float(self.target.gap(draw.mean[0])),
            held_out_gap=self.held_out_gap,
            lack_of_fit=self.lack_of_fit,
        )


FIRST, MORE = 12, 40  # draws of a model: to begin with, and where it is in the running
CLOSELY = 6  # of them run with all seeds
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
        """Draws (d, p) of a candidate, a seed each."""
        return self.run(Draws.of(candidate, np.atleast_2d(shares), self.target))

    def run(self, draws: Draws, seeds: int = 1) -> Draws:
        """The draws with ``seeds`` more runs each."""
        if not len(draws):
            return draws
        places = draws.seeds[:, None] + np.arange(seeds)
        requests = [
            (values, int(seed))
            for values, row in zip(draws.values, self.seed + places, strict=True)
            for seed in row
        ]
        with ThreadPoolExecutor(max_workers=self.jobs) as pool:
            rows = list(pool.map(self._row, requests))
        shown = draws.shown.copy()
        shown[np.arange(len(draws))[:, None], places] = np.reshape(rows, (*places.shape, -1))
        return replace(draws, shown=shown)

    def _row(self, request: tuple[Values, int]) -> Array:
        row = predict(self.campaign, self.seen, *request)
        self.step(1)
        return row


def even_shares(candidate: Candidate, count: int, seed: int) -> Array:
    """(count, p) shares, evenly spread; the first has friction as it is known."""
    sobol = qmc.Sobol(len(candidate.spans), rng=np.random.default_rng(seed))
    spread = sobol.random_base2(int(np.ceil(np.log2(count))))[: count - 1]
    return np.vstack([[0.5 if span.of_friction else OFF for span in candidate.spans], spread])


def screening(
    bench: Bench, candidate: Candidate, count: int, before: Draws | None = None, share: float = 0.5
) -> Draws:
    """Draws evenly over the ranges, one seed each.

    before: the best draw of the model without the last effect; ``share`` of the draws stay close
    to it in all but the new numbers, so that what it has reached is not lost.
    """
    table = even_shares(candidate, count, bench.seed)
    if before is not None:
        reached = before.shares[0, np.isfinite(before.shares[0])]
        stay, own = slice(round((1.0 - share) * len(table)), None), len(reached)
        table[stay, :own] = _inside(reached + STEP * (table[stay, :own] - 0.5))
    return bench.draw(candidate, table)


def near(bench: Bench, good: Draws, count: int) -> Draws:
    """Draws about ``good`` ones, a seed each."""
    rng = np.random.default_rng(bench.seed + 1)
    centres = good.shares[np.arange(count) % len(good)]
    return bench.draw(good.candidate, _inside(centres + STEP * rng.standard_normal(centres.shape)))


def _inside(shares: Array) -> Array:
    """Shares that left their range, reflected into it."""
    return np.asarray(1.0 - np.abs(1.0 - np.abs(shares)))


def polished(bench: Bench, candidate: Candidate, start: Array) -> Draws:
    """The least squares from shares (p,) on, where the model is smooth; one seed."""

    def residuals(shares: Array) -> Array:
        one = bench.draw(candidate, shares)
        return np.append(bench.target.distances(one.mean[0]), np.sqrt(one.surprise))

    inside = np.clip(start, EDGE, 1.0 - EDGE)
    # counted and cut figures jump a little: the soft loss keeps a step from hanging on one of them
    found = least_squares(
        residuals, inside, bounds=(0.0, 1.0), method="dogbox", x_scale="jac", loss="soft_l1",
        diff_step=DIFFERENCE, max_nfev=MOST_STEPS,
    )  # fmt: skip
    return bench.draw(candidate, found.x)


def with_all_seeds(bench: Bench, draws: Draws, count: int, seeds: int = SEEDS) -> Draws:
    """The table with the best ``count`` draws run with ``seeds``."""
    order = draws.ordered
    again = (np.arange(len(order)) < count) & (order.seeds == 1)
    return bench.run(order.take(again), seeds - 1) + order.take(~again)


def refined(bench: Bench, draws: Draws, running: bool) -> Draws:
    """The table after as much of a search as the model is worth."""
    if bench.smooth:
        draws += polished(bench, draws.candidate, draws.ordered.shares[0])
    elif running:
        return _searched(bench, draws)
    return with_all_seeds(bench, draws, 2, ENOUGH_SEEDS)


def _searched(bench: Bench, draws: Draws) -> Draws:
    """Draws of a model in the running and more: evenly, about the best, and closely."""
    draws += bench.draw(draws.candidate, even_shares(draws.candidate, MORE // 2, bench.seed + 2))
    draws += near(bench, draws.ordered.take(slice(4)), MORE - MORE // 2)
    # a second time with the model's own scatter, about the draws that hold for all seeds
    draws = with_all_seeds(bench, draws, CLOSELY).with_own_scatter
    close = draws.take(draws.seeds > 1).ordered
    draws += near(bench, close.take(slice(2)), CLOSELY)
    return with_all_seeds(bench, draws, CLOSELY)


def widened(bench: Bench, draws: Draws, count: int) -> Draws:
    """``draws`` and more for ranges, a seed each, about all that are nearly as good as the best."""
    draws = draws.with_own_scatter
    for _ in range(2):
        order = draws.ordered
        draws += near(bench, order.take(order.misfit <= order.misfit[0] + WITHIN), count // 2)
    return draws
