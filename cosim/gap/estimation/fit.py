"""Least squares over a campaign's free parameters; what belongs to one run alone follows them.

The states of the shooting segments and the phases of the runs are eliminated (see `columns`), so
that Levenberg-Marquardt steps are those of the shared free parameters alone.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cosim.processes import is_stopped

from .columns import Columns
from .descent import Damping, Descent
from .fitted import Fitted, Point
from .problem import Problem

#: Rounds of a fit, each with derivatives of its own.
MOST_ROUNDS = 25
#: Steps tried in a round, each eight times as damped as the one before.
MOST_TRIES = 12
#: Most further steps by the derivatives of a round.
_CHORDS = 2
#: Longest step of a round, in steps of a free parameter: one that is thrown to where the motion
#: does not feel it any more never comes back.
_LONGEST = 4.0

#: Of a run, at a point, with its residuals there.
Derivatives = Callable[[int, Point, np.ndarray], Columns]


def fit(
    problem: Problem,
    point: Point,
    rounds: int = MOST_ROUNDS,
    fixed: bool = False,
    derivatives: Derivatives | None = None,
    tries: int = MOST_TRIES,
) -> Fitted:
    """The best point from a first one.

    fixed : only what belongs to the runs moves; derivatives : others than the model's own there;
    tries : steps in a round until one leads on
    """
    shared = [] if fixed else list(range(len(problem.shared)))
    descent = Descent(problem, _Campaign(problem, fixed), point, Damping())
    for _ in range(rounds):
        if is_stopped():  # nobody waits for it any more
            break
        columns = (
            descent.columns(shared)
            if derivatives is None
            else [derivatives(i, descent.point, r) for i, r in enumerate(descent.residuals)]
        )
        if not descent.goes_down(columns, 1 if fixed else tries):
            break
        # derivatives are most of the work, and do for another step or two (Shamanskii 1967)
        for _ in range(_CHORDS):
            again = [
                replace(c, residuals=r) for c, r in zip(columns, descent.residuals, strict=True)
            ]
            if fixed or derivatives or not descent.goes_down(again, 1):
                break
    return Fitted(problem.free_parameters, descent.point, descent.residuals)


@dataclass(frozen=True)
class _Campaign:
    """Misfit of all runs and of what is known beforehand; fixed: the shared ones stay."""

    problem: Problem
    fixed: bool

    def cost(self, point: Point, residuals: Sequence[np.ndarray]) -> float:
        known = self.problem.prior(point.shared)[0]
        return float(sum(r @ r for r in residuals) + known @ known)

    def step(self, point: Point, columns: Sequence[Columns], damping: float) -> np.ndarray:
        if self.fixed:
            return np.zeros(len(self.problem.shared))
        return _step(self.problem, point, columns, damping)


def _step(problem: Problem, point: Point, columns: Sequence[Columns], damping: float) -> np.ndarray:
    """Of the campaign's free parameters: normal equations of what the runs' own columns leave."""
    known, weight = problem.prior(point.shared)
    matrix, right = np.diag(weight**2), -weight * known
    for c in columns:
        left = c.left(c.shared)
        matrix = matrix + left.T @ left
        right = right - left.T @ c.residuals
    diagonal = np.diag(matrix)
    matrix = matrix + damping * np.diag(diagonal + 1e-12 * diagonal.max(initial=0.0) + 1e-300)
    step = _inside(problem, point.shared, matrix, right)
    return step * min(1.0, _LONGEST / max(np.abs(step).max(initial=0.0), 1e-300))


def _inside(
    problem: Problem, shared: np.ndarray, matrix: np.ndarray, right: np.ndarray
) -> np.ndarray:
    """(g,) solution of the normal equations; what would leave its range by it stays at its end.

    The other free parameters then make the best of it, which a step cut off afterwards would not.
    """
    step, free = np.zeros(right.size), np.ones(right.size, dtype=bool)
    while free.any():
        held = matrix[np.ix_(free, ~free)] @ step[~free]
        step[free] = np.linalg.lstsq(matrix[np.ix_(free, free)], right[free] - held, rcond=None)[0]
        reach = problem.inside(shared + step) - shared
        out = free & (np.abs(reach - step) > 1e-12 * (1.0 + np.abs(step)))
        if not out.any():
            break
        step[out] = reach[out]
        free &= ~out
    return step


def with_columns(problem: Problem, fitted: Fitted) -> Fitted:
    """The same fit with derivatives taken at its end."""
    columns = tuple(
        problem.columns(i, fitted.point, r, range(len(problem.shared)))
        for i, r in enumerate(fitted.residuals)
    )
    return replace(fitted, columns=columns)
