"""How far a run would set two models apart, after all that a refit could do about it.

Suppose the truth is one model and another is fitted to the campaign and the new run together. Its
states in the new run are free; its parameters may move, at the price of what the campaign already
knows of them (the information matrix at its fit). The sum of squares that is left is what the new
run tells against it. Gauss-Newton steps find it; the first one alone is the linearised answer.
"""

from __future__ import annotations

import numpy as np

from cosim.gap.estimation.columns import Columns
from cosim.gap.estimation.fitted import Point
from cosim.gap.estimation.phases import with_phases
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import SegmentedRun

from .member import Member
from .rehearsal import problem_of

#: Levenberg-Marquardt: damping at first, and how often a step is damped more before it is given up.
_DAMPING, _TRIES = 1e-3, 4


def separation(
    truth: SegmentedRun, member: Member, information: np.ndarray, rounds: int = 0
) -> float:
    """Root mean square over the new run's samples, in units of the noise, of what cannot be fitted.

    rounds : Levenberg-Marquardt steps that are really simulated; 0: the linearised answer.
    """
    problem = problem_of(truth, member)
    known = member.point
    point = with_phases(problem, Point(known.shared, known.own, (truth.starts,)))
    residuals = problem.residuals(0, point.shared, point.own[0], point.states[0])
    if not rounds:
        columns = _columns(problem, point, residuals)
        return float(np.sqrt(_left(columns, information) / residuals.size))
    cost, damping = float(residuals @ residuals), _DAMPING
    for _ in range(rounds):
        columns = _columns(problem, point, residuals)
        for _ in range(_TRIES):
            step = _step(columns, information, point.shared - known.shared, damping)
            tried, (new,) = problem.tried(point, step, [columns])
            moved = tried.shared - known.shared
            new_cost = float(new @ new + moved @ information @ moved)
            if new_cost < cost:
                point, residuals, cost, damping = tried, new, new_cost, 0.1 * damping
                break
            damping *= 10.0
    return float(np.sqrt(cost / residuals.size))


def _columns(problem: Problem, point: Point, residuals: np.ndarray) -> Columns:
    return problem.columns(0, point, residuals, range(len(problem.shared)))


def _step(
    columns: Columns, information: np.ndarray, moved: np.ndarray, damping: float = 0.0
) -> np.ndarray:
    """Of the shared free parameters, which have moved from where the campaign alone wants them."""
    left = columns.left(columns.shared)
    matrix = left.T @ left + information
    matrix = matrix + damping * np.diag(np.diag(matrix))
    return -np.linalg.lstsq(matrix, left.T @ columns.residuals + information @ moved, rcond=None)[0]


def _left(columns: Columns, information: np.ndarray) -> float:
    """Sum of squares after the first step, as the derivatives have it."""
    step = _step(columns, information, np.zeros(len(information)))
    rest = columns.left(columns.residuals) + columns.left(columns.shared) @ step
    return float(rest @ rest + step @ information @ step)
