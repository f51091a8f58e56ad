"""How far a model's figures are from the observed ones.

Two measures. The *gap* is the root mean square distance of the model's mean figures from the
observed ones, in the observations' standard deviations: what is drawn and reported. The
*misfit* is -2 log likelihood less that of a perfect model: it takes the scatter of the model's own
figures from seed to seed (the study's scheme is chaotic) as part of what the model predicts, at the
price of a wider prediction, and adds how far the known numbers were stretched.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .observations import Observation
from .table import Draw

# seeds from which a draw's own scatter is taken; below, that of its kin
ENOUGH_SEEDS = 4
KIN_SEEDS = 3


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
    """(n,) standard deviation of a draw's figures from seed to seed.

    A few seeds tell a scatter badly, so the kin's counts as `KIN_SEEDS` more of them.
    """
    if one.seeds < ENOUGH_SEEDS:
        return kin
    own = one.seeds - 1
    variance = own * one.shown.var(axis=0, ddof=1) + KIN_SEEDS * kin**2
    return np.sqrt(variance / (own + KIN_SEEDS))


def terms(one: Draw, target: Target, kin: np.ndarray) -> np.ndarray:
    """(n,) the figures' parts of `misfit`."""
    own = scatter(one, kin) ** 2 * (1.0 + 1.0 / one.seeds)
    wider = 1.0 + own / target.sds**2  # variance of the prediction over that of the observation
    return distances(one.mean, target) ** 2 / wider + np.log(wider)


def misfit(one: Draw, target: Target, kin: np.ndarray) -> float:
    """-2 log likelihood of a draw, less that of one that meets every figure without scatter."""
    return float(terms(one, target, kin).sum()) + one.surprise


def chi_square(one: Draw, target: Target, kin: np.ndarray) -> float:
    """Sum of squared distances in the standard deviations of observation and model together."""
    own = scatter(one, kin) ** 2 * (1.0 + 1.0 / one.seeds)
    return float(np.sum((one.mean - target.sizes) ** 2 / (target.sds**2 + own)) + one.surprise)


def best(draws: Sequence[Draw], target: Target, kin: np.ndarray) -> Draw:
    """The draw of least misfit."""
    return min(draws, key=lambda one: misfit(one, target, kin))
