"""A first sieve: what each law could take away from the misfit if its answer were linear.

The law is put into the fitted model as next to nothing; its answer, less what the model's own knobs
and the runs' states can take up, is laid along the residuals (a score test, Rao 1948).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from cosim.gap.candidates.candidate import Candidate
from cosim.gap.shooting.fitted import Fitted
from cosim.gap.shooting.flight import Flight
from cosim.gap.shooting.problem import Problem
from cosim.gap.shooting.trial import Model
from cosim.processes import Map

Answer = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def gains(
    flights: Sequence[Flight], base: Model, fitted: Fitted, laws: Sequence[Candidate], mapped: Map
) -> np.ndarray:
    """(laws,) part of the sum of squares that each law's answer explains; 0 if it points away.

    fitted : of the base, with derivatives
    """
    runs = [(flight, base, fitted, i, laws) for i, flight in enumerate(flights)]
    parts = list(mapped(answers, runs))
    normal, across, own, right = (np.sum(part, axis=0) for part in zip(*parts, strict=True))
    count = normal.shape[0] - 1  # the last row and column are the residuals
    taken = np.linalg.lstsq(normal[:count, :count], across[:count], rcond=1e-10)[0]
    left = own - np.einsum("gl,gl->l", across[:count], taken)
    along = right - taken.T @ normal[:count, count]
    return np.where(along < 0.0, along**2 / np.maximum(left, 1e-12 * np.maximum(own, 1e-300)), 0.0)


def answers(
    flight: Flight, base: Model, fitted: Fitted, run: int, laws: Sequence[Candidate]
) -> Answer:
    """Products, over one run, of the knobs' columns (g) and residuals with the laws' answers (l).

    (g + 1, g + 1), (g + 1, l), (l,) and (l,): among knobs and residuals, of these with the
    answers, of each answer with itself, and with the residuals.
    """
    at = fitted.point.shared, fitted.point.own[run], fitted.point.states[run]
    residuals, columns = fitted.residuals[run], fitted.columns[run]
    found = [_answer(flight, base, law, at) - residuals for law in laws]
    left = columns.left(np.column_stack([columns.shared, residuals]))
    turned = columns.left(np.column_stack(found))
    return left.T @ left, left.T @ turned, np.sum(turned**2, axis=0), left[:, -1] @ turned


def _answer(flight: Flight, base: Model, law: Candidate, at) -> np.ndarray:
    """Residuals with the law in the model, all but absent."""
    faint = {knob.key: knob.start for knob in law.faint().knobs}
    settings = {**base.settings, **law.settings, **faint}
    knobs = tuple(knob for knob in base.knobs if knob.key not in faint)
    kept = [s for k, s in zip([k for k in base.knobs if not k.per_run], at[0], strict=True)
            if k.key not in faint]
    return Problem([flight], knobs, settings).residuals(0, np.array(kept), *at[1:])
