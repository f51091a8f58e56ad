"""Kinetic friction falls as friction heat gathers at the interface, and recovers in time.

The lumped thermal state q (J) gains the friction power P and forgets over the time tau,

    q' = P - q / tau,        mu_k (1 + c k q)^(-1/c),

with the loss k per joule; c = -1 is a linear decline, c -> 0 an exponential one.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import exp

from ...quantity import Table, quantity
from ..candidate import Candidate, FreeParameter, Scales
from ..effect import Case, Effect, State


class ThermalWeakening(Table):
    """Kinetic friction falls as friction heat gathers at the interface, and recovers in time."""

    per_joule: float = quantity(
        0.0, "1/J", "part of mu_k lost per joule of recent friction heat", ge=0, typical=(0.05, 5.0)
    )
    relaxation_time: float = quantity(
        5.0, "s", "time in which recent heat is forgotten", gt=0, typical=(0.3, 30.0)
    )
    curvature: float = quantity(
        -1.0,
        "1",
        "of the decline of mu_k: -1 linear, 0 exponential, 1 hyperbolic",
        ge=-1,
        le=1,
        tried=(-1.0, 1.0),
    )


def kinetic_factor(recent_heat: float, per_joule: float, curvature: float) -> float:
    """What is left of mu_k: (1 + c loss)^(-1/c)."""
    loss = per_joule * recent_heat
    if curvature == 0.0:
        return exp(-loss)
    left = 1.0 + curvature * loss
    return left ** (-1.0 / curvature) if left > 0.0 else 0.0


def recent_heat_rate(friction_power: float, recent_heat: float, relaxation_time: float) -> float:
    """Rate of the lumped thermal state, W."""
    return friction_power - recent_heat / relaxation_time


def candidates(s: Scales) -> Iterator[Candidate]:
    """Linear in the heat of a short or a long memory, and bent."""
    for time in (0.5, 5.0, 50.0):
        # the heat that is remembered, of what a run makes
        heat = s.heat * min(1.0, time / s.duration)
        weak = FreeParameter("thermal_weakening.per_joule", 0.1 / heat, 0.1 / heat, 0.0, 1e3 / heat)
        memory = FreeParameter("thermal_weakening.relaxation_time", time, 0.5, 0.02, 1e4, log=True)
        yield Candidate("thermal_weakening", "relaxing", (weak, memory))
    bend = FreeParameter("thermal_weakening.curvature", 0.0, 0.3, -1.0, 1.0)
    yield Candidate("thermal_weakening", "relaxing, bent", (weak, memory, bend))


EFFECT = Effect(
    id="thermal_weakening",
    table=ThermalWeakening,
    switch=("per_joule",),
    enters="friction",
    source="frictional heating, lumped: Bowden & Hughes, Proc. R. Soc. A 172 (1939)",
    terms=(kinetic_factor,),
    states=(State("recent_heat", recent_heat_rate),),
    candidates=candidates,
    case=Case({"per_joule": 0.4}, window=(0.0, 8.0)),
)
