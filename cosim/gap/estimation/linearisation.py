"""Screening: a law fitted on top of a model by the derivatives that are known of that model.

A law that sets out as next to nothing hardly changes how a motion responds to the free parameters
that were there before. Derivatives by these are taken once, at the linearisation point; only those
by the law's own are taken anew in a round (the chord method): a fifth of the work, and good enough
to tell which laws are worth a fit.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from cosim.gap.estimation.fitted import own_of, shared_of

from .columns import Columns
from .fit import fit, with_columns
from .fitted import Fitted, Point
from .phases import best_states, with_phases
from .preparation import Data
from .problem import Problem
from .trial import Model

#: Steps tried in a round before it is given up: by other derivatives none may lead on.
_TRIES = 4


def linearised(data: Data, model: Model, fitted: Fitted, other: bool = False) -> Fitted:
    """A linearisation point: a fit in short segments with derivatives at its end.

    other : ``model`` has other settings than the fitted one; segments whose states have made up for
    those start from what was read off the data.
    """
    problem = Problem(data.short, model.free_parameters, model.settings)
    point = fitted.point
    if other:
        states = [
            best_states(problem, run, point.shared, own, at)
            for run, (own, at) in enumerate(zip(point.own, point.states, strict=True))
        ]
        point = replace(point, states=tuple(states))
    fitted = replace(fitted, point=point, residuals=problem.all_residuals(point))
    return with_columns(problem, fitted)


def screening_fit(data: Data, model: Model, base: Fitted, rounds: int) -> Fitted:
    """A few rounds in short segments from where the simpler model ``base`` ended (`linearised`)."""
    problem = Problem(data.short, model.free_parameters, model.settings)
    before = {free.key for free in base.free_parameters}
    shared = [
        base.values.get(free.key, free.start) if free.prior else free.start
        for free in problem.shared
    ]
    own = tuple(
        np.array(
            [free.scaled(base.own_values(i).get(free.key, free.start)) for free in problem.own]
        )
        for i in range(len(data.short))
    )
    scaled = [free.scaled(value) for free, value in zip(problem.shared, shared, strict=True)]
    point = Point(np.array(scaled), own, base.point.states)
    new = {free.key for free in problem.own} - before
    point = with_phases(problem, point, new)

    def derivatives(run: int, at: Point, residuals: np.ndarray) -> Columns:
        return _columns(problem, run, at, residuals, base)

    return fit(problem, point, rounds, derivatives=derivatives, tries=_TRIES)


def _columns(problem: Problem, run: int, at: Point, residuals: np.ndarray, base: Fitted) -> Columns:
    """Derivatives of one run: by the base's free parameters and the states as they were there."""
    then = base.derivatives[run]
    point = at.shared, at.own[run], at.states[run]
    known = [free.key for free in shared_of(base.free_parameters)]
    shared = np.empty((residuals.size, len(problem.shared)))
    for j, free in enumerate(problem.shared):
        if free.key in known:
            shared[:, j] = then.shared[:, known.index(free.key)]
        else:
            shared[:, j] = problem.difference(run, point, 0, j, free, residuals)
    known = [free.key for free in own_of(base.free_parameters)]
    own = np.empty((residuals.size, len(problem.own)))
    for j, free in enumerate(problem.own):
        if free.key in known:
            own[:, j] = then.own[:, known.index(free.key)]
        else:
            own[:, j] = problem.difference(run, point, 1, j, free, residuals)
    return Columns(residuals, shared, own, then.states)
