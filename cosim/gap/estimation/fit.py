"""Least squares over parameters, with the segments' states and the runs' phases eliminated.

Levenberg-Marquardt on the parameters of the campaign; what belongs to one run alone follows.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from cosim.processes import is_stopped

from .columns import Columns
from .fitted import Fitted, Point
from .problem import Problem

#: Converged when a step lowers the sum of squares by less than this, and than this part of what it
#: is above that of noise: a model that does not fit need not do so to the last digit.
_ENOUGH, _PART_OF_EXCESS = 0.02, 1e-3
MOST_ROUNDS = 25
#: Steps tried in a round, each eight times as damped as the one before.
MOST_TRIES = 12
#: Most further steps by the derivatives of a round.
_CHORDS = 2
#: Longest step of a round, in steps of a free parameter: a parameter that is thrown to where the motion does
#: not feel it any more never comes back.
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
    way = _Descent(problem, point, fixed)
    for _ in range(rounds):
        if is_stopped():  # nobody waits for it any more
            break
        columns = (
            way.columns()
            if derivatives is None
            else [derivatives(i, way.point, r) for i, r in enumerate(way.residuals)]
        )
        if not way.gains(columns, tries):
            break
        # derivatives are most of the work, and do for another step or two (Shamanskii 1967)
        for _ in range(_CHORDS):
            again = [replace(c, residuals=r) for c, r in zip(columns, way.residuals, strict=True)]
            if fixed or derivatives or not way.gains(again, 1):
                break
    return Fitted(problem.free_parameters, way.point, way.residuals)


class _Descent:
    """A fit on its way: where it stands, what it costs, how damped its steps are."""

    def __init__(self, problem: Problem, point: Point, fixed: bool):
        self.problem, self.point, self.fixed = problem, point, fixed
        self.residuals = problem.all_residuals(point)
        self.cost, self.damping = _cost(problem, point, self.residuals), 1e-3

    def columns(self) -> list[Columns]:
        """Derivatives of every run where it stands."""
        free = [] if self.fixed else range(len(self.problem.shared))
        return [self.problem.columns(i, self.point, r, free) for i, r in enumerate(self.residuals)]

    def gains(self, columns: Sequence[Columns], tries: int) -> bool:
        """Take the first of so many steps, ever shorter, that leads down: whether by enough."""
        damping = self.damping
        for _ in range(1 if self.fixed else tries):
            step = np.zeros(len(self.problem.shared))
            if not self.fixed:
                step = _step(self.problem, self.point, columns, damping)
            point, residuals = self.problem.tried(self.point, step, columns)
            cost = _cost(self.problem, point, residuals)
            if cost < self.cost:
                excess_chi_square = cost - sum(r.size for r in residuals)
                enough = self.cost - cost > max(_ENOUGH, _PART_OF_EXCESS * excess_chi_square)
                self.point, self.residuals, self.cost = point, residuals, cost
                self.damping = max(0.2 * damping, 1e-9)
                return enough
            damping *= 8.0
        return False


def _cost(problem: Problem, point: Point, residuals) -> float:
    known = problem.prior(point.shared)[0]
    return float(sum(r @ r for r in residuals) + known @ known)


def _step(problem: Problem, point: Point, columns: Sequence[Columns], damping: float):
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


def _inside(problem: Problem, shared: np.ndarray, matrix: np.ndarray, right: np.ndarray):
    """Solution of the normal equations; a free parameter that would leave its range by it stays at its end.

    The others then make the best of it, which a step cut off afterwards would not.
    """
    step, free = np.zeros(right.size), np.ones(right.size, dtype=bool)
    while free.any():
        held = matrix[np.ix_(free, ~free)] @ step[~free]
        step[free] = np.linalg.lstsq(matrix[np.ix_(free, free)], right[free] - held, rcond=None)[0]
        reach = (
            np.array(
                [
                    free_parameter.inside(s)
                    for free_parameter, s in zip(problem.shared, shared + step, strict=True)
                ]
            )
            - shared
        )
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
