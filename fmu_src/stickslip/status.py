"""Why `advance` gave up, in sentences with the remedy; and whether it would, before it starts."""

from __future__ import annotations

from math import pi, sqrt
from typing import TYPE_CHECKING, NamedTuple

from .kernel.bristles.step import STABLE
from .kernel.layout import (
    NOT_FINITE,
    P_BRISTLE_STIFFNESS,
    P_LONGEST_STEP,
    P_MASS,
    P_RATE,
    SPRING_COLLAPSED,
    STEP_VANISHED,
    STEPS_PER_SECOND,
    TOO_STIFF,
)

if TYPE_CHECKING:
    from .parameters import Parameters

WHY_NOT = {
    STEP_VANISHED: "the integrator's step fell below the resolution of time; check mass, "
    "stiffness and initial state, or raise solver.tolerance",
    NOT_FINITE: "the motion grew beyond all numbers",
    SPRING_COLLAPSED: "the block was carried into the anchor of a spring; use stiffer or longer "
    "springs, or less friction",
    TOO_STIFF: "something answers faster than the motion can be followed in steps that anybody "
    "would wait for; if the contact creeps, raise mu_s above mu_k, take lateral_friction.ratio 0 "
    "or 1, or a larger rate_and_state.creep_speed; else check mass, stiffness, damping, lengths "
    "of the rig and of patterns on the surface, or make shorter communication steps",
}

#: Internal steps for a second of motion that the kernel still takes.
MOST_STEPS_PER_SECOND = STEPS_PER_SECOND

#: An internal step on a usual core, s: of a contact in the plane, its share of the events included.
SECONDS_PER_STEP = 1e-5


class LongestStep(NamedTuple):
    """The longest internal step, s, and in words what makes it so short."""

    size: float
    reason: str

    @property
    def per_second(self) -> float:
        """Internal steps for a second of motion, at the least."""
        return 1.0 / self.size


def longest_step(parameters: Parameters) -> LongestStep:
    """A twelfth of the fastest period, or what bristles bear; in mid-run steps are often shorter.

    >>> from stickslip import Parameters, Rig
    >>> round(longest_step(Parameters(rig=Rig(mass=0.67))).size, 4)
    0.0456
    """
    p = parameters.pack()
    vibration = 0.5 / p[P_RATE]
    rig, springs = parameters.rig, parameters.springs
    found = LongestStep(
        vibration,
        f"springs.stiffness = {springs.stiffness:g} N/m and rig.mass = {rig.mass:g} kg: a free "
        f"vibration takes {2.0 * pi / p[P_RATE]:.3g} s",
    )
    if p[P_LONGEST_STEP] < vibration:
        found = LongestStep(
            p[P_LONGEST_STEP],
            f"surface.speed = {parameters.surface.speed:g} m/s over a surface with a pattern, or a "
            "ripple of that speed: the shortest of their periods is "
            f"{4.0 * pi * p[P_LONGEST_STEP]:.3g} s",
        )
    if p[P_BRISTLE_STIFFNESS] > 0.0:
        bristles = STABLE / sqrt(p[P_BRISTLE_STIFFNESS] / p[P_MASS])
        if bristles < found.size:
            found = LongestStep(
                bristles,
                f"friction.presliding_distance = {parameters.friction.presliding_distance:g} m: "
                f"its bristles vibrate with a period of {2.0 * pi * bristles / STABLE:.3g} s",
            )
    return found
