"""Search for the numbers of a model: evenly over what is expected, then about what was best.

The study's scheme is chaotic: neighbouring numbers may give quite different figures, so nothing is
differentiated. All draws are kept, as a table, from which everything else is read.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import qmc

from .candidates import Candidate
from .draws import ENOUGH_SEEDS, Bench, Draw, Target, distances, draw, misfit, scatter_of_kin

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
