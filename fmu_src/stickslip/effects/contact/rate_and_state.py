"""Friction follows the speed and the age of the contact: rate and state, with the ageing law.

Dieterich (1979): mu_k + a ln(v / v*) + b ln(v* theta / D), theta' = 1 - v theta / D. With the creep
speed v_c, sqrt(v^2 + v_c^2) stands for v: the law has a value at rest, which is also what a contact
at rest holds, and is smooth on the way there. (Cut off at v_c instead, it has an edge on which a
slowly loaded slip stays, and no step across an edge passes the error test.)
"""

from math import log, sqrt

from ...quantity import Table, quantity
from ..effect import Case, Effect, State


class RateAndState(Table):
    """Friction follows the speed and the age of the contact (Dieterich's ageing law): slow belts.

    mu_k + a ln(v / v*) + b ln(v* theta / D), theta' = 1 - v theta / D. The age also says what a
    contact at rest holds; mu_s is then not used.

    direct : a, direct effect of the speed
    evolution : b, effect of the age
    distance : D, distance over which contacts are renewed
    reference_speed : v*, at which mu_k holds in steady sliding
    creep_speed : v_c, the law's sqrt(v^2 + v_c^2) for v: at rest it is as at this speed
    initial_age : age of the contact at the start
    """

    direct: float = quantity(0.0, "1", ge=0, typical=(0.005, 0.1))
    evolution: float = quantity(0.0, "1", ge=0, typical=(0.005, 0.15))
    distance: float = quantity(1e-5, "m", gt=0, typical=(1e-6, 1e-3))
    reference_speed: float = quantity(1e-4, "m/s", gt=0, typical=(1e-5, 1e-2))
    creep_speed: float = quantity(1e-6, "m/s", ge=1e-9, typical=(1e-7, 1e-5))
    initial_age: float = quantity(1.0, "s", gt=0, typical=(0.1, 100.0))


def state_law(
    speed: float,
    age: float,
    direct: float,
    evolution: float,
    distance: float,
    reference_speed: float,
    creep_speed: float,
) -> float:
    """What speed and age of the contact add to mu_k."""
    v = sqrt(speed * speed + creep_speed * creep_speed) / reference_speed
    aged = max(age, 1e-12) * reference_speed / distance
    return direct * log(v) + evolution * log(aged)


def age_rate(speed: float, age: float, distance: float) -> float:
    """Rate of the contact's age: 1 at rest, 1 - v theta / D in sliding."""
    return 1.0 - speed * age / distance


def age_scale(speed: float, distance: float) -> float:
    """Age of a contact that slides at the motion's own speed, s."""
    return distance / speed


EFFECT = Effect(
    id="rate_and_state",
    table=RateAndState,
    switch=("evolution", "direct"),
    enters="contact",
    axis="sliding speed",
    source="Dieterich (1979); saline ice: Lishman et al. (2011)",
    terms=(state_law,),
    states=(State("age", age_rate, start="initial_age", scale=age_scale, unit="s"),),
    case=Case(
        {"direct": 0.01, "evolution": 0.03, "distance": 1e-5},
        {"surface": {"speed": 1e-3}, "initial": {"vx": 1e-3}, "springs": {"stiffness": 300.0}},
    ),
)
