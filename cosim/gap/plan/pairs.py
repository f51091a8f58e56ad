"""Which effects a planned campaign cannot tell apart.

The truth is one effect at its smallest size; another effect is fitted in its place, its size, its
shapes and phases and all of the plain model being free. What that leaves, squared, is the
noncentrality of the test for the true effect beside the other one. Where it is less than the wanted
chance needs, the two are a class at that size; as lengths grow with the size, so many times the
size is needed to tell them apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import Point, own_of, shared_of
from cosim.gap.estimation.problem import Problem

from .law import Law, with_law
from .linear import beyond
from .planned import Rehearsal, own_data
from .visibility import Visible

#: Rounds of a refit of another law in place of the true one.
_ROUNDS = 5


@dataclass(frozen=True)
class Mistaken:
    """An effect that another might be taken for.

    Attributes
    ----------
    truth, other : ids
    form : the other's law that comes nearest
    apart : squared length of what the other leaves, at the truth's smallest size
    angle_deg : between the two responses, what the other's shapes take up left out
    times : of the truth's smallest size at which they are told apart; infinite: never
    """

    truth: str
    other: str
    form: str
    apart: float
    angle_deg: float
    times: float


def mistaken(truth: Visible, laws: Sequence[Visible], wanted: float) -> tuple[Mistaken, Visible]:
    """The law, of those of another effect, that comes nearest to the truth, by derivatives.

    wanted : noncentrality that is needed to tell them apart
    """
    apart = [beyond(truth.response, law.response, law.others) for law in laws]
    nearest = int(np.argmin(apart))
    return _described(truth, laws[nearest].law, apart[nearest], wanted), laws[nearest]


def _described(truth: Visible, law: Law, apart: float, wanted: float) -> Mistaken:
    whole = float(truth.response @ truth.response)
    sine = np.sqrt(np.clip(apart / whole, 0.0, 1.0))
    return Mistaken(
        truth=truth.law.effect,
        other=law.effect,
        form=law.candidate.form,
        apart=apart,
        angle_deg=float(np.degrees(np.arcsin(sine))),
        times=times(apart, whole, wanted),
    )


def times(apart: float, whole: float, wanted: float) -> float:
    """Of a size, at which what it leaves is as much as is wanted; 1 where it is so already."""
    #: a millionth of the response is what derivatives by differences are good to
    return float(max(1.0, np.sqrt(wanted / apart))) if apart > 1e-6 * whole else np.inf


def refitted(rehearsal: Rehearsal, truth: Visible, other: Visible, wanted: float) -> Mistaken:
    """The same with the other law really fitted to the true motion, where it comes nearer."""
    linear = beyond(truth.response, other.response, other.others)
    problem, point = with_law(rehearsal, truth.law, truth.part)
    runs = tuple(own_data(problem, i, point) for i in range(len(rehearsal.runs)))
    data = replace(rehearsal, runs=runs)
    apart = min(linear, _misfit(data, other))
    return _described(truth, other.law, apart, wanted)


def _misfit(data: Rehearsal, other: Visible) -> float:
    """Sum of squares that the plain model with a law, all of it free, leaves of some motion."""
    part = other.part if other.is_seen else min(1.0, other.law.most)
    added = tuple(
        replace(free, start=other.law.value(part)) if free.key == other.law.size.key else free
        for free in other.law.candidate.free_parameters
    )
    keys = {free.key for free in added}
    kept = tuple(free for free in data.free_parameters if free.key not in keys)
    problem = Problem(data.runs, (*kept, *added), {**data.settings, **other.law.candidate.settings})
    at = {free.key: s for free, s in zip(data.problem.shared, data.point.shared, strict=True)}
    shared = [at.get(free.key, free.scaled(free.start)) for free in shared_of((*kept, *added))]
    own = tuple(
        np.array(
            [
                free.scaled(other.law.phase(run).get(free.key, free.start))
                for free in own_of((*kept, *added))
            ]
        )
        for run in range(len(data.runs))
    )
    fitted = fit(problem, Point(np.array(shared), own, data.point.states), _ROUNDS)
    known = problem.prior(fitted.point.shared)[0]
    return fitted.cost + float(known @ known)
