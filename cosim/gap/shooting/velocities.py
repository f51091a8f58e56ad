"""Other velocities for windows in which the model sticks where the block slides."""

from __future__ import annotations

import numpy as np

from .fitted import Point
from .problem import Problem

#: Velocities that a moving window may set out with beside that read off, in parts of the
#: surface's; one must leave less than this part of the window's sum of squares, and so much less.
_VELOCITIES, _CLEARLY, _BY_MORE = (0.95, 0.8, 0.5, 0.0, -0.5), 0.7, 10.0


def with_velocities(problem: Problem, point: Point) -> Point:
    """Each moving window's velocity where it fits best of a few, its present one included.

    Read off the data it may be so near the surface's that the model sticks from the start, and
    then no small change of it is felt. The rest of the state is as it was read off: a fit has made
    up for the velocity by it.
    """
    states = []
    for run, flight in enumerate(problem.flights):
        best, moving = point.states[run], np.array([3 in window.free for window in flight.windows])
        at = point.shared, point.own[run]
        least = problem.by_window(run, problem.residuals(run, *at, best))
        for part in _VELOCITIES if moving.any() else ():
            tried = point.states[run].copy()
            tried[moving] = flight.starts[moving]
            tried[moving, 3] = part * flight.speed
            squares = problem.by_window(run, problem.residuals(run, *at, tried))
            better = squares < _CLEARLY * least - _BY_MORE
            if not better.any():
                continue
            best, least = np.where(better[:, None], tried, best), np.where(better, squares, least)
        states.append(best)
    if all(a is b for a, b in zip(states, point.states, strict=True)):
        return point
    return Point(point.shared, point.own, tuple(states))
