"""How far a run would set two models apart, after all that a refit could do about it.

Suppose the truth is one model and another is fitted to the campaign and the new run together. Its
states in the new run are free; its parameters may move, at the price of what the campaign already
knows of them (the information matrix at its fit). The sum of squares that is left is what the new
run tells against it. Gauss-Newton steps find it; the first one alone is the linearised answer.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cosim.gap.estimation.columns import Columns
from cosim.gap.estimation.descent import Damping, Descent
from cosim.gap.estimation.fitted import Point
from cosim.gap.estimation.phases import with_phases
from cosim.gap.estimation.segmented_run import SegmentedRun

from .member import Member
from .rehearsal import problem_of

#: Levenberg-Marquardt: damping at first, and how often a step is damped more before it is given up.
_DAMPING, _TRIES = Damping(harder=10.0, easier=0.1, least=0.0, lasting=True), 4


def separation(
    truth: SegmentedRun, member: Member, information: np.ndarray, rounds: int = 0
) -> float:
    """Root mean square over the new run's samples, in units of the noise, of what cannot be fitted.

    rounds : Levenberg-Marquardt steps that are really simulated; 0: the linearised answer.
    """
    problem = problem_of(truth, member)
    known = member.point
    point = with_phases(problem, Point(known.shared, known.own, (truth.starts,)))
    objective = _Both(known.shared, information)
    descent = Descent(problem, objective, point, _DAMPING)
    shared = range(len(problem.shared))
    size = descent.residuals[0].size
    if not rounds:
        return float(np.sqrt(_left(descent.columns(shared)[0], information) / size))
    for _ in range(rounds):
        descent.goes_down(descent.columns(shared), _TRIES)
    return float(np.sqrt(descent.cost / size))


@dataclass(frozen=True)
class _Both:
    """Misfit in the new run, and in the campaign as its information has it.

    known : (g,) shared free parameters where the campaign alone wants them, scaled
    information : (g, g) inverse of their covariance
    """

    known: np.ndarray
    information: np.ndarray

    def cost(self, point: Point, residuals: Sequence[np.ndarray]) -> float:
        (new,) = residuals
        moved = point.shared - self.known
        return float(new @ new + moved @ self.information @ moved)

    def step(self, point: Point, columns: Sequence[Columns], damping: float) -> np.ndarray:
        return _step(columns[0], self.information, point.shared - self.known, damping)


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
