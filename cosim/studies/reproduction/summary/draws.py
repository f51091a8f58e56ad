"""Draws of a model: numbers that are tried, and the figures that come of them, seed by seed."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from cosim.gap.data import Campaign
from cosim.gap.data.errors import CampaignError

from .candidates import Candidate
from .models import Values, figures, motion_of

Array = np.ndarray

# which way the reporter's y axis points is not known, nor which way a symmetric rig swerves
MIRRORED = ("mean_y",)
SEEDS = 6  # most runs of a draw


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
class Draws:
    """Numbers tried of a candidate, a row a draw, and what came of them.

    shares (d, p): the spans' numbers as shares of their ranges, NaN for one that a draw has not;
    values: of each draw, settings included; surprise (d,): squared distance of known numbers from
    what is known; shown (d, seeds, n): the observations' figures, NaN where it was not run.
    """

    shares: Array
    values: tuple[Mapping[str, float], ...]
    surprise: Array
    shown: Array

    @classmethod
    def of(cls, candidate: Candidate, shares: Array, n: int) -> Draws:
        """Draws (d, p) of a candidate that have not been run yet."""
        spans, values = candidate.spans, []
        for row in shares:
            numbers = {span.key: float(span.at(one)) for span, one in zip(spans, row, strict=True)}
            # a contact at rest holds at least what it holds in sliding
            numbers["friction.mu_k"] = min(numbers["friction.mu_k"], numbers["friction.mu_s"])
            values.append(dict(candidate.settings) | numbers)
        surprise = [sum(span.surprise(one[span.key]) for span in spans) for one in values]
        shown = np.full((len(values), SEEDS, n), np.nan)
        return cls(np.asarray(shares, float), tuple(values), np.array(surprise), shown)

    def __len__(self) -> int:
        return len(self.values)

    def __add__(self, other: Draws) -> Draws:
        """Both, of one candidate."""
        return Draws(
            np.concatenate([self.shares, other.shares]),
            self.values + other.values,
            np.concatenate([self.surprise, other.surprise]),
            np.concatenate([self.shown, other.shown]),
        )

    def take(self, rows: Array | slice) -> Draws:
        """Some of them: numbers of rows, which of all, or (d,) whether."""
        places = np.arange(len(self))[rows]
        values = tuple(self.values[i] for i in places)
        return Draws(self.shares[places], values, self.surprise[places], self.shown[places])

    def without_effect(self, candidate: Candidate) -> Draws:
        """The same as draws of a candidate with one effect more, which is off."""
        more = np.full((len(self), len(candidate.spans) - self.shares.shape[1]), np.nan)
        values = tuple(candidate.off | dict(one) for one in self.values)
        return replace(self, shares=np.hstack([self.shares, more]), values=values)

    @property
    def seeds(self) -> Array:
        """(d,) how often each was run."""
        return np.asarray(np.isfinite(self.shown[:, :, 0]).sum(axis=1))

    @property
    def mean(self) -> Array:
        """(d, n) mean of each figure over the seeds."""
        return np.asarray(np.nanmean(self.shown, axis=1))


@dataclass(frozen=True)
class Target:
    """What is to be met: sizes and standard deviations (n,) of the figures."""

    sizes: Array
    sds: Array

    @classmethod
    def of(cls, seen: Sequence[Observation]) -> Target:
        """The observed figures."""
        return cls(np.array([one.size for one in seen]), np.array([one.sd for one in seen]))

    def without(self, i: int) -> Target:
        """All but the i-th figure: that one counts for nothing."""
        return replace(self, sds=np.where(np.arange(len(self.sds)) == i, np.inf, self.sds))

    def distances(self, mean: Array) -> Array:
        """(..., n) of figures from the observed ones, in standard deviations."""
        return np.asarray((mean - self.sizes) / self.sds)

    def gap(self, mean: Array) -> Array:
        """(...) root mean square distance, in standard deviations."""
        return np.asarray(np.sqrt(np.mean(self.distances(mean) ** 2, axis=-1)))


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
        return Target.of(self.seen)

    def draw(self, candidate: Candidate, shares: Array) -> Draws:
        """Draws (d, p) of a candidate, a seed each."""
        return self.run(Draws.of(candidate, np.atleast_2d(shares), len(self.seen)))

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
