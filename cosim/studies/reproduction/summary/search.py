"""Search for the numbers of a model: evenly over what is expected, then about what was best.

The study's scheme is chaotic: neighbouring numbers may give quite different figures, so nothing is
differentiated. All draws are kept, as a table, from which everything else is read.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import qmc

from cosim.gap.data import Campaign

from .candidates import Candidate
from .draws import ENOUGH_SEEDS, SEEDS, WITHIN, Array, Draws, Observation, Target, predict
from .models import Values

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
