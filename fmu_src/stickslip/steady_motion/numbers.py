"""The numbers of a rig that decide what its block does, and how each is changed alone."""

from collections.abc import Callable
from dataclasses import dataclass

from ..parameters import Parameters

SPEED, RAMP, DAMPING = "surface.speed", "surface.run_up_time", "structural_damping.coefficient"
PRETENSION, RATIO = "pretension", "mu_s/mu_k"


@dataclass(frozen=True)
class Number:
    """A number that can be changed.

    Attributes
    ----------
    key, unit : `table.key` of a scenario, or what it is made of
    value : as the rig has it
    least : below which it cannot be
    first : what is tried first where it is 0
    change : the rig with another value
    """

    key: str
    unit: str
    value: float
    least: float
    first: float
    change: Callable[[Parameters, float], Parameters]


def numbers_of(parameters: Parameters) -> list[Number]:
    """Speed, its ramp, damping, pretension where the block is not guided, and mu_s/mu_k."""
    rig, surface, friction = parameters.rig, parameters.surface, parameters.friction
    damping = parameters.structural_damping.coefficient
    found = [
        Number(SPEED, "m/s", abs(surface.speed), 0.0, 0.01, at_speed),
        Number(RAMP, "s", surface.run_up_time, 0.0, 1.0, _setting("surface", "run_up_time")),
        Number(
            DAMPING,
            "N s/m",
            damping,
            0.0,
            1e-3 * parameters.critical_damping,
            _setting("structural_damping", "coefficient"),
        ),
    ]
    if rig.degrees_of_freedom != ("x",):
        stretched = round(rig.spring_length - rig.spring_natural_length, 12)
        first = 0.01 * rig.spring_length
        found.append(Number(PRETENSION, "m", stretched, 0.0, first, with_pretension))
    if friction.mu_k > 0.0 and not friction.has_table:
        ratio = friction.mu_s / friction.mu_k
        found.append(Number(RATIO, "1", ratio, 1.0, 0.1, with_ratio))
    return found


def at_speed(parameters: Parameters, speed: float) -> Parameters:
    """The same rig on a surface of another speed; a block that starts with the surface's keeps it.

    The direction is that of the rig.
    """
    surface = parameters.surface
    speed = -abs(speed) if surface.speed < 0.0 else abs(speed)
    changed = parameters.with_values("surface", speed=speed)
    rides = parameters.initial.vx == surface.speed
    return changed.with_values("initial", vx=speed) if rides else changed


def with_ratio(parameters: Parameters, ratio: float) -> Parameters:
    """The same rig with another mu_s/mu_k at its mu_k."""
    return parameters.with_values("friction", mu_s=ratio * parameters.friction.mu_k)


def with_pretension(parameters: Parameters, pretension: float) -> Parameters:
    """The same rig, its springs stretched by ``pretension`` (m) as installed."""
    natural = parameters.rig.spring_length - pretension
    return parameters.with_values("rig", spring_natural_length=natural)


def _setting(table: str, key: str) -> Callable[[Parameters, float], Parameters]:
    return lambda parameters, value: parameters.with_values(table, **{key: value})
