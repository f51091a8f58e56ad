"""Kinetic friction falls as friction heat gathers at the interface, and recovers in time.

The lumped thermal state q (J) gains the friction power P and forgets over the time tau,

    q' = P - q / tau,        mu_k (1 + c k q)^(-1/c),

with the loss k per joule; c = -1 is a linear decline, c -> 0 an exponential one. mu_s stays, or
takes its share (static_relative, static_absolute).

A body into which heat diffuses forgets like a half-space: a constant power warms its face with the
root of the time (Carslaw & Jaeger, Conduction of Heat in Solids, 1959, section 2.9). Two more such
states, of the times tau / 22 and 29 tau, give that to 3 % for heating times of tau / 20 to 20 tau:
q + d (6.5 q_fast + 0.29 q_slow) in place of q, with d = 1.
"""

from collections.abc import Iterator
from math import exp

from ...quantity import Table, quantity
from ..effect import Candidate, Case, Effect, FormsOf, FreeParameter, Scales, State
from ..static_share import STATIC_FORMS, static_factor, static_share

#: Memories beside tau, shorter and longer by so much, and their weights: those with which the rise
#: under a constant power is nearest to the root of the time, in the largest relative distance.
FASTER = 22.0
FAST_WEIGHT = 6.5
SLOWER = 29.0
SLOW_WEIGHT = 0.29


class ThermalWeakening(Table):
    """Kinetic friction falls as friction heat gathers at the interface, and recovers in time.

    per_joule : part of mu_k lost per joule of recent friction heat
    relaxation_time : time in which recent heat is forgotten
    curvature : of the decline of mu_k: -1 linear, 0 exponential, 1 hyperbolic
    diffusion : 1: heat is forgotten as a half-space does, about relaxation_time; 0: exponentially
    static_relative : what mu_s takes of mu_k's relative change: 1 all, in proportion; 0 none, it
        stays
    static_absolute : what mu_s takes of mu_k's change: 1 all, it moves by as much; 0 none
    """

    per_joule: float = quantity(0.0, "1/J", ge=0, typical=(0.05, 5.0))
    relaxation_time: float = quantity(5.0, "s", gt=0, typical=(0.3, 30.0))
    curvature: float = quantity(-1.0, "1", ge=-1, le=1, tried=(-1.0, 1.0))
    diffusion: float = quantity(0.0, "1", ge=0, le=1, tried=(0.0, 1.0))
    static_relative: float = static_share()
    static_absolute: float = static_share()


def remembered(recent_heat: float, fast_heat: float, slow_heat: float, diffusion: float) -> float:
    """Heat that is remembered, J."""
    return recent_heat + diffusion * (FAST_WEIGHT * fast_heat + SLOW_WEIGHT * slow_heat)


def decline(loss: float, curvature: float) -> float:
    """What is left of mu_k: (1 + c loss)^(-1/c)."""
    if curvature == 0.0:
        return exp(-loss)
    left = 1.0 + curvature * loss
    return left ** (-1.0 / curvature) if left > 0.0 else 0.0


def kinetic_factor(
    recent_heat: float,
    fast_heat: float,
    slow_heat: float,
    per_joule: float,
    curvature: float,
    diffusion: float,
) -> float:
    """What is left of mu_k."""
    heat = remembered(recent_heat, fast_heat, slow_heat, diffusion)
    return decline(per_joule * heat, curvature)


def recent_heat_rate(friction_power: float, recent_heat: float, relaxation_time: float) -> float:
    """Rate of the lumped thermal state, W."""
    return friction_power - recent_heat / relaxation_time


def fast_heat_rate(
    friction_power: float, fast_heat: float, relaxation_time: float, diffusion: float
) -> float:
    """Rate of what is forgotten sooner, W; nothing is gathered where it does not count."""
    if diffusion == 0.0:
        return 0.0
    return friction_power - FASTER * fast_heat / relaxation_time


def slow_heat_rate(
    friction_power: float, slow_heat: float, relaxation_time: float, diffusion: float
) -> float:
    """Rate of what is forgotten later, W; nothing is gathered where it does not count."""
    if diffusion == 0.0:
        return 0.0
    return friction_power - slow_heat / (SLOWER * relaxation_time)


own = FormsOf("thermal_weakening")


def candidates(s: Scales) -> Iterator[Candidate]:
    """Linear in the heat of a short or a long memory, and bent; mu_s with it; a half-space."""
    for time in (0.5, 5.0, 50.0):
        yield own.form("relaxing", *_memory(s, time))
    yield own.form("relaxing, bent", *_memory(s, 50.0), own.free("curvature", 0.0, 0.3, -1.0, 1.0))
    for form, static in STATIC_FORMS.items():
        yield own.form(f"relaxing, {form}", *_memory(s, 5.0), **{static: 1.0})
    # the slowest of the three memories reaches over a run, the fastest over a part of a cycle
    time = 0.05 * s.duration
    yield own.form("half-space", _weak(0.3 * s.heat), diffusion=1.0, relaxation_time=time)


def _weak(heat: float) -> FreeParameter:
    """A tenth is lost by so much heat, J."""
    return own.free("per_joule", 0.1 / heat, 0.1 / heat, 0.0, 1e3 / heat)


def _memory(s: Scales, time: float) -> tuple[FreeParameter, ...]:
    """A loss by the heat of the last ``time`` seconds, of what a run makes."""
    return (
        _weak(s.heat * min(1.0, time / s.duration)),
        own.free("relaxation_time", time, 0.5, 0.02, 1e4, log=True),
    )


EFFECT = Effect(
    id="thermal_weakening",
    table=ThermalWeakening,
    switch=("per_joule",),
    enters="friction",
    axis="heat memory",
    source="frictional heating, lumped: Bowden & Hughes, Proc. R. Soc. A 172 (1939)",
    terms=(kinetic_factor, static_factor),
    states=(
        State("recent_heat", recent_heat_rate),
        State("fast_heat", fast_heat_rate),
        State("slow_heat", slow_heat_rate),
    ),
    candidates=candidates,
    case=Case({"per_joule": 0.4}, window=(0.0, 8.0)),
)
