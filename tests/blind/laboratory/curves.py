"""Curves and waves without units, of the laws that go with the Iwan contact.

A law's form from FRESH on is one of these: a curve of u >= 0 that begins at 0, or a wave of period
1 in u between about -1 and 1. A spring's form has its own lines.
"""

from __future__ import annotations

from math import asinh, atan, exp, pi, sin, tanh

import numpy as np
from numba import njit

FRESH = 11
SLOW_HYPERBOLA, ARCTAN, STRETCHED, TANH, ASINH, POWER, DELAYED, RETURNING, HYPERBOLA = range(11, 20)
CURVES = {
    SLOW_HYPERBOLA: "1 - 1/(1 + u^q)",
    ARCTAN: "(2/pi) arctan u",
    STRETCHED: "1 - exp(-u^q)",
    TANH: "tanh u",
    ASINH: "asinh(3u)/asinh 3",
    POWER: "u^q",
    DELAYED: "u^2/(1 + u^2)",
    RETURNING: "u exp(1 - u)",
    HYPERBOLA: "u/(1 + u)",
}
TRIANGLE, SQUARISH, HALF_WAVE, RAMP = range(11, 15)
WAVES = {TRIANGLE: "triangle", SQUARISH: "square", HALF_WAVE: "half wave", RAMP: "ramp"}
LESS_THAN_CUBIC, ENDING, TENSION_POWER = range(11, 14)
SPRINGS = {
    LESS_THAN_CUBIC: "e (1 + |e/b|^0.7)",
    ENDING: "e/(1 - (e/b)^2)",
    TENSION_POWER: "e (1 + (e/b)^1.4) in tension, e else",
}


@njit
def curve(form, u, q):
    """Value at u >= 0 of a curve; q is the power of those that have one."""
    if form == SLOW_HYPERBOLA:
        return 1.0 - 1.0 / (1.0 + u**q)
    if form == ARCTAN:
        return atan(u) * 2.0 / pi
    if form == STRETCHED:
        return 1.0 - exp(-(u**q))
    if form == TANH:
        return tanh(u)
    if form == ASINH:
        return asinh(3.0 * u) / asinh(3.0)
    if form == POWER:
        return u**q
    if form == DELAYED:
        return u * u / (1.0 + u * u)
    if form == RETURNING:
        return u * exp(1.0 - u)
    return u / (1.0 + u)


@njit
def wave(form, u):
    """Value at u, in periods, of a wave whose mean is 0."""
    part = u - np.floor(u)
    if form == TRIANGLE:
        return 4.0 * abs(part - 0.5) - 1.0
    if form == SQUARISH:
        return tanh(sin(2 * pi * part) / 0.3)
    if form == HALF_WAVE:
        return max(sin(2 * pi * part), 0.0) - 1.0 / pi
    return min(2.0 * part / 0.85, 2.0 * (1.0 - part) / 0.15) - 1.0


@njit
def fresh_pull(form, e, b):
    """Extension, m, of the linear spring that would pull as one of these does at e, m."""
    if form == LESS_THAN_CUBIC:
        return e * (1.0 + abs(e / b) ** 0.7)
    if form == ENDING:
        return e / (1.0 - min((e / b) ** 2, 0.8))
    return e * (1.0 + (e / b) ** 1.4) if e > 0.0 else e
