"""The coefficient of friction: over sliding speed, and over what the contact has been through.

The Stribeck curve is mu(s) = mu_k W(s) + (mu_s - mu_k) exp(-(s/v_s)^p). Ageing raises the static
excess; heat, distance, place and load change mu_k, and the static value in one of three ways.
"""

from __future__ import annotations

from math import exp, log, log1p, pi, sqrt

import numpy as np
from numba import njit
from numpy.typing import NDArray

from .apparatus import MODES
from .curves import FRESH, curve, wave

# slow states of a contact, by place in their array
AGE, DISTANCE, TRAVEL, HEAT, OTHER = 0, 1, 2, 3, 3 + MODES
SLOW = OTHER + 4

STAYS, SCALES, FOLLOWS = 0, 1, 2  # what mu_s does when mu_k changes


def half_space(slowest: float = 0.004, fastest: float = 400.0) -> tuple[NDArray, NDArray]:
    """Weights and rates, 1/s, of exponentials whose sum is 1/sqrt(pi t), MODES of them.

    Trapezoidal rule in log s on 1/sqrt(pi t) = (2/pi) int exp(-t s^2) ds, what lies below the
    slowest added to it; good to some per cent between 3/fastest and 0.1/slowest. It is the surface
    temperature of a half-space after a unit of heat (Carslaw and Jaeger, Conduction of heat in
    solids, 1959, section 2.4).
    """
    s = np.geomspace(sqrt(slowest), sqrt(fastest), MODES)
    spacing = np.log(s[1] / s[0])
    weights = 2 / pi * s * spacing
    weights[0] += 2 / pi * s[0] * spacing / np.expm1(spacing)
    return weights, s**2


@njit
def age_shape(p, age):
    if p.ageing_form == 1:  # logarithm
        return log1p(age / p.ageing_time) / log(10.0)
    if p.ageing_form == 2:  # power
        return (age / p.ageing_time) ** p.ageing_power
    if p.ageing_form == 3:  # saturating
        return 1.0 - exp(-age / p.ageing_time)
    if p.ageing_form >= FRESH:
        return curve(p.ageing_form, age / p.ageing_time, p.ageing_power)
    return 0.0


@njit
def heat_factor(p, slow):
    """What warmth leaves of the friction, 0 to 1."""
    if p.heat_form == 0:
        return 1.0
    warmth = 0.0
    for j in range(MODES):
        warmth += p.heat_weight[j] * slow[HEAT + j]
    warmth *= p.heat / p.heat_reference
    if p.heat_form == 1:  # linear, down to a melt film's tenth
        return max(1.0 - warmth, 0.1)
    if p.heat_form == 2:
        return exp(-warmth)
    if p.heat_form >= FRESH:
        return 1.0 - 0.9 * curve(p.heat_form, warmth, 1.0)
    return 1.0 / (1.0 + warmth)


@njit
def run_in_factor(p, distance):
    """Friction after a distance slid, over that of a fresh contact."""
    u = distance / p.run_in_distance if p.run_in_form else 0.0
    if p.run_in_form == 1:
        return 1.0 + p.run_in * (1.0 - exp(-u))
    if p.run_in_form == 2:
        return 1.0 + p.run_in * (1.0 - (1.0 + u) ** (-p.run_in_power))
    if p.run_in_form == 3:  # asperities first, then the surface
        return 1.0 + p.run_in * (0.5 * (1.0 - exp(-6.0 * u)) + 0.5 * (1.0 - exp(-u / 1.5)))
    if p.run_in_form == 4:
        return 1.0 + p.run_in * log1p(3.0 * u) / log(4.0)
    if p.run_in_form >= FRESH:
        return 1.0 + p.run_in * curve(p.run_in_form, u, p.run_in_power)
    return 1.0


