"""Friction of the contact: coefficients, the table in place of mu_k, creep and bristles."""

from __future__ import annotations

from math import log, sqrt

from .. import Floats
from ..friction.table import end_slope
from ..layout import *
from ..terms import has_ageing, has_local_law, has_memory, with_coefficient_factor
from .points import copy_points, count_grown, count_points, inner_slope, secant

# Of its excess, what friction may err by where bristles are left out: worth some 1e-7 m of the way.
LAG = 1e-4


def set_friction_law(v: Floats, p: Floats) -> None:
    """Everything of friction but the effects' own numbers; mass and normal force are there."""
    p[P_TRANSITION_SPEED] = v[V_FRICTION_TRANSITION_SPEED]
    p[P_TRANSITION_EXPONENT] = v[V_FRICTION_TRANSITION_EXPONENT]
    p[P_MU_S] = with_coefficient_factor(p, v, v[V_FRICTION_MU_S])
    p[P_MU_K] = with_coefficient_factor(p, v, v[V_FRICTION_MU_K])
    p[P_MU_SCALE] = p[P_MU_K]
    set_table(v, p)
    limit = max(p[P_MU_S], p[P_MU_K]) * p[P_NORMAL_FORCE]
    if limit > 0.0:
        p[P_PRESLIDING] = v[V_FRICTION_STICK_CREEP] / limit
        set_bristles(v, p, limit)


def set_table(v: Floats, p: Floats) -> None:
    """Points of the table of mu_k over the sliding speed, and rows of them over the temperature.

    The table takes the place of mu_k, which is then the table's value at rest, the largest of its
    rows'. What depends on the load alone multiplies it as it does mu_k.
    """
    count = count_points(v, V_FRICTION_TABLE_SPEED)
    if count == 0:
        return
    rows = max(1, count_grown(v, V_FRICTION_TABLE_TEMPERATURE_DEGC, TEMPERATURE_LIMIT))
    p[P_TABLE_POINTS] = float(count)
    p[P_TABLE_ROWS] = float(rows)
    at_rest = 0.0
    for i in range(rows):
        row = P_TABLE + TABLE_ROW * i
        p[P_TABLE_TEMPERATURE + i] = v[V_FRICTION_TABLE_TEMPERATURE_DEGC + i]
        mu = V_FRICTION_TABLE_MU + count * i
        copy_points(v, V_FRICTION_TABLE_SPEED, mu, count, p, row, TABLE_WIDTH)
        set_row_slopes(p, row, count)
        at_rest = max(at_rest, p[row + 1])
    p[P_MU_SCALE] = with_coefficient_factor(p, v, 1.0)
    p[P_MU_K] = p[P_MU_SCALE] * at_rest


def set_row_slopes(p: Floats, row: int, count: int) -> None:
    """PCHIP's slopes of so many points ``p[row:]``."""
    last = row + TABLE_WIDTH * (count - 1)
    second = row + TABLE_WIDTH
    before = last - TABLE_WIDTH
    first_rise = secant(p, row, TABLE_WIDTH)
    last_rise = secant(p, before, TABLE_WIDTH)
    p[row + 2] = first_rise
    p[last + 2] = last_rise
    if before == row:  # two points: a straight line
        return
    first_span = p[second] - p[row]
    next_span = p[second + TABLE_WIDTH] - p[second]
    next_rise = secant(p, second, TABLE_WIDTH)
    p[row + 2] = end_slope(first_span, first_rise, next_span, next_rise)
    last_span = p[last] - p[before]
    next_span = p[before] - p[before - TABLE_WIDTH]
    next_rise = secant(p, before - TABLE_WIDTH, TABLE_WIDTH)
    p[last + 2] = end_slope(last_span, last_rise, next_span, next_rise)
    for i in range(1, count - 1):
        at = row + TABLE_WIDTH * i
        p[at + 2] = inner_slope(p, at, TABLE_WIDTH)


def set_bristles(v: Floats, p: Floats, limit: float) -> None:
    """Stiffness and damping of a contact that is sheared by so much under the load ``limit``, N.

    From the sliding speed P_FAST_SLIP on the bristles trail behind those of steady sliding by no
    more than the part LAG of the excess of friction: in a slip that gains a = mu_s g, z_0 a / v_s^2
    times exp(-(u / v_s)^p).
    """
    distance = v[V_FRICTION_PRESLIDING_DISTANCE]
    speed = p[P_TRANSITION_SPEED]
    if distance <= 0.0 or speed <= 0.0:
        return
    p[P_BRISTLE_STIFFNESS] = limit / distance
    critical = 2.0 * sqrt(p[P_BRISTLE_STIFFNESS] * p[P_MASS])
    p[P_BRISTLE_DAMPING] = v[V_FRICTION_BRISTLE_DAMPING] * critical
    lag = distance * limit / p[P_MASS] / (speed * speed)
    fast = max(3.0, log(lag / LAG))
    p[P_FAST_SLIP] = speed * fast ** (1.0 / p[P_TRANSITION_EXPONENT])


def set_kind_of_law(p: Floats) -> None:
    """Whether mu_k varies over the contact, and on what of the past the motion depends.

    The numbers of the effects are there.
    """
    falls = p[P_TRANSITION_SPEED] > 0.0
    if falls or p[P_TABLE_POINTS] > 0.0 or has_local_law(p):
        p[P_LOCAL_LAW] = 1.0
    p[P_FEEDING] = float(MOVING)
    if p[P_BRISTLE_STIFFNESS] > 0.0:
        p[P_FEEDING] = float(SHEARED)
    if has_memory(p) or (falls and has_ageing(p)):
        p[P_FEEDING] = float(REMEMBERED)
