"""Friction coefficients: mu_s and mu_k with what the effects make of them.

A coefficient meets the effects in this order: place on the surface, temperature, what has been
(heat, distance slid), the local sliding speed of the dry contact, melting, a film, water that
bears part of the load; last, what speed and state of the whole contact add.

From static to kinetic it falls over a sliding speed v_s (Stribeck; Armstrong-Helouvry, Dupont &
Canudas de Wit, Automatica 30, 1994),

    mu(v) = mu_k(v) + (mu_s - mu_k(0)) exp(-(v / v_s)^p),

with mu_s and mu_k as all that they meet has made them and v the local sliding speed: a slip begins
with the very friction that held the block. With v_s = 0 it jumps. mu_s grows with the age theta of
the contact: the time at rest, and in slip what sliding has left of it, theta_0 exp(-s / D) after
the way s since the break-away (Dieterich's theta' = 1 - v theta / D without its 1).
"""

from math import exp

from ..layout import *
from ..rig.drive import varies
from ..terms import *
from .table import table_coefficient


def surface_factor(p: Floats, u: Floats, w: Floats) -> float:
    """Friction of the place on the surface under the block, relative to the surface's mean.

    The place is x less the travel of the surface.
    """
    return max(0.0, with_place_variation(p, u, w, 1.0))


def is_felt(p: Floats, u: Floats, i: int) -> bool:
    """Does input i of ``u`` matter to the motion?"""
    if i == U_SINCE:
        return varies(u)
    if i == U_TEMPERATURE:
        return feels_temperature(p) or p[P_TABLE_ROWS] > 1.0
    if i == U_FILM:
        return feels_film(p)
    return True


def dry_share(p: Floats, u: Floats, w: Floats) -> float:
    """Part of the load that the solid contact bears."""
    return 1.0 - with_flooded_share(p, u, w, 0.0)


def kinetic_coefficient(p: Floats, u: Floats, w: Floats) -> float:
    """mu_k before any dependence on the sliding speed, at the instant in ``w[W_STATE:]``.

    Where a table gives mu_k, what it is to be multiplied by.
    """
    mu = p[P_MU_SCALE] * surface_factor(p, u, w)
    mu = with_kinetic_temperature_factor(p, u, w, mu)
    mu = with_kinetic_factor(p, u, w, mu)
    return max(0.0, mu)


def local_coefficient(p: Floats, u: Floats, w: Floats, mu: float, speed: float) -> float:
    """mu_k at a local sliding speed (m/s), where ``mu`` is that of `kinetic_coefficient`.

    The path dry -> boundary -> hydrodynamic friction as the speed grows; where a part of the load
    is not on the solid contact, all that holds for the rest.
    """
    if p[P_TABLE_POINTS] > 0.0:
        mu *= table_coefficient(p, speed, u[U_TEMPERATURE])
    mu = with_dry_factor(p, u, w, mu, speed)
    mu = with_melting(p, u, w, mu, speed)
    mu = with_film_friction(p, u, w, mu, speed)
    flooded = with_flooded_share(p, u, w, 0.0)
    if flooded != 0.0:
        mu = with_mixed(p, u, w, mu, speed, flooded)
    return mu


def state_coefficient(p: Floats, u: Floats, w: Floats, speed: float) -> float:
    """What speed (mean, m/s) and state of the whole contact add to mu_k; 0 where no law is on."""
    if not has_state_law(p):
        return 0.0
    return dry_share(p, u, w) * with_state_law(p, u, w, 0.0, speed)


def age_left(p: Floats, w: Floats) -> float:
    """Age of a contact that slides, s; none is left where friction jumps from mu_s to mu_k."""
    if p[P_TRANSITION_SPEED] == 0.0:
        return 0.0
    slid = w[W_STATE + DISTANCE] - w[W_STATE + DISTANCE_AWAY]
    return w[W_STATE + AGE_AWAY] * exp(-slid / p[P_AGE_DISTANCE])


