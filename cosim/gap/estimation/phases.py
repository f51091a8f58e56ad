"""Where the phases of a run's waves lie: tried round the circle before a fit sets out."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np

from .fit import fit
from .fitted import Fitted, Point
from .problem import Problem

#: Phases, degrees, that a fit may set out from.
_PHASES = np.arange(0.0, 360.0, 60.0)
#: Degrees by which the best of them is then shifted.
_NEARER = 20.0
#: Phases, degrees, of which the best few, so many, are followed by the states, in so many rounds.
_FINE, _FOLLOWED, _ROUNDS = np.arange(0.0, 360.0, 30.0), 3, 3
#: One must leave less than this part of the run's sum of squares.
_CLEARLY = 0.98


def with_phases(problem: Problem, point: Point, keys: Collection[str] | None = None) -> Point:
    """Each run's phases (of ``keys``, or all) where they fit best of a few, the present included.

    A fit gets over an eighth of a turn, not over half of one. All are judged from the
    states read off the data: fitted ones have made up for the present phase.
    """
    turned = [
        j
        for j, free in enumerate(problem.own)
        if free.key.endswith("phase_deg") and (keys is None or free.key in keys)
    ]
    if not turned:
        return point
    own, states = list(point.own), list(point.states)
    for run, now in enumerate(point.own):
        best = _best_phase(problem, run, point.shared, now, turned)
        if best is not now:
            own[run] = best
            states[run] = best_states(problem, run, point.shared, best, point.states[run])
    if all(a is b for a, b in zip(own, point.own, strict=True)):
        return point
    return Point(point.shared, tuple(own), tuple(states))


def _best_phase(problem: Problem, run: int, shared, now: np.ndarray, turned: list[int]):
    """A run's own numbers at the best phase of a circle, then of some near that one."""
    ring = _ring(problem, run, shared, now, turned, _PHASES)
    best = int(np.argmin([cost for cost, _ in ring]))
    if ring[best][0] >= _cost_read_off(problem, run, shared, now):
        return now
    near = _PHASES[best] + np.array([-_NEARER, _NEARER])
    ring = [ring[best], *_ring(problem, run, shared, now, turned, near)]
    return min(ring, key=lambda turn: turn[0])[1]


def _ring(problem: Problem, run: int, shared, now: np.ndarray, turned: list[int], phases):
    """(cost, a run's own numbers) at each of some phases, degrees."""
    ring = []
    for degrees in phases:
        own = now.copy()
        own[turned] = [problem.own[j].scaled(degrees) for j in turned]
        ring.append((_cost_read_off(problem, run, shared, own), own))
    return ring


def _cost_read_off(problem: Problem, run: int, shared, own: np.ndarray) -> float:
    """From the states read off the data."""
    residuals = problem.residuals(run, shared, own, problem.segmented_runs[run].starts)
    return problem.misfit(run, residuals)


def with_phases_followed(problem: Problem, point: Point) -> Point:
    """Each run's phases where they fit best once its segments' states have followed them.

    What states read off the data leave may hide a phase: some fifty simulations of a run tell more.
    """
    turned = [j for j, free in enumerate(problem.own) if free.key.endswith("phase_deg")]
    if not turned:
        return point
    ended = [_followed(problem, run, point, turned) for run in range(len(problem.segmented_runs))]
    if all(fitted is None for fitted in ended):
        return point
    parts = [
        (point.own[i], point.states[i])
        if fitted is None
        else (fitted.point.own[0], fitted.point.states[0])
        for i, fitted in enumerate(ended)
    ]
    own, states = zip(*parts, strict=True)
    return Point(point.shared, own, states)


def _followed(problem: Problem, run: int, point: Point, turned: list[int]) -> Fitted | None:
    """One run fitted from its most promising phases, or None if none leads anywhere."""
    alone = Problem(
        [problem.segmented_runs[run]], problem.free_parameters, problem.settings, problem.local
    )
    now = point.own[run]
    residuals = alone.residuals(0, point.shared, now, point.states[run])
    best, least = None, _CLEARLY * float(residuals @ residuals)
    for own in _promising(problem, run, point, turned):
        states = best_states(problem, run, point.shared, own, point.states[run])
        fitted = fit(alone, Point(point.shared, (own,), (states,)), _ROUNDS, fixed=True)
        if fitted.cost < least:
            best, least = fitted, fitted.cost
    return best


def _promising(problem: Problem, run: int, point: Point, turned: list[int]) -> list[np.ndarray]:
    """A run's own numbers at the best phases of a circle, apart from one another."""
    ring = _ring(problem, run, point.shared, point.own[run], turned, _FINE)
    costs = np.array([cost for cost, _ in ring])
    lows = np.flatnonzero((costs <= np.roll(costs, 1)) & (costs < np.roll(costs, -1)))
    return [ring[i][1] for i in lows[np.argsort(costs[lows])][:_FOLLOWED]]


def best_states(problem: Problem, run: int, shared, own: np.ndarray, states: np.ndarray):
    """Each segment's state, fitted elsewhere, or as read off the data where that is better.

    states : (segments, 8) fitted. Read off, a velocity may be so near the surface's that the
    segment is lost.
    """
    first = problem.segmented_runs[run].starts
    fitted = problem.by_segment(run, problem.residuals(run, shared, own, states))
    read_off = problem.by_segment(run, problem.residuals(run, shared, own, first))
    return np.where((fitted < read_off)[:, None], states, first)
