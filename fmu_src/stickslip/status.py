"""Whether a motion could be followed, before it starts: how long its steps may be."""

from __future__ import annotations

from math import inf, pi, sqrt
from typing import TYPE_CHECKING, NamedTuple

from .kernel import layout
from .kernel.bristles.step import STABLE

if TYPE_CHECKING:
    from .parameters import Parameters

#: Internal steps for a second of motion that the kernel still takes.
MOST_STEPS_PER_SECOND = layout.STEPS_PER_SECOND

#: Of the time over which a law of friction changes, what a step can be: a twelfth of a pattern's
#: period, and the bound of stability of an age that fades.
OF_PATTERN, OF_AGE = 1.0 / (4.0 * pi), 3.0
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
    vibration = 0.5 / p[layout.P_RATE]
    rig, springs = parameters.rig, parameters.springs
    found = LongestStep(
        vibration,
        f"springs.stiffness = {springs.stiffness:g} N/m and rig.mass = {rig.mass:g} kg: a free "
        f"vibration takes {2.0 * pi / p[layout.P_RATE]:.3g} s",
    )
    if p[layout.P_LONGEST_STEP] < vibration:
        found = LongestStep(
            p[layout.P_LONGEST_STEP],
            f"surface.speed = {parameters.surface.speed:g} m/s over a surface with a pattern, or a "
            "ripple of that speed: the shortest of their periods is "
            f"{4.0 * pi * p[layout.P_LONGEST_STEP]:.3g} s",
        )
    if p[layout.P_BRISTLE_STIFFNESS] > 0.0:
        bristles = STABLE / sqrt(p[layout.P_BRISTLE_STIFFNESS] / p[layout.P_MASS])
        if bristles < found.size:
            found = LongestStep(
                bristles,
                f"friction.presliding_distance = {parameters.friction.presliding_distance:g} m: "
                f"its bristles vibrate with a period of {2.0 * pi * bristles / STABLE:.3g} s",
            )
    return found


#: Of mu_k N, which a contact bears without sliding: laws of age and rate take some of it.
PART_OF_FRICTION = 0.5


def likely_step(parameters: Parameters) -> LongestStep:
    """As `longest_step`, or what laws of friction ask for while the block slides.

    The steps are counted as if it slid all along: a contact that is about to break away takes as
    many. A block that is carried takes far fewer: `time_to_slide` says how long it is.
    """
    found = longest_step(parameters)
    pattern, law = parameters.surface_pattern, parameters.rate_and_state
    speed = abs(parameters.surface.speed)
    if speed == 0.0:
        return found
    if pattern.amplitude != 0.0:
        period = pattern.wavelength / speed
        reason = (
            f"surface_pattern.wavelength = {pattern.wavelength:g} m passes at surface.speed = "
            f"{speed:g} m/s every {period:.3g} s"
        )
        found = min(found, LongestStep(OF_PATTERN * period, reason))
    if law.direct != 0.0 or law.evolution != 0.0:
        slip = max(speed, parameters.pack()[layout.P_SPEED_SCALE])
        renewed = law.distance / slip
        reason = (
            f"rate_and_state.distance = {law.distance:g} m: a contact that slips at {slip:.2g} m/s "
            f"is renewed in {renewed:.3g} s"
        )
        found = min(found, LongestStep(OF_AGE * renewed, reason))
    return found


def time_to_slide(parameters: Parameters) -> float:
    """Before this time, s, a block that is carried cannot have broken away; 0: it slides already.

    A block that moves with the surface stretches its springs by what the surface travels; until
    they pull with half of mu_k N, the friction of no effect here lets go. inf where they never do.
    """
    surface, initial, rig = parameters.surface, parameters.initial, parameters.rig
    speed, ramp = abs(surface.speed), surface.run_up_time
    if initial.vx != (0.0 if ramp > 0.0 else surface.speed):
        return 0.0
    stiffness = 4.0 * parameters.springs.stiffness
    if stiffness == 0.0 or speed == 0.0:
        return inf
    bears = PART_OF_FRICTION * parameters.friction.mu_k * layout.GRAVITY * rig.mass / stiffness
    travel = max(bears - abs(initial.x), 0.0)
    if 2.0 * travel < speed * ramp:
        return sqrt(2.0 * travel * ramp / speed)
    return travel / speed + 0.5 * ramp
