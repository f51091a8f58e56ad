"""From an aligned fit to the linear mixed model about it: products of columns, run by run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from stickslip.effects import EFFECTS
from stickslip.effects.candidate import OFFSETS, Candidate, FreeParameter

from cosim.gap.estimation.drive import FRICTION_OFFSET, SPEED_OFFSET, SPRINGS_OFFSET
from cosim.gap.estimation.fitted import Fitted
from cosim.gap.estimation.problem import STATE_STEP, Problem
from cosim.gap.estimation.segments import FRICTION, STATES
from cosim.processes import Map

from .mixed import Deviations, MixedModel, RunProducts

#: Springs of one set-up are the same from run to run, but for so much (their temperature).
SAME_SPRINGS = 5e-4
#: Standard deviations, in steps, of numbers of which nothing is known: of a shape, fitted as its
#: logarithm, and of any other.
SHAPE, STRENGTH = 4.0, 20.0
#: A wave's phase may be anything, degrees: as wide as a normal one of the same density at its
#: middle.
_CIRCLE = 360.0 / np.sqrt(2.0 * np.pi)
#: Effects that are the friction of a run, which has one load.
_OF_THE_LOAD = {effect.id for effect in EFFECTS if effect.axis == "load"}
#: Longest step of a shape: what answers to it changes with it.
LONGEST = 2.5


class Spreads(NamedTuple):
    """How much runs and stretches differ: standard deviations.

    friction : from run to run, a part of it; stretch : from stretch to stretch of a run; static :
    of static friction beside that; zero : of the tracker's zero in a run, in parts of what is
    stated; speed : of the surface's speed in a run, a part of the set-point
    """

    friction: float = 0.02
    stretch: float = 0.004
    static: float = 0.01
    zero: float = 0.3
    speed: float = 0.005


#: What is usual of them, and the least and the most that are looked for.
USUAL = Spreads(0.04, 0.01, 0.02, 1.0, 0.01)
LEAST, MOST = Spreads(3e-4, 2e-4, 3e-4, 0.02, 2e-4), Spreads(0.5, 0.5, 0.5, 1.0, 0.01)


def mixed_model(
    problem: Problem,
    fitted: Fitted,
    laws: Sequence[Candidate],
    held_out: Sequence[bool],
    mapped: Map,
) -> MixedModel:
    """About an aligned fit with derivatives; a law's column is its response as it sets out."""
    tasks = [
        (problem.of_run(run), fitted.of_run(run), tuple(laws), out)
        for run, out in enumerate(held_out)
    ]
    names = [f"{law.effect} {law.form}" for law in laws]
    centre = np.array([f.scaled(f.start) for f in problem.shared])
    return MixedModel(list(mapped(run_products, tasks)), fitted.point.shared - centre, names)


def run_products(
    problem: Problem, fitted: Fitted, laws: Sequence[Candidate], held_out: bool
) -> RunProducts:
    """Of one run, which is the problem's only one."""
    (columns,), (segmented,) = fitted.derivatives, problem.segmented_runs
    owner = segmented.segment_of_rows()
    rows = owner.size
    at = fitted.point.shared, fitted.point.own[0], fitted.point.states[0]
    residuals = fitted.residuals[0][:rows]
    responses = [law_response(problem, law, at)[:rows] - residuals for law in laws]
    for number, law in enumerate(laws):
        if law.effect in _OF_THE_LOAD:
            friction = [free.key for free in problem.own].index(FRICTION_OFFSET)
            responses[number] = _along(columns.own[:rows, friction], responses[number])
    own, states = columns.own[:rows], at[2] / STATE_STEP
    stacked = np.column_stack([own, columns.shared[:rows], *responses, residuals])
    grams = []
    for number, (where, by_state) in enumerate(columns.states):
        inside = where[where < rows]
        first = np.zeros((inside.size, STATES))
        axes = list(problem.free_axes(segmented.segments[number]))
        first[:, axes] = by_state[where < rows]
        every = np.column_stack([first, stacked[inside]])
        grams.append(every.T @ every)
    centred = states.copy()
    centred[:, [i for i in range(STATES) if i not in FRICTION]] = 0.0
    return RunProducts(np.array(grams), centred, at[1], held_out)


def _along(column: np.ndarray, response: np.ndarray) -> np.ndarray:
    """The part of a response that goes with a column.

    What the load does to friction is the same all along a run: two differences of the same thing,
    each with errors of its own, would not cancel.
    """
    return column * float(response @ column) / max(float(column @ column), 1e-300)


def law_response(problem: Problem, law: Candidate, at) -> np.ndarray:
    """Residuals of a problem of one run, with the law in the model as it sets out."""
    values = {free.key: free.start for free in law.free_parameters}
    settings = {**problem.settings, **law.settings, **values}
    with_law = Problem(problem.segmented_runs, problem.free_parameters, settings, problem.local)
    return with_law.residuals(0, *at)


def deviations(
    problem: Problem, fitted: Fitted, tight: Sequence[FreeParameter], spreads: Spreads
) -> Deviations:
    """Of the model as it is meant: what ``tight`` says, and these spreads."""
    said = {free.key: free for free in tight}
    scattered = {
        FRICTION_OFFSET: spreads.friction,
        SPEED_OFFSET: spreads.speed,
        SPRINGS_OFFSET: SAME_SPRINGS,
    }
    own = []
    for free in problem.own:
        width = scattered.get(free.key)
        if width is None:
            width = said[free.key].prior or _CIRCLE
            width *= spreads.zero if free.key in OFFSETS else 1.0
        own.append(width / free.step)
    states = np.full(STATES, np.inf)
    local = np.array([spreads.stretch, spreads.static])
    states[list(FRICTION)] = local / STATE_STEP[list(FRICTION)]
    shared = [_width(said[free.key]) for free in problem.shared]
    now = fitted.point.shared
    far = np.array([LONGEST if free.log else np.inf for free in problem.shared])
    low = np.array([free.scaled(free.low) for free in problem.shared]) - now
    high = np.array([free.scaled(free.high) for free in problem.shared]) - now
    return Deviations(
        states,
        np.array(own),
        np.array(shared),
        np.clip(low, -far, 0.0),
        np.clip(high, 0.0, far),
    )


def _width(free: FreeParameter) -> float:
    """What is known beforehand of a shared number, in steps: a shape is near where it starts."""
    if free.prior:
        return free.prior / free.step
    return SHAPE if free.log else STRENGTH
