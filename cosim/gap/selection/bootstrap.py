"""How often chance alone makes the best of the catalogue seem as good as it does.

The parametric bootstrap: noise is drawn as the plain model has it, every law that came into the
last round is fitted to it (linearised where it was fitted to the measurement), and the best of
them on the held-out runs is noted. Choosing the best is part of what is drawn.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cosim.gap.estimation.fit import with_columns
from cosim.gap.estimation.fitted import Fitted, shared_of
from cosim.gap.estimation.preparation import Data
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.trial import Trial

DRAWS = 199


@dataclass(frozen=True)
class _Law:
    """Derivatives by all free parameters, runs on end, less what the runs' states take up."""

    fit: np.ndarray
    held_out: np.ndarray
    plain: np.ndarray
    weight: np.ndarray


def chance(data: Data, plain: Trial, trials: Sequence[Trial], seed: int) -> dict[str, float]:
    """p of the best law's gain on the held-out runs, and the draws that it rests on."""
    shared = len(shared_of(plain.model.free_parameters))
    laws = [_law(data, trial, shared) for trial in trials]
    random = np.random.default_rng(seed)
    gains = [_best_gain(laws, random) for _ in range(DRAWS)]
    observed = max(_gain(plain, trial) for trial in trials)
    if not data.held_out:  # then there is nothing that a law could not have been fitted to
        observed = max(plain.fitted.cost - trial.fitted.cost for trial in trials)
    worse = sum(gain >= observed for gain in gains)
    return {"p": (1 + worse) / (1 + DRAWS), "draws": DRAWS}


def _gain(plain: Trial, trial: Trial) -> float:
    return plain.held_out.cost - trial.held_out.cost


def _law(data: Data, trial: Trial, plain_free_parameters: int) -> _Law:
    problem = Problem(data.held_out, trial.model.free_parameters, trial.model.settings)
    held_out = with_columns(problem, trial.held_out)
    shared = shared_of(trial.model.free_parameters)
    plain = np.arange(len(shared)) < plain_free_parameters
    weight = np.array([free.step / free.prior if free.prior else 0.0 for free in shared])
    return _Law(_stacked(trial.fitted), _stacked(held_out), plain, weight)


def _stacked(fitted: Fitted) -> np.ndarray:
    shared = len(shared_of(fitted.free_parameters))
    none = np.empty((0, shared))
    return np.concatenate([none, *(c.left(c.shared) for c in fitted.derivatives)])


def _best_gain(laws: Sequence[_Law], random: np.random.Generator) -> float:
    """The best gain over the plain model when there is nothing but noise."""
    noise = random.standard_normal(laws[0].fit.shape[:1])
    kept_back = random.standard_normal(laws[0].held_out.shape[:1])
    return max(
        _cost(law, law.plain, noise, kept_back) - _cost(law, law.plain | True, noise, kept_back)
        for law in laws
    )


def _cost(law: _Law, turned: np.ndarray, noise: np.ndarray, kept_back: np.ndarray) -> float:
    """Sum of squares on the held-out runs, the parameters ``turned`` fitted to the others."""
    left = law.fit[:, turned]
    normal = left.T @ left + np.diag(law.weight[turned] ** 2)
    step = -np.linalg.lstsq(normal, left.T @ noise, rcond=1e-12)[0]
    if kept_back.size:
        moved = kept_back + law.held_out[:, turned] @ step
    else:  # nothing is held out: what counts is the fit itself
        moved = noise + left @ step
    return float(moved @ moved)
