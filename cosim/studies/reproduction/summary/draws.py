"""Draws of a model: the observed figures, what a draw shows of them, and how far off it is.

Two measures. The *gap* is the root mean square distance of the model's mean figures from the
observed ones, in the observations' standard deviations: what is drawn and reported. The
*misfit* is -2 log likelihood less that of a perfect model: it takes the scatter of the model's own
figures from seed to seed (the study's scheme is chaotic) as part of what the model predicts, at the
price of a wider prediction, and adds how far the known numbers were stretched.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.data.errors import CampaignError

from .candidates import Candidate
from .models import Motion, exact_motion, figures, study_motion

# which way the reporter's y axis points is not known, nor which way a symmetric rig swerves
MIRRORED = ("mean_y",)


@dataclass(frozen=True)
class Observation:
    """A published figure: of which run (place in the campaign), value and standard deviation."""

    run: int
    name: str
    figure: str
    value: float
    sd: float

    @property
    def size(self) -> float:
        """The value without a sign that says nothing."""
        return abs(self.value) if self.figure in MIRRORED else self.value


def observations(campaign: Campaign) -> tuple[Observation, ...]:
    """All figures of all runs that have a ``summary``; CampaignError where there is none."""
    found = tuple(
        Observation(i, run.name, figure, value, sd)
        for i, run in enumerate(campaign.runs)
        if run.summary
        for figure, (value, sd) in run.summary.items()
    )
    if not found:
        raise CampaignError(f"{campaign.path}: run: no run has a summary, allowed is at least one")
    return found


def predict(
    campaign: Campaign, seen: tuple[Observation, ...], values: Mapping[str, float], seed: int
) -> np.ndarray:
    """(n,) what a model with ``values`` (``block.parameter`` -> number) shows of each observation.

    A figure that the motion has not counts as zero: as far away as nothing at all. ``seed`` is
    that of the scheme's scatter, or of the exact model's start.
    """
    by_run = {
        i: figures(motion_of(campaign, campaign.runs[i], values, seed))
        for i in sorted({one.run for one in seen})
    }
    shown = np.array([by_run[one.run][one.figure] for one in seen])
    mirrored = np.array([one.figure in MIRRORED for one in seen])
    return np.nan_to_num(np.where(mirrored, np.abs(shown), shown))


def motion_of(
    campaign: Campaign, run: MeasuredRun, values: Mapping[str, float], seed: int
) -> Motion:
    """The steady part of a run of the campaign's model."""
    known = campaign.parameters(run)
    if campaign.scheme == "study":
        return study_motion(known, values, seed)
    return exact_motion(known, values, seed)


@dataclass(frozen=True)
class Draw:
    """Numbers tried and what came of them.

    shares (d,): the numbers of the candidate's spans, as shares of their ranges. values:
    block.parameter -> number, settings included. surprise: squared distance of the known ones from
    what is known. shown (seeds, n): the observations' figures, one row a seed.
    """

    shares: np.ndarray
    values: Mapping[str, float]
    surprise: float
    shown: np.ndarray = field(repr=False)

    @property
    def seeds(self) -> int:
        """How often it was run."""
        return len(self.shown)

    @property
    def mean(self) -> np.ndarray:
        """Mean of each figure over the seeds: (n,)."""
        return self.shown.mean(axis=0)


def draw(candidate: Candidate, shares: np.ndarray, n: int) -> Draw:
    """A draw that has not been run yet."""
    numbers = [float(span.at(share)) for span, share in zip(candidate.spans, shares, strict=True)]
    values = dict(candidate.settings) | {
        span.key: number for span, number in zip(candidate.spans, numbers, strict=True)
    }
    # a contact at rest holds at least what it holds in sliding
    values["friction.mu_k"] = min(values["friction.mu_k"], values["friction.mu_s"])
    surprise = sum(span.surprise(values[span.key]) for span in candidate.spans)
    return Draw(np.asarray(shares), values, surprise, np.empty((0, n)))


def without_effect(candidate: Candidate, before: Draw) -> Draw:
    """A draw of the model without the candidate's last effect, as one of it: the effect is off."""
    return replace(before, values=candidate.off | dict(before.values))


