"""Where the phases of a run's waves lie: tried round the circle before a fit sets out."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from .fitted import Point
from .problem import Problem

#: Phases, degrees, that a fit may set out from.
_PHASES = np.arange(0.0, 360.0, 60.0)
#: Degrees by which the best of them is then shifted.
_NEARER = 20.0


def with_phases(problem: Problem, point: Point, keys: Collection[str] | None = None) -> Point:
    """Each run's phases (of ``keys``, or all) where they fit best of a few, the present included.

    A fit finds its way over an eighth of a turn, not over half of one. All are judged from the
    states read off the data: fitted ones have made up for the present phase.
    """
    turned = [j for j, knob in enumerate(problem.own)
              if knob.key.endswith("phase_deg") and (keys is None or knob.key in keys)]
    if not turned:
        return point
    own, states = list(point.own), list(point.states)
    for run, now in enumerate(point.own):
        best = _best_phase(problem, run, point.shared, now, turned)
        if best is not now:
            own[run] = best
            states[run] = _best_states(problem, run, point.shared, best, point.states[run])
    if all(a is b for a, b in zip(own, point.own, strict=True)):
        return point
    return Point(point.shared, tuple(own), tuple(states))


def _best_phase(problem: Problem, run: int, shared, now: np.ndarray, turned: list[int]):
    """A run's own numbers at the best phase of a circle, then of some near that one."""
    first = problem.flights[run].starts

    def at(degrees: float) -> np.ndarray:
        own = now.copy()
        own[turned] = [problem.own[j].scaled(degrees) for j in turned]
        return own

    def cost(own: np.ndarray) -> float:
        return problem.misfit(run, problem.residuals(run, shared, own, first))

    costs = {degrees: cost(at(degrees)) for degrees in _PHASES}
    best = min(costs, key=costs.get)
    if costs[best] >= cost(now):
        return now
    costs |= {degrees: cost(at(degrees)) for degrees in (best - _NEARER, best + _NEARER)}
    return at(min(costs, key=costs.get))


def _best_states(problem: Problem, run: int, shared, own: np.ndarray, states: np.ndarray):
    """Each window's state, fitted for another phase, or as read off the data where that is better.

    Read off, a velocity may be so near the surface's that the window is lost.
    """
    first = problem.flights[run].starts
    fitted = problem.by_window(run, problem.residuals(run, shared, own, states))
    read_off = problem.by_window(run, problem.residuals(run, shared, own, first))
    return np.where((fitted < read_off)[:, None], states, first)
