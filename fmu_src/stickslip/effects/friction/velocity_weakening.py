"""Kinetic friction falls with the local sliding speed v, by one law or several at once.

    mu_k (max(0, 1 - a v) / (1 + delta v) / sqrt(1 + c v) / (1 + p (v / v_p)^n)
          * max(0, 1 - l log10(1 + v / v_l)) + b exp(-v / v_s))

The hyperbolic law is that of Leine et al., Nonlinear Dynamics 16 (1998); the peak is Stribeck's;
1 / sqrt(v) at high speed is the boundary friction of ice; so much a decade is what rock, rubber and
metals show (Dieterich, Pure Appl. Geophys. 116, 1978); the power is between all of them.
"""

from collections.abc import Iterator
from math import exp, log10, sqrt

from ...quantity import Table, quantity
from ..effect import Candidate, Case, Effect, FormsOf, Scales


class VelocityWeakening(Table):
    """Kinetic friction falls with the local sliding speed.

    linear : part of mu_k lost per m/s, down to none left
    hyperbolic : delta of mu_k / (1 + delta v)
    inverse_root : c of mu_k / sqrt(1 + c v): 1/sqrt(v) at high speed
    stribeck : peak above mu_k at rest, as part of mu_k
    stribeck_speed : speed over which the peak decays: exp(-v / stribeck_speed)
    power : p of mu_k / (1 + p (v / power_speed)^exponent)
    exponent : of the power: below 1 the fall is steepest at rest
    power_speed : speed at which 1 + p divides mu_k
    logarithmic : part of mu_k lost per decade of the speed, down to none left
    logarithm_speed : speed above which it is lost: log10(1 + v / logarithm_speed)
    """

    linear: float = quantity(0.0, "s/m", ge=0, typical=(0.1, 2.0))
    hyperbolic: float = quantity(0.0, "s/m", ge=0, typical=(0.2, 5.0))
    inverse_root: float = quantity(0.0, "s/m", ge=0, typical=(0.5, 50.0))
    stribeck: float = quantity(0.0, "1", ge=0, le=10, typical=(0.1, 1.0))
    stribeck_speed: float = quantity(0.05, "m/s", gt=0, tried=(0.01, 0.3))
    power: float = quantity(0.0, "1", ge=0, typical=(0.03, 1.0))
    exponent: float = quantity(1.0, "1", ge=0.2, le=4, tried=(0.4, 2))
    power_speed: float = quantity(0.1, "m/s", gt=0, tried=(0.03, 0.3))
    logarithmic: float = quantity(0.0, "1", ge=0, le=1, typical=(0.02, 0.2))
    logarithm_speed: float = quantity(0.01, "m/s", gt=0, tried=(1e-3, 0.1))


def dry_factor(
    speed: float,
    linear: float,
    hyperbolic: float,
    inverse_root: float,
    stribeck: float,
    stribeck_speed: float,
    power: float,
    exponent: float,
    power_speed: float,
    logarithmic: float,
    logarithm_speed: float,
) -> float:
    """mu_k at a local sliding speed over its value at rest."""
    factor = max(0.0, 1.0 - linear * speed) / (1.0 + hyperbolic * speed)
    if inverse_root != 0.0:
        factor /= sqrt(1.0 + inverse_root * speed)
    if power != 0.0:
        factor /= 1.0 + power * (speed / power_speed) ** exponent
    if logarithmic != 0.0:
        factor *= max(0.0, 1.0 - logarithmic * log10(1.0 + speed / logarithm_speed))
    if stribeck != 0.0:
        factor += stribeck * exp(-speed / stribeck_speed)
    return factor


own = FormsOf("velocity_weakening")


def candidates(s: Scales) -> Iterator[Candidate]:
    """Each law by itself."""
    part, step = 0.15 / s.speed, 0.1 / s.speed
    yield own.form("linear", own.free("linear", part, step, 0.0, 10.0 / s.speed))
    for name in ("hyperbolic", "inverse_root"):
        yield own.form(name, own.free(name, part, step, 0.0, 1e3 / s.speed))
    peak = own.free("stribeck", 0.15, 0.1, 0.0, 10.0)
    for share in (0.3, 1.0):
        # over a much smaller speed it would be another mu_s, not a law of the sliding speed
        start, low, high = share * s.speed, 0.1 * s.speed, 1e2 * s.speed
        speed = own.free("stribeck_speed", start, 0.4, low, high, log=True)
        yield own.form("stribeck", peak, speed)
    power = own.free("power", 0.15, 0.1, 0.0, 1e3)
    exponent = own.free("exponent", 0.7, 0.2, 0.4, 2.0)
    yield own.form("power", power, exponent, power_speed=s.speed)
    # set in so slowly that over the campaign's speeds it is a + b log v
    decade = own.free("logarithmic", 0.1, 0.05, 0.0, 1.0)
    yield own.form("logarithmic", decade, logarithm_speed=0.1 * s.speed)


EFFECT = Effect(
    id="velocity_weakening",
    table=VelocityWeakening,
    switch=("hyperbolic", "linear", "inverse_root", "stribeck", "power", "logarithmic"),
    enters="friction",
    axis="sliding speed",
    source="Leine et al., Nonlinear Dynamics 16 (1998); Stribeck (1902); boundary friction of ice",
    terms=(dry_factor,),
    candidates=candidates,
    case=Case({"hyperbolic": 2.0}),
)
