"""Other initial states for shooting segments in which the present one leads nowhere."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .fit import fit
from .fitted import Fitted, Point
from .problem import Problem

#: Velocities that a moving segment may set out with beside that read off, in parts of the
#: surface's; one must leave less than this part of the segment's sum of squares, and so much less.
_VELOCITIES, _CLEARLY, _BY_MORE = (0.95, 0.8, 0.5, 0.0, -0.5), 0.7, 10.0
#: A segment is lost that leaves more than so many times the mean square of the run's median one,
#: and than of noise.
_TIMES, _LEAST = 4.0, 4.0
#: Velocities along x, in parts of the surface's, and turns (rad) of a block put down askew that it
#: may have set out with.
_LOST_VELOCITIES, _TURNS = (1.0, 0.9, 0.5, 0.0, -0.5), (0.05, -0.05, 0.1, -0.1)
#: Rounds that a state takes to settle, and the part of its sum of squares that must go.
_ROUNDS, _BETTER = 3, 0.9


def with_velocities(problem: Problem, point: Point) -> Point:
    """Each moving segment's velocity where it fits best of a few, its present one included.

    Read off the data it may be so near the surface's that the model sticks from the start, and
    then no small change of it is felt. The rest of the state is as it was read off: a fit has made
    up for the velocity by it.
    """
    states = []
    for run, segmented in enumerate(problem.segmented_runs):
        best, moving = (
            point.states[run],
            np.array([3 in segment.free for segment in segmented.segments]),
        )
        at = point.shared, point.own[run]
        least = problem.by_segment(run, problem.residuals(run, *at, best))
        for part in _VELOCITIES if moving.any() else ():
            tried = point.states[run].copy()
            tried[moving] = segmented.starts[moving]
            tried[moving, 3] = part * segmented.speed
            squares = problem.by_segment(run, problem.residuals(run, *at, tried))
            better = squares < _CLEARLY * least - _BY_MORE
            if not better.any():
                continue
            best, least = np.where(better[:, None], tried, best), np.where(better, squares, least)
        states.append(best)
    if all(a is b for a, b in zip(states, point.states, strict=True)):
        return point
    return Point(point.shared, point.own, tuple(states))


def with_lost_velocities(problem: Problem, fitted: Fitted) -> Point:
    """As `with_velocities`, of runs with lost segments alone; the very same point without."""
    point, states = fitted.point, list(fitted.point.states)
    for run, residuals in enumerate(fitted.residuals):
        if not _lost(problem, run, problem.by_segment(run, residuals)).any():
            continue
        alone = problem.of_run(run)
        first = Point(point.shared, (point.own[run],), (states[run],))
        states[run] = with_velocities(alone, first).states[0]
    if all(a is b for a, b in zip(states, point.states, strict=True)):
        return point
    return replace(point, states=tuple(states))


def with_lost_segments_found(problem: Problem, point: Point) -> Point:
    """Each lost segment's state where it fits best of those that lead on from some other places."""
    states = [_found(problem, run, point) for run in range(len(problem.segmented_runs))]
    if all(new is old for new, old in zip(states, point.states, strict=True)):
        return point
    return Point(point.shared, point.own, tuple(states))


def _found(problem: Problem, run: int, point: Point) -> np.ndarray:
    """(segments, 8) of one run; the very same where nothing is better."""
    best = point.states[run]
    least = _squares(problem, run, point, best)
    lost = _lost(problem, run, least)
    if not lost.any():
        return best
    alone = problem.of_run(run)
    for axis, value in _places(problem, run):
        tried = best.copy()
        here = lost & [axis in segment.free for segment in problem.segmented_runs[run].segments]
        if not here.any():
            continue
        tried[here] = problem.segmented_runs[run].starts[here]
        tried[here, axis] = value
        first = Point(point.shared, (point.own[run],), (tried,))
        tried = fit(alone, first, _ROUNDS, fixed=True).point.states[0]
        squares = _squares(problem, run, point, tried)
        better = here & (squares < _BETTER * least)
        if better.any():
            best = np.where(better[:, None], tried, best)
            least = np.where(better, squares, least)
    return best


def _squares(problem: Problem, run: int, point: Point, states: np.ndarray) -> np.ndarray:
    """(segments,) sums of squares of one run with other states."""
    return problem.by_segment(run, problem.residuals(run, point.shared, point.own[run], states))


def _lost(problem: Problem, run: int, squares: np.ndarray) -> np.ndarray:
    """(segments,) whether each is lost."""
    rows = np.maximum(
        np.bincount(problem.segmented_runs[run].segment_of_rows(), minlength=squares.size), 1
    )
    mean = squares / rows
    return mean > np.maximum(_TIMES * np.median(mean), _LEAST)


def _places(problem: Problem, run: int) -> list[tuple[int, float]]:
    """Numbers of the state and values to set out from."""
    segmented = problem.segmented_runs[run]
    turns = () if "phi" in segmented.channels else _TURNS  # a turn that was seen is known
    return [(3, part * segmented.speed) for part in _LOST_VELOCITIES] + [
        (2, turn) for turn in turns
    ]
