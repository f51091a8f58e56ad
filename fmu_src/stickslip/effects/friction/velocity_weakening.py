"""Kinetic friction falls with the local sliding speed v, by one law or several at once.

    mu_k (max(0, 1 - a v) / (1 + delta v) / sqrt(1 + c v) + b exp(-v / v_s))

The hyperbolic law is that of Leine et al., Nonlinear Dynamics 16 (1998); the peak is Stribeck's;
1 / sqrt(v) at high speed is the boundary friction of ice.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import exp, sqrt

from ...quantity import Table, quantity
from ..candidate import Candidate, FreeParameter, Scales
from ..effect import Case, Effect


class VelocityWeakening(Table):
    """Kinetic friction falls with the local sliding speed."""

    linear: float = quantity(
        0.0, "s/m", "part of mu_k lost per m/s, down to none left", ge=0, typical=(0.1, 2.0)
    )
    hyperbolic: float = quantity(
        0.0, "s/m", "delta of mu_k / (1 + delta v)", ge=0, typical=(0.2, 5.0)
    )
    inverse_root: float = quantity(
        0.0, "s/m", "c of mu_k / sqrt(1 + c v): 1/sqrt(v) at high speed", ge=0, typical=(0.5, 50.0)
    )
    stribeck: float = quantity(
        0.0, "1", "peak above mu_k at rest, as part of mu_k", ge=0, le=10, typical=(0.1, 1.0)
    )
    stribeck_speed: float = quantity(
        0.05,
        "m/s",
        "speed over which the peak decays: exp(-v / stribeck_speed)",
        gt=0,
        tried=(0.01, 0.3),
    )


def dry_factor(
    speed: float,
    linear: float,
    hyperbolic: float,
    inverse_root: float,
    stribeck: float,
    stribeck_speed: float,
) -> float:
    """mu_k at a local sliding speed over its value at rest."""
    factor = max(0.0, 1.0 - linear * speed) / (1.0 + hyperbolic * speed)
    if inverse_root != 0.0:
        factor /= sqrt(1.0 + inverse_root * speed)
    if stribeck != 0.0:
        factor += stribeck * exp(-speed / stribeck_speed)
    return factor


def candidates(s: Scales) -> Iterator[Candidate]:
    """Each law by itself."""
    part = 0.15
    for name in ("linear", "hyperbolic", "inverse_root"):
        free = FreeParameter(
            f"velocity_weakening.{name}",
            part / s.speed,
            0.1 / s.speed,
            0.0,
            {"linear": 10.0 / s.speed}.get(name, 1e3 / s.speed),
        )
        yield Candidate("velocity_weakening", name, (free,))
    peak = FreeParameter("velocity_weakening.stribeck", 0.15, 0.1, 0.0, 10.0)
    for share in (0.3, 1.0):
        # over a much smaller speed it would be another mu_s, not a law of the sliding speed
        speed = FreeParameter(
            "velocity_weakening.stribeck_speed",
            share * s.speed,
            0.4,
            0.1 * s.speed,
            1e2 * s.speed,
            log=True,
            plain_below=True,
        )
        yield Candidate("velocity_weakening", "stribeck", (peak, speed))


EFFECT = Effect(
    id="velocity_weakening",
    table=VelocityWeakening,
    switch=("hyperbolic", "linear", "inverse_root", "stribeck"),
    enters="friction",
    source="Leine et al., Nonlinear Dynamics 16 (1998); Stribeck (1902); boundary friction of ice",
    terms=(dry_factor,),
    candidates=candidates,
    case=Case({"hyperbolic": 2.0}),
)