@dataclass(frozen=True)
class Bench:
    """Runs the campaign's model for draws, a few at a time.

    seed: of the whole search; jobs: threads; step: called with the number of draws just done.
    """

    campaign: Campaign
    seen: tuple[Observation, ...]
    seed: int = 0
    jobs: int = 2
    step: Callable[[int], None] | None = None

    @property
    def smooth(self) -> bool:
        """Do figures follow the numbers smoothly? Those of the study's scheme do not."""
        return self.campaign.scheme == "exact"

    def run(self, draws: Iterable[Draw], seeds: int = 1) -> list[Draw]:
        """The draws with ``seeds`` more rows each, in their order."""
        draws = list(draws)
        requests = [(one.values, self.seed + one.seeds + i) for one in draws for i in range(seeds)]
        with ThreadPoolExecutor(max_workers=self.jobs) as pool:
            rows = list(pool.map(self._row, requests))
        return [
            replace(one, shown=np.vstack([one.shown, rows[seeds * i : seeds * (i + 1)]]))
            for i, one in enumerate(draws)
        ]

    def _row(self, request) -> np.ndarray:
        row = predict(self.campaign, self.seen, *request)
        if self.step is not None:
            self.step(1)
        return row


# seeds from which a draw's own scatter is taken; below, that of its kin
ENOUGH_SEEDS = 4


@dataclass(frozen=True)
class Target:
    """What is to be met: sizes and standard deviations (n,) of the figures."""

    sizes: np.ndarray
    sds: np.ndarray

    @classmethod
    def of(cls, seen: Sequence[Observation]) -> Target:
        """The observed figures."""
        return cls(np.array([one.size for one in seen]), np.array([one.sd for one in seen]))

    def without(self, i: int) -> Target:
        """All but the i-th figure: that one counts for nothing."""
        sds = self.sds.copy()
        sds[i] = np.inf
        return Target(self.sizes, sds)


def distances(mean: np.ndarray, target: Target) -> np.ndarray:
    """(n,) of the figures from the observed ones, in standard deviations."""
    return (mean - target.sizes) / target.sds


def gap(mean: np.ndarray, target: Target) -> float:
    """Root mean square distance, in standard deviations."""
    return float(np.sqrt(np.mean(distances(mean, target) ** 2)))


def scatter_of_kin(draws: Sequence[Draw]) -> np.ndarray:
    """(n,) typical scatter of a figure from seed to seed: median over the draws that tell it."""
    told = [one.shown.std(axis=0, ddof=1) for one in draws if one.seeds >= ENOUGH_SEEDS]
    return np.median(told, axis=0)


def scatter(one: Draw, kin: np.ndarray) -> np.ndarray:
    """(n,) standard deviation of a draw's figures from seed to seed."""
    return one.shown.std(axis=0, ddof=1) if one.seeds >= ENOUGH_SEEDS else kin


def spread(one: Draw, kin: np.ndarray) -> np.ndarray:
    """(n,) variance of the next realisation about the draw's mean.

    Mean and scatter are both from a few seeds: Student's t, whose variance counts here.
    """
    if one.seeds < ENOUGH_SEEDS:
        return 2.0 * kin**2
    freedom = one.seeds - 1
    return scatter(one, kin) ** 2 * (1.0 + 1.0 / one.seeds) * freedom / (freedom - 2)


def terms(one: Draw, target: Target, kin: np.ndarray) -> np.ndarray:
    """(n,) the figures' parts of `misfit`."""
    wider = 1.0 + spread(one, kin) / target.sds**2  # variance of the prediction, in sds squared
    return distances(one.mean, target) ** 2 / wider + np.log(wider)


def misfit(one: Draw, target: Target, kin: np.ndarray) -> float:
    """-2 log likelihood of a draw, less that of one that meets every figure without scatter."""
    return float(terms(one, target, kin).sum()) + one.surprise


def chi_square(one: Draw, target: Target, kin: np.ndarray) -> float:
    """Sum of squared distances in the standard deviations of observation and model together."""
    variance = target.sds**2 + spread(one, kin)
    return float(np.sum((one.mean - target.sizes) ** 2 / variance) + one.surprise)


def best(draws: Sequence[Draw], target: Target, kin: np.ndarray) -> Draw:
    """The draw of least misfit."""
    return min(draws, key=lambda one: misfit(one, target, kin))
