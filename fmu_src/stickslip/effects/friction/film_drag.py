"""Friction grows with the sliding speed: a film of melt or water is sheared.

A Couette film of the whole contact gives a force c U; a film that grows as it melts gives one that
grows with the root of the local speed v. A film that shears thin or thick gives a power of it
(Ostwald & de Waele), one that comes to a limiting shear stress a force that saturates:

    b sqrt(v) + P (v / v_p)^n + S v / (v + v_s), over N, beside mu_k.
"""

from collections.abc import Iterator
from math import sqrt

from ...quantity import Table, quantity
from ..effect import Candidate, Case, Effect, FormsOf, Scales


class FilmDrag(Table):
    """Friction grows with the sliding speed: a film of melt or water is sheared.

    coefficient : force of the whole contact per sliding speed
    root_coefficient : force of the whole contact at 1 m/s, growing with the root of the local speed
    power : P, force of the whole contact at power_speed, growing with a power of the local speed
    exponent : n, of the power: below 1 it shears thin
    power_speed : v_p, speed at which the force is that
    saturating : S, force of the whole contact that a fast sliding comes to
    saturation_speed : v_s, speed at which it is half of that
    """

    coefficient: float = quantity(0.0, "N.s/m", ge=0, typical=(0.05, 5.0))
    root_coefficient: float = quantity(0.0, "N", ge=0, typical=(0.05, 2.0))
    power: float = quantity(0.0, "N", ge=0, typical=(0.02, 1.0))
    exponent: float = quantity(1.0, "1", ge=0.2, le=4, tried=(0.5, 2.0))
    power_speed: float = quantity(0.1, "m/s", gt=0, tried=(0.05, 0.3))
    saturating: float = quantity(0.0, "N", ge=0, typical=(0.05, 1.0))
    saturation_speed: float = quantity(0.1, "m/s", gt=0, tried=(0.03, 0.3))


def contact_drag(coefficient: float) -> float:
    """N s/m: a film of constant thickness."""
    return coefficient


def film_friction(
    speed: float,
    root_coefficient: float,
    power: float,
    exponent: float,
    power_speed: float,
    saturating: float,
    saturation_speed: float,
    normal_force: float,
) -> float:
    """What films whose shear is no multiple of the speed add to the coefficient."""
    force = root_coefficient * sqrt(speed)
    if power != 0.0:
        force += power * (speed / power_speed) ** exponent
    if saturating != 0.0:
        force += saturating * speed / (speed + saturation_speed)
    return force / normal_force


own = FormsOf("film_drag")


def candidates(s: Scales) -> Iterator[Candidate]:
    """Each film by itself."""
    drag = 0.02 * s.force / s.speed
    yield own.form("linear", own.free("coefficient", drag, drag, 0.0, 1e3 * drag))
    much = 0.02 * s.force / s.speed**0.5
    yield own.form("root", own.free("root_coefficient", much, much, 0.0, 1e3 * much))
    force = 0.02 * s.force
    power = own.free("power", force, force, 0.0, 1e3 * force)
    exponent = own.free("exponent", 1.5, 0.3, 0.3, 3.0)
    yield own.form("power", power, exponent, power_speed=s.speed)
    most = own.free("saturating", 2.0 * force, force, 0.0, 1e3 * force)
    # over a much smaller speed it would be another mu_k, not a law of the sliding speed
    low, high = 0.1 * s.speed, 1e2 * s.speed
    knee = own.free("saturation_speed", 0.5 * s.speed, 0.4, low, high, log=True)
    yield own.form("saturating", most, knee)


EFFECT = Effect(
    id="film_drag",
    table=FilmDrag,
    switch=("coefficient", "root_coefficient", "power", "saturating"),
    enters="friction",
    axis="sliding speed",
    source="Couette film; hydrodynamic friction of ice grows with the root of the speed",
    terms=(film_friction, contact_drag),
    candidates=candidates,
    case=Case({"coefficient": 0.5}, window=(0.0, 8.0)),
)