def aged_coefficient(p: Floats, u: Floats, w: Floats, mu: float) -> float:
    """mu_s with the age of the contact."""
    if w[W_STATE + MODE] == STICK:
        hold = max(0.0, w[W_STATE + TIME] - w[W_STATE + HOLD_SINCE])
        return with_static_growth(p, u, w, mu, hold)
    if p[P_TRANSITION_SPEED] > 0.0:
        return with_static_growth(p, u, w, mu, age_left(p, w))
    return mu


def static_coefficient(p: Floats, u: Floats, w: Floats) -> float:
    """mu_s at the instant in ``w[W_STATE:]``, of which water bears nothing."""
    mu = p[P_MU_S] * surface_factor(p, u, w)
    mu = with_static_temperature_factor(p, u, w, mu)
    mu = with_static_factor(p, u, w, mu)
    return dry_share(p, u, w) * aged_coefficient(p, u, w, mu)


def set_excess(p: Floats, u: Floats, w: Floats, mu: float) -> None:
    """mu_s over mu_k at rest into ``w[W_EXCESS]``, where friction falls from one to the other.

    ``mu`` is that of `kinetic_coefficient`. A law of speed and state has no mu_s to fall from.
    """
    w[W_EXCESS] = 0.0
    if p[P_TRANSITION_SPEED] > 0.0 and not has_state_law(p):
        at_rest = local_coefficient(p, u, w, mu, 0.0)
        w[W_EXCESS] = max(0.0, static_coefficient(p, u, w) - at_rest)


def transition(p: Floats, w: Floats, speed: float) -> float:
    """What of the excess of `set_excess` is left at a local sliding speed, m/s."""
    if w[W_EXCESS] == 0.0 or speed > p[P_TRANSITION_END]:
        return 0.0
    x = speed / p[P_TRANSITION_SPEED]
    if p[P_TRANSITION_EXPONENT] != 1.0:
        x = x ** p[P_TRANSITION_EXPONENT]
    return w[W_EXCESS] * exp(-x)


def sliding_coefficient(p: Floats, u: Floats, w: Floats, mu: float, speed: float) -> float:
    """Friction at a local sliding speed, m/s: `local_coefficient`, and on top the `transition`."""
    return local_coefficient(p, u, w, mu, speed) + transition(p, w, speed)


def slow_coefficient(p: Floats, u: Floats, w: Floats, speed: float) -> float:
    """Friction of a slip whose speed (m/s) is small to every law but two.

    These are the transition from mu_s, and the law of speed and state.
    """
    kinetic = kinetic_coefficient(p, u, w)
    set_excess(p, u, w, kinetic)
    mu = local_coefficient(p, u, w, kinetic, 0.0) + transition(p, w, speed)
    if has_state_law(p):
        mu = max(0.0, mu + state_coefficient(p, u, w, speed))
    return mu


def feels_slow_speed(p: Floats) -> bool:
    """Does `slow_coefficient` depend on its speed?"""
    return p[P_TRANSITION_SPEED] > 0.0 or has_state_law(p)


def onset_coefficient(p: Floats, u: Floats, w: Floats) -> float:
    """Friction at the first instant of a slip."""
    return slow_coefficient(p, u, w, 0.0)


def holding_coefficient(p: Floats, u: Floats, w: Floats) -> float:
    """Coefficient that a contact at rest can hold: mu_s, or mu_k where that is larger.

    mu_s grows with the time at rest (frictional ageing). With mu_k > mu_s a block that breaks away
    at mu_s is stopped at once; at rest it therefore holds up to mu_k. With a law of speed and
    state that says what it holds, and mu_s is not used. Water holds nothing at rest.
    """
    onset = onset_coefficient(p, u, w)
    if has_state_law(p):
        return onset
    return max(static_coefficient(p, u, w), onset)
