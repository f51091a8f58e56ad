"""A law of the catalogue with its size as one number, put into the plain model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from stickslip.effects.candidate import Candidate, FreeParameter

from cosim.gap.candidates.catalogue import candidates, laws_of_speed
from cosim.gap.candidates.scales import scales
from cosim.gap.estimation.fitted import Point, own_of, shared_of
from cosim.gap.estimation.problem import Problem

from .planned import PlannedCampaign, Rehearsal

#: Turn, from one run to the next, of the phase of what is periodic, deg: by the golden angle no two
#: runs have the same.
_TURN = 137.508


@dataclass(frozen=True)
class Law:
    """A law whose size is one number.

    Attributes
    ----------
    candidate : as the catalogue has it
    neutral : value of its first free parameter where it is nothing
    periods : how many periods that the campaign can resolve chance may choose among
    """

    candidate: Candidate
    neutral: float
    periods: int = 1

    @property
    def effect(self) -> str:
        """Id in the catalogue."""
        return self.candidate.effect

    @property
    def size(self) -> FreeParameter:
        """The free parameter that says how much there is of it."""
        return self.candidate.free_parameters[0]

    @property
    def shapes(self) -> tuple[FreeParameter, ...]:
        """Its other numbers that all runs share."""
        return tuple(shared_of(self.candidate.free_parameters[1:]))

    @property
    def most(self) -> float:
        """Parts of its start up to which it may go."""
        way = self.size.start - self.neutral
        end = self.size.high if way > 0.0 else self.size.low
        return (end - self.neutral) / way

    def value(self, part: float) -> float:
        """The size at a part of its start."""
        return self.neutral + part * (self.size.start - self.neutral)

    def settings(self, part: float) -> dict[str, float]:
        """What is set in the model for a part of its start, without phases."""
        shapes = {free.key: free.start for free in self.shapes}
        return {**self.candidate.settings, **shapes, self.size.key: self.value(part)}

    @property
    def phases(self) -> tuple[FreeParameter, ...]:
        """Its numbers that every run has its own of."""
        return tuple(own_of(self.candidate.free_parameters))

    def phase(self, run: int, turn: float = 0.0) -> dict[str, float]:
        """A run's phases, deg, turned by so many steps."""
        return {free.key: free.start + _TURN * run + turn * free.step for free in self.phases}

    def freedoms(self, runs: int) -> int:
        """Numbers that a fit of it has more than the plain model."""
        return 1 + len(self.shapes) + runs * len(self.phases)


def laws_of(plan: PlannedCampaign, rehearsal: Rehearsal) -> tuple[tuple[Law, ...], dict[str, str]]:
    """The laws that the campaign could feel, and effect -> why not, of the others.

    A law without a number of its own is another one at a stated value.
    """
    rig = plan.campaign.rig
    extension = rig.spring_length - rig.spring_natural_length
    offered = candidates(scales(list(rehearsal.campaign.runs), plan.friction["mu_k"], extension))
    known = rehearsal.runs[0].known
    laws: list[Law] = []
    silent: dict[str, str] = {}
    for candidate in offered:
        why = _silent(candidate, plan)
        if why:
            silent[candidate.effect] = why
        elif candidate.free_parameters and not _mirrored(candidate):
            neutral = known[candidate.free_parameters[0].key]
            laws.append(Law(candidate, neutral, _periods(candidate, plan)))
    return tuple(laws), silent


def _mirrored(candidate: Candidate) -> bool:
    """Whether it is another one, seen in a mirror: across a straight rig both sides are alike."""
    return candidate.lateral and candidate.free_parameters[0].start < 0.0


def _periods(candidate: Candidate, plan: PlannedCampaign) -> int:
    """Of a wave: frequencies that the longest run resolves, up to the Nyquist frequency.

    One in every 1 / duration, as in a periodogram; a wavelength is that of the surface's travel.
    """
    if not candidate.periodic:
        return 1
    (period,) = (free for free in candidate.free_parameters if free.key == candidate.periodic)
    longest = max(plan.runs, key=lambda run: run.duration)
    speed = abs(longest.setting.surface_speed)
    highest = period.high if period.key.endswith("frequency") else speed / period.low
    return max(1, round(longest.duration * min(highest, 0.5 * longest.rate)))


def _silent(candidate: Candidate, plan: PlannedCampaign) -> str:
    """Why `gap` would not try a law on this campaign; "" where it would."""
    if candidate.lateral and not plan.planar:
        return "y is not measured, or the rig allows x alone"
    if candidate.effect == "stick_stiffness" and "mu_s" not in plan.campaign.friction:
        return "along x the same as another mu_s, unless friction.mu_s is known"
    if plan.campaign.friction_table is not None and candidate.effect in laws_of_speed():
        return "friction.table is the law of the sliding speed"
    return ""


def kinds(laws: Sequence[Law]) -> int:
    """How many laws chance can choose among: other starts of the same one are no others."""
    return len({(law.effect, law.candidate.form) for law in laws})


def with_law(
    rehearsal: Rehearsal,
    law: Law,
    part: float,
    also: Mapping[str, float] | None = None,
    turn: float = 0.0,
) -> tuple[Problem, Point]:
    """The plain model's fit with a law set in it, and where it sets out.

    also : other values of the law's shapes; turn : of its phases, in their steps
    """
    settings = {**rehearsal.settings, **law.settings(part), **dict(also or {})}
    runs = tuple(
        replace(run, known={**run.known, **law.phase(number, turn)})
        for number, run in enumerate(rehearsal.runs)
    )
    base = rehearsal.free_parameters
    kept = tuple(free for free in base if free.key not in settings)
    chosen = [free.key not in settings for free in shared_of(base)]
    chosen_own = [free.key not in settings for free in own_of(base)]
    point = rehearsal.point
    return Problem(runs, kept, settings), Point(
        point.shared[chosen], tuple(own[chosen_own] for own in point.own), point.states
    )


def residuals(
    rehearsal: Rehearsal,
    law: Law,
    part: float,
    also: Mapping[str, float] | None = None,
    turn: float = 0.0,
    at: Point | None = None,
) -> list[np.ndarray]:
    """Per run (rows,): what a law of some size adds to the plain model's motion, in noise units.

    at : another point of the plain model
    """
    problem, point = with_law(rehearsal, law, part, also, turn)
    return list(problem.all_residuals(at or point))


#: Part of its step by which one of a law's other numbers is moved for its derivative.
_PART = 0.5


def bent(
    rehearsal: Rehearsal, law: Law, part: float, at: Point | None = None
) -> list[list[np.ndarray]]:
    """For each of the law's shapes, per run (rows,): derivative of what it adds, by a step."""
    here = residuals(rehearsal, law, part, at=at)
    found = []
    for free in law.shapes:
        middle = free.scaled(free.start)
        step = _PART if middle + _PART <= free.scaled(free.high) else -_PART
        there = residuals(rehearsal, law, part, {free.key: free.value(middle + step)}, at=at)
        found.append([(b - a) / step for a, b in zip(here, there, strict=True)])
    return found


def turned(
    rehearsal: Rehearsal, law: Law, part: float, at: Point | None = None
) -> list[np.ndarray]:
    """Per run (rows, phases): derivative of what the law adds by the run's own phase."""
    here = residuals(rehearsal, law, part, at=at)
    if not law.phases:
        return [np.empty((rows.size, 0)) for rows in here]
    there = residuals(rehearsal, law, part, turn=_PART, at=at)
    return [((b - a) / _PART)[:, None] for a, b in zip(here, there, strict=True)]