@njit
def pattern_factor(p, place):
    """Friction at a place of the surface, m, over the mean surface's."""
    if p.pattern_form == 0:
        return 1.0
    u = (place + p.pattern_start) / p.pattern_length
    d = (u - np.floor(u + 0.5)) * p.pattern_length / p.pattern_width
    if p.pattern_form == 1:  # bumps
        return 1.0 + p.pattern * exp(-d * d)
    if p.pattern_form == 2:  # joints
        return 1.0 - p.pattern / (1.0 + d**4)
    if p.pattern_form >= FRESH:
        return 1.0 + p.pattern * wave(p.pattern_form, u)
    return 1.0 + p.pattern * np.tanh(np.sin(2 * pi * u) / 0.15)  # two materials


@njit
def load_factor(p, load):
    if p.load_form == 1:
        return (load / p.load_reference) ** p.load
    if p.load_form == 2:  # adhesion: a part of the force that no load makes
        return (1.0 - p.load) + p.load * p.load_reference / load
    if p.load_form == 3:
        return 1.0 + p.load * log(load / p.load_reference)
    if p.load_form == FRESH:
        return exp(p.load * (load / p.load_reference - 1.0))
    if p.load_form > FRESH:  # a Hertzian part
        return 1.0 + p.load * (1.0 - (load / p.load_reference) ** (-1.0 / 3.0))
    return 1.0


@njit
def kinetic_and_excess(p, slow, x, load):
    """mu_k and mu_s - mu_k for now, as the contact's past, place and load make them."""
    kinetic, static = p.mu_k, p.mu_s
    for factor, way in (
        (run_in_factor(p, slow[DISTANCE]), p.run_in_static),
        (heat_factor(p, slow), p.heat_static),
    ):
        if way == SCALES:
            static *= factor
        elif way == FOLLOWS:
            static += kinetic * (factor - 1.0)
        kinetic *= factor
    static += p.mu_k * p.ageing * age_shape(p, slow[AGE])
    common = p.scatter * pattern_factor(p, slow[TRAVEL] - x) * load_factor(p, load)
    return common * kinetic, common * (static - kinetic)


@njit
def weakening_factor(p, speed):
    u = speed / p.weakening_speed if p.weakening_form else 0.0
    if p.weakening_form == 1:
        return max(1.0 - p.weakening * u**p.weakening_power, 0.05)
    if p.weakening_form == 2:
        return 1.0 - p.weakening + p.weakening / (1.0 + u)
    if p.weakening_form == 3:
        return max(1.0 - p.weakening * log1p(3.0 * u), 0.05)
    if p.weakening_form >= FRESH:
        return 1.0 - p.weakening * curve(p.weakening_form, u, p.weakening_power)
    return 1.0


@njit
def coefficient(p, kinetic, excess, speed):
    """mu at a sliding speed, m/s >= 0: the Stribeck curve."""
    fall = speed / p.fall_speed
    if fall > 40.0:
        return kinetic * weakening_factor(p, speed)
    if p.fall_power != 1.0:
        fall = fall * fall if p.fall_power == 2.0 else fall**p.fall_power
    return kinetic * weakening_factor(p, speed) + excess * exp(-fall)


@njit
def film_force(p, speed):
    """Drag of a film, N, at a sliding speed >= 0."""
    if p.film_form == 0:
        return 0.0
    u = speed / p.film_speed
    if p.film_form == 1:
        return p.film * u**p.film_power
    if p.film_form >= FRESH:
        return p.film * curve(p.film_form, u, p.film_power)
    return p.film * u / (1.0 + u)  # a film that thins as it is driven


@njit
def age_contact(p, slow, speed, power, h):
    """Advance age, distance slid and heat by h, s, at a sliding speed and a friction power, W."""
    loss = max(speed - 2e-3, 0.0) / p.ageing_slip
    if loss * h > 1e-8:
        kept = exp(-loss * h)
        slow[AGE] = slow[AGE] * kept + (1.0 - kept) / loss
    else:
        slow[AGE] += h
    slow[DISTANCE] += speed * h
    if p.heat_form:
        for j in range(MODES):
            if p.heat_rate[j] > 0.0:
                kept = exp(-p.heat_rate[j] * h)
                slow[HEAT + j] = slow[HEAT + j] * kept + power * (1.0 - kept) / p.heat_rate[j]
