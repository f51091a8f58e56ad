"""Windows thrown off course: their states are fitted once more from other places."""

from __future__ import annotations

import numpy as np

from .fit import fit
from .fitted import Point
from .problem import Problem

#: A window is lost that leaves more than so many times the mean square of the run's median one,
#: and than of noise.
_TIMES, _LEAST = 4.0, 4.0
#: Velocities along x, in parts of the surface's, and turns (rad) of a block put down askew that it
#: may have set out with.
_VELOCITIES, _TURNS = (1.0, 0.9, 0.5, 0.0, -0.5), (0.05, -0.05, 0.1, -0.1)
#: Rounds that a state takes to settle, and the part of its sum of squares that must go.
_ROUNDS, _CLEARLY = 3, 0.9


def with_lost_windows_found(problem: Problem, point: Point) -> Point:
    """Each lost window's state where it fits best of those that lead on from some other places."""
    states = [_found(problem, run, point) for run in range(len(problem.flights))]
    if all(new is old for new, old in zip(states, point.states, strict=True)):
        return point
    return Point(point.shared, point.own, tuple(states))


def _found(problem: Problem, run: int, point: Point) -> np.ndarray:
    """(windows, 6) of one run; the very same where nothing is better."""
    best = point.states[run]
    least = _squares(problem, run, point, best)
    lost = _lost(problem, run, least)
    if not lost.any():
        return best
    alone = Problem([problem.flights[run]], problem.free_parameters, problem.settings)
    for axis, value in _places(problem, run):
        tried = best.copy()
        here = lost & [axis in window.free for window in problem.flights[run].windows]
        if not here.any():
            continue
        tried[here] = problem.flights[run].starts[here]
        tried[here, axis] = value
        first = Point(point.shared, (point.own[run],), (tried,))
        tried = fit(alone, first, _ROUNDS, fixed=True).point.states[0]
        squares = _squares(problem, run, point, tried)
        better = here & (squares < _CLEARLY * least)
        if better.any():
            best = np.where(better[:, None], tried, best)
            least = np.where(better, squares, least)
    return best


def _squares(problem: Problem, run: int, point: Point, states: np.ndarray) -> np.ndarray:
    """(windows,) sums of squares of one run with other states."""
    return problem.by_window(run, problem.residuals(run, point.shared, point.own[run], states))


def _lost(problem: Problem, run: int, squares: np.ndarray) -> np.ndarray:
    """(windows,) whether each is lost."""
    rows = np.maximum(np.bincount(problem.flights[run].window_of_rows(), minlength=squares.size), 1)
    mean = squares / rows
    return mean > np.maximum(_TIMES * np.median(mean), _LEAST)


def _places(problem: Problem, run: int) -> list[tuple[int, float]]:
    """Numbers of the state and values to set out from."""
    speed = problem.flights[run].speed
    return [(3, part * speed) for part in _VELOCITIES] + [(2, turn) for turn in _TURNS]
