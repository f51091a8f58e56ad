"""Least squares over a campaign's free parameters; what belongs to one run alone follows them.

The states of the shooting segments and the phases of the runs are eliminated (see `columns`), so
that Levenberg-Marquardt steps are those of the shared free parameters alone.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from cosim.processes import Map, is_stopped, map_here

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
#: Derivatives are those of where a fit stands, if steps by them gained less than this of the sum of
#: squares, and than this part of it.
_SETTLED, _SETTLED_PART = 1.0, 1e-3
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
    mapped: Map = map_here,
) -> Fitted:
    """The best point from a first one.

    fixed : only what belongs to the runs moves; derivatives : others than the model's own there;
    tries : steps in a round until one leads on; mapped : over runs, for their derivatives
    """
    shared = [] if fixed else list(range(len(problem.shared)))
    descent = Descent(problem, _Campaign(problem, fixed), point, Damping())
    for _ in range(rounds):
        if is_stopped():  # nobody waits for it any more
            break
        columns = (
            _derivatives(problem, descent.point, descent.residuals, shared, mapped)
            if derivatives is None
            else [derivatives(i, descent.point, r) for i, r in enumerate(descent.residuals)]
        )
        if not descent.goes_down(columns, 1 if fixed else tries):
            break
        # derivatives are most of the work, and do for another step or two (Shamanskii 1967)
        if derivatives is None:
            _by_chords(descent, columns, _CHORDS)
    return Fitted(problem.free_parameters, descent.point, descent.residuals)


def fit_runs(problem: Problem, point: Point, rounds: int, mapped: Map = map_here) -> Fitted:
    """As `fit` with the shared numbers fixed, every run alone."""
    runs = range(len(point.own))
    alone = [(problem.of_run(run), point.of_run(run), rounds, True) for run in runs]
    return Fitted.joined(list(mapped(fit, alone)))


def follow(
    problem: Problem,
    point: Point,
    columns: Sequence[Columns],
    rounds: int,
    mapped: Map = map_here,
) -> Fitted:
    """What belongs to the runs follows shared numbers that were moved; derivatives included.

    columns : of a point nearby: they do for the first steps; rounds : most times that they are
    taken anew
    """
    alone = [
        (problem.of_run(run), point.of_run(run), near, rounds) for run, near in enumerate(columns)
    ]
    return Fitted.joined(list(mapped(_followed, alone)))


def _followed(problem: Problem, point: Point, near: Columns, rounds: int) -> Fitted:
    """One run."""
    descent = Descent(problem, _Campaign(problem, fixed=True), point, Damping())
    columns = [near]
    _by_chords(descent, columns)
    everything = range(len(problem.shared))
    for _ in range(rounds):
        columns, before = descent.columns(everything), descent.cost
        _by_chords(descent, columns)
        if before - descent.cost < max(_SETTLED, _SETTLED_PART * descent.cost):
            break
    there = tuple(replace(c, residuals=r) for c, r in zip(columns, descent.residuals, strict=True))
    return Fitted(problem.free_parameters, descent.point, descent.residuals, there)


def _by_chords(descent: Descent, columns: Sequence[Columns], most: int = 1 + _CHORDS) -> None:
    """So many steps by the derivatives of one point, as long as they lead on."""
    for _ in range(most):
        here = [replace(c, residuals=r) for c, r in zip(columns, descent.residuals, strict=True)]
        if not descent.goes_down(here, 1):
            break


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


def with_columns(
    problem: Problem,
    fitted: Fitted,
    by: Sequence[int] | None = None,
    mapped: Map = map_here,
) -> Fitted:
    """The same fit with derivatives taken at its end; by: which shared numbers, all if not said."""
    by = range(len(problem.shared)) if by is None else by
    columns = _derivatives(problem, fitted.point, fitted.residuals, by, mapped)
    return replace(fitted, columns=tuple(columns))


def _derivatives(
    problem: Problem,
    point: Point,
    residuals: Sequence[np.ndarray],
    by: Sequence[int],
    mapped: Map,
) -> list[Columns]:
    """Of every run."""
    alone = [(problem.of_run(i), point.of_run(i), r, by) for i, r in enumerate(residuals)]
    return list(mapped(_columns, alone))


def _columns(problem: Problem, point: Point, residuals: np.ndarray, by: Sequence[int]) -> Columns:
    """Of a run alone."""
    return problem.columns(0, point, residuals, by)
