"""A settled model as it is meant: what is a run's own is held by what is known of it.

Springs are those of the set-up, friction of a run and of its stretches is that of the campaign but
for what it scatters by, and the segments' states follow. So it is fitted in long segments, judged
and shown.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from cosim.gap.estimation.drive import FRICTION_OFFSET
from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import Fitted, Point
from cosim.gap.estimation.initial_states import with_velocities
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segments import FRICTION
from cosim.gap.estimation.trial import Model

from .products import LEAST, Spreads
from .settled import Settled, as_meant

#: Rounds of the runs' own numbers and of the states alone.
_FOLLOW = 6


def tightened(model: Model, spreads: Spreads) -> Model:
    """The model with its runs' own numbers as far apart as these spreads say."""
    felt = spreads._replace(
        friction=max(spreads.friction, LEAST.friction), zero=max(spreads.zero, LEAST.zero)
    )
    return replace(model, free_parameters=as_meant(model.free_parameters, felt))


def scattering(model: Model, spreads: Spreads) -> Model:
    """Tightened, with friction that differs from stretch to stretch of a run by these spreads."""
    return replace(tightened(model, spreads), local=(spreads.stretch, spreads.static))


def followed(problem: Problem, point: Point) -> Fitted:
    """The runs' own numbers and the segments' states where they fit best, the shared ones fixed."""
    point = with_velocities(problem, fit(problem, point, _FOLLOW, fixed=True).point)
    return fit(problem, point, _FOLLOW, fixed=True)


def tight_point(settled: Settled, problem: Problem, which: Sequence[int]) -> Point:
    """Where some runs of a settled model stand, in short segments with friction of the run.

    problem : of those runs, with the tight model
    """
    values = settled.values
    shared = np.array([free.scaled(values.get(free.key, free.start)) for free in problem.shared])
    own, states = [], []
    for i in which:
        said = settled.fitted.own_values(i)
        local = settled.fitted.point.states[i]
        said[FRICTION_OFFSET] = said.get(FRICTION_OFFSET, 0.0) + float(
            np.median(local[:, FRICTION[0]])
        )
        own.append(
            np.array(
                [free.inside(free.scaled(said.get(free.key, free.start))) for free in problem.own]
            )
        )
        at = local.copy()
        at[:, list(FRICTION)] = 0.0
        states.append(at)
    return Point(problem.inside(shared), tuple(own), tuple(states))
