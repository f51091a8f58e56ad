"""A model laid along the data: friction of every stretch of a run is its own, within a spread.

What a model lacks then shows as friction, springs or a surface's speed that differ from run to run
and from stretch to stretch, not as motions that run apart: every model answers nearly linearly
about such a fit. It sets out from the balance of forces: a stick ends where springs pull with
mu_s N, and a block swings about where they pull with mu_k N.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from stickslip.effects.candidate import FreeParameter
from stickslip.packing import GRAVITY

from cosim.gap.data import MeasuredRun, cycle_features
from cosim.gap.estimation.drive import (
    FRICTION_OFFSET,
    SCATTERED,
    SPEED_OFFSET,
    SPRINGS_OFFSET,
    parts_at,
)
from cosim.gap.estimation.fit import fit, fit_runs, with_columns
from cosim.gap.estimation.fitted import Fitted, Point, start
from cosim.gap.estimation.phases import with_phases
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import SegmentedRun
from cosim.gap.estimation.segments import FRICTION
from cosim.gap.estimation.trial import Model
from cosim.processes import Map, map_here

#: How far what is a run's own may be off, so that nothing but noise is left: parts of itself.
LOOSE = {FRICTION_OFFSET: 0.5, SPEED_OFFSET: 0.03}
#: The same of a run's springs, in runs that are laid along the data by little and by much, and of
#: friction and static friction from stretch to stretch.
SPRINGS = FreeParameter(SPRINGS_OFFSET, 0.0, 0.01, -2.0, 2.0, per_run=True, prior=0.5)
NEAR, FAR = 0.02, 0.5
LOOSELY = (0.2, 0.2)
#: Rounds of a fit with the shared numbers fixed, and of one of them all.
_FOLLOW, _ROUNDS = 6, 5
#: A run with so large a root mean square residual sets out anew, from these.
_LOST, _BETTER, _TURNS = 2.0, 4.0, 2
#: Where so little is left, springs are near what is stated.
_NEAR_ENOUGH = 1.5
_OTHERWISE = (
    (SPRINGS_OFFSET, 0.5),
    (SPRINGS_OFFSET, 1.0),
    (SPRINGS_OFFSET, -0.4),
    (FRICTION_OFFSET, 0.4),
    (FRICTION_OFFSET, -0.3),
)


def loosened(free_parameters: Sequence[FreeParameter], springs: float) -> tuple[FreeParameter, ...]:
    """A model's free parameters, what is a run's own within wide bounds; springs : NEAR or FAR."""
    loose = [replace(f, prior=_loose(f)) for f in free_parameters]
    return (*loose, replace(SPRINGS, prior=springs))


def _loose(free: FreeParameter) -> float | None:
    if free.key in SCATTERED:  # or what is a run's own would take their place
        return 0.1 * free.start
    return LOOSE.get(free.key, free.prior)


def aligned(
    segmented: Sequence[SegmentedRun],
    runs: Sequence[MeasuredRun],
    model: Model,
    mapped: Map = map_here,
    springs: float | None = None,
) -> tuple[Problem, Fitted]:
    """The problem with loose numbers and its fit, derivatives included.

    springs : NEAR or FAR; where neither is said, whichever fits
    """
    if springs is not None:
        return _aligned(segmented, runs, model, springs, springs == FAR, mapped)
    near = _aligned(segmented, runs, model, NEAR, False, mapped)
    if near[1].rms_residual() < _NEAR_ENOUGH:
        return near
    far = _aligned(segmented, runs, model, FAR, True, mapped)
    return min(near, far, key=lambda found: found[1].rms_residual())


def _aligned(
    segmented, runs, model: Model, springs: float, otherwise: bool, mapped: Map
) -> tuple[Problem, Fitted]:
    free_parameters = loosened(model.free_parameters, springs)
    problem = Problem(segmented, free_parameters, model.settings, LOOSELY)
    point = start(segmented, free_parameters)
    states = [_balanced(*each, problem) for each in zip(segmented, runs, strict=True)]
    point = with_phases(problem, Point(point.shared, point.own, tuple(states)))
    for turn in range(_TURNS):
        found = fit_runs(problem, point, _FOLLOW, mapped)
        if otherwise and turn == 0:
            found = _with_lost_runs_found(problem, point, found, mapped)
        point = _with_shared_fitted(problem, found, mapped)
    fitted = fit_runs(problem, point, _ROUNDS, mapped)
    return problem, with_columns(problem, fitted, mapped=mapped)


def _with_shared_fitted(problem: Problem, fitted: Fitted, mapped: Map) -> Point:
    """The shared numbers (the contact's) fitted to the runs that are laid along the data."""
    good = [i for i in range(len(fitted.residuals)) if fitted.rms_residual([i]) < _BETTER]
    if not good:
        return fitted.point
    some = Problem(
        [problem.segmented_runs[i] for i in good],
        problem.free_parameters,
        problem.settings,
        problem.local,
    )
    own, states = list(fitted.point.own), list(fitted.point.states)
    first = Point(fitted.point.shared, tuple(own[i] for i in good), tuple(states[i] for i in good))
    again = fit(some, first, _ROUNDS, mapped=mapped)
    for place, i in enumerate(good):
        own[i], states[i] = again.point.own[place], again.point.states[place]
    return Point(again.point.shared, tuple(own), tuple(states))


def _with_lost_runs_found(problem: Problem, before: Point, fitted: Fitted, mapped: Map) -> Fitted:
    """Where a run is not laid along the data, from other springs or other friction."""
    runs = range(len(before.own))
    calls = [(problem.of_run(i), before.of_run(i), fitted.of_run(i)) for i in runs]
    return Fitted.joined(list(mapped(_found, calls)))


def _found(problem: Problem, before: Point, fitted: Fitted) -> Fitted:
    """One run."""
    places = {free.key: (j, free) for j, free in enumerate(problem.own)}
    for key, value in _OTHERWISE:
        if fitted.rms_residual() < _LOST:
            break
        j, free = places[key]
        start = before.own[0].copy()
        start[j] = free.scaled(value)
        again = fit(problem, replace(before, own=(start,)), _FOLLOW, fixed=True)
        fitted = min(fitted, again, key=Fitted.rms_residual)
    return fitted


def _balanced(segmented: SegmentedRun, run: MeasuredRun, problem: Problem) -> np.ndarray:
    """(segments, 8) states with friction where the balance of forces puts it."""
    states = segmented.starts
    values = {free.key: free.start for free in problem.shared}
    at_speed = float(parts_at(problem.settings, np.array([abs(run.surface_speed)]))[0])
    mu_s, mu_k = values["friction.mu_s"], at_speed * values["friction.mu_k"]
    features = cycle_features(run)
    per_metre = run.total_stiffness / (run.mass * GRAVITY)
    high, low = features.break_away_x.value, features.restick_x.value
    sign = 1.0 if run.surface_speed > 0.0 else -1.0
    if np.isfinite(high + low) and sign * high > 0.0 and sign * (high + low) > 0.0:
        kinetic = np.log(0.5 * per_metre * sign * (high + low) / mu_k)
        states[:, FRICTION[0]] = kinetic
        states[:, FRICTION[1]] = np.log(per_metre * sign * high / mu_s) - kinetic
    else:
        mean = features.mean_x.value
        if np.isfinite(mean) and sign * mean > 0.0:
            states[:, FRICTION[0]] = np.log(per_metre * sign * mean / mu_k)
    return states
