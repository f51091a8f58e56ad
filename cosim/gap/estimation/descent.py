"""Levenberg-Marquardt: where a fit stands, and the damped steps by which it goes down.

Of steps that are ever more damped, the first that lowers the cost is taken (Levenberg 1944,
Marquardt 1963). What is minimised says itself what it costs and where a step goes; the runs'
own free parameters and the segments' states follow every step (`Problem.tried`).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from .columns import Columns
from .fitted import Point
from .problem import Problem

#: Converged when a step lowers the sum of squares by less than this, and than this part of what it
#: is above that of noise: a model that does not fit need not do so to the last digit.
_ENOUGH, _PART_OF_EXCESS = 0.02, 1e-3


class Objective(Protocol):
    """What is minimised over the campaign's free parameters."""

    def cost(self, point: Point, residuals: Sequence[np.ndarray]) -> float:
        """Sum of squares at a point, that of what is known beforehand included."""

    def step(self, point: Point, columns: Sequence[Columns], damping: float) -> np.ndarray:
        """(g,) step of the campaign's free parameters, scaled, by the derivatives of each run."""


@dataclass(frozen=True)
class Damping:
    """How damped the steps are.

    Attributes
    ----------
    first : of the first step
    harder, easier : factors after a step that leads up, and after one that leads down
    least : it never falls below
    lasting : a search that found no step down leaves its damping to the next one
    """

    first: float = 1e-3
    harder: float = 8.0
    easier: float = 0.2
    least: float = 1e-9
    lasting: bool = False


class Descent:
    """A fit as it goes down: its point, residuals by run, cost, and the damping of its steps."""

    def __init__(self, problem: Problem, objective: Objective, point: Point, damping: Damping):
        self.problem, self.objective, self.schedule = problem, objective, damping
        self.point, self.damping = point, damping.first
        self.residuals = problem.all_residuals(point)
        self.cost = objective.cost(point, self.residuals)

    def columns(self, free: Sequence[int]) -> list[Columns]:
        """Derivatives of every run where it stands, by the shared free parameters ``free``."""
        return [self.problem.columns(i, self.point, r, free) for i, r in enumerate(self.residuals)]

    def goes_down(self, columns: Sequence[Columns], tries: int) -> bool:
        """Take the first of so many steps, ever shorter, that leads down: whether by enough."""
        damping = self.damping
        for _ in range(tries):
            step = self.objective.step(self.point, columns, damping)
            point, residuals = self.problem.tried(self.point, step, columns)
            cost = self.objective.cost(point, residuals)
            if cost < self.cost:
                excess = cost - sum(r.size for r in residuals)
                enough = self.cost - cost > max(_ENOUGH, _PART_OF_EXCESS * excess)
                self.point, self.residuals, self.cost = point, residuals, cost
                self.damping = max(self.schedule.easier * damping, self.schedule.least)
                return enough
            damping *= self.schedule.harder
        if self.schedule.lasting:
            self.damping = damping
        return False
