"""Friction level of a contact point: kinetic, held, and what makes either change.

The force is smooth in the sliding velocity w: mu(|w|) N w / (|w|^4 + e^4)^(1/4), with a narrow
bump at rest that lifts mu from the kinetic to the static level.
"""

from __future__ import annotations

from math import exp, log1p, log10, pi, sin, sqrt

from numba import njit

BUMP = 10.0  # width of the static bump in units of the smoothing speed


@njit(inline="always")
def weakened(p, slip):
    """Factor on the kinetic level at a sliding speed, 1 at rest."""
    if p.weakening_form == 1.0:
        return max(1.0 - p.weakening * slip, 0.1)
    if p.weakening_form == 2.0:
        return 1.0 / (1.0 + p.weakening * slip)
    if p.weakening_form == 3.0:  # Stribeck: the level falls by a part, over a speed
        return 1.0 - p.weakening * (1.0 - exp(-slip / p.weakening_speed))
    if p.weakening_form == 4.0:
        return 1.0 / sqrt(1.0 + p.weakening * slip)
    return 1.0


@njit(inline="always")
def flashed(p, slip):
    """Factor on the kinetic level where contacts get hot before they part; sharpness 8.

    Of a contact's life the part that it is still cool in is the smaller of 1 and flash_speed/slip,
    rounded as the length of a vector is: the eighth norm of (1, slip / flash_speed), inverted.
    """
    if p.flash == 0.0:
        return 1.0
    low, high = min(slip, p.flash_speed), max(slip, p.flash_speed)
    cool = p.flash_speed / high * exp(-log1p((low / high) ** 8) / 8.0)
    return 1.0 - p.flash * (1.0 - cool)


@njit(inline="always")
def warmed(p, heat):
    """Factor on the kinetic level after recent friction heat, J."""
    if p.thermal_form == 1.0:
        return max(1.0 - p.thermal * heat, 0.1)
    if p.thermal_form == 2.0:
        return exp(-p.thermal * heat)
    if p.thermal_form == 3.0:
        return 1.0 / (1.0 + p.thermal * heat)
    return 1.0


@njit(inline="always")
def worn(p, way):
    """Factor on the kinetic level after a distance slid, m."""
    if p.run_in_form == 1.0:
        return 1.0 + p.run_in * (1.0 - exp(-way / p.run_in_way))
    if p.run_in_form == 2.0:
        return 1.0 + p.run_in * min(way / p.run_in_way, 1.0)
    if p.run_in_form == 3.0:
        return 1.0 + p.run_in * way / (way + p.run_in_way)
    return 1.0


@njit(inline="always")
def marked(p, place):
    """Factor on both levels at a place of the surface, m."""
    if p.pattern_form == 0.0:
        return 1.0
    angle = 2.0 * pi * place / p.pattern_length + p.pattern_phase
    if p.pattern_form == 2.0:  # rounder valleys than hills
        return 1.0 + p.pattern * (sin(angle) + 0.25 * sin(2.0 * angle + 0.7))
    return 1.0 + p.pattern * sin(angle)


@njit(inline="always")
def aged(p, age):
    """What a hold of some seconds adds to the static level."""
    if p.ageing_form == 1.0:
        return p.ageing * log10(1.0 + age / p.ageing_time)
    if p.ageing_form == 2.0:
        return p.ageing * (1.0 - exp(-age / p.ageing_time))
    return 0.0


@njit(inline="always")
def steepness(p, kinetic, static, slip):
    """Friction coefficient over the sliding speed, s/m: mu(|w|) / (|w|^4 + e^4)^(1/4)."""
    ratio = slip / (BUMP * p.smooth)
    mu = kinetic + (static - kinetic) / (1.0 + ratio * ratio * ratio * ratio)
    q = slip * slip
    e2 = p.smooth * p.smooth
    return mu / sqrt(sqrt(q * q + e2 * e2))


@njit(inline="always")
def sheared(p, slip):
    """Film force of the whole contact over the sliding speed, N s/m."""
    return p.drag + p.root_drag / sqrt(slip + 1e-9)


@njit(inline="always")
def levels(p, memory, place):
    """Kinetic and static level of the whole contact, before the sliding speed enters.

    memory is (age in s, recent friction heat in J, distance slid in m).
    """
    mark = marked(p, place)
    kinetic = mark * p.mu_k * warmed(p, memory[1]) * worn(p, memory[2])
    return kinetic, (mark * p.mu_s + aged(p, memory[0])) / p.stick_share


@njit(inline="always")
def remembered(p, memory, step, slip, power):
    """Memory of the contact after a step at a sliding speed and a friction power, W."""
    age, heat, way = memory
    if p.ageing_form > 0.0:
        age = (age + step) / (1.0 + step * slip / p.ageing_way)
    if p.thermal_form > 0.0:
        heat += step * (power - heat / p.thermal_time)
    return age, heat, way + step * slip


@njit(inline="always")
def steepness_at(p, level, static, slip, backwards):
    """Steepness with what the speed and the direction of sliding do to the levels, s/m."""
    kinetic = level * weakened(p, slip) * flashed(p, slip)
    held = max(static, kinetic)
    if backwards:
        kinetic *= 1.0 + p.asymmetry
        held *= 1.0 + p.asymmetry
    return steepness(p, kinetic, held, slip)


@njit(inline="always")
def shown_part(p, slip):
    """Part of the spring force that a load cell sees: less at rest where one spring holds."""
    rest = 1.0 / (1.0 + (slip / (BUMP * p.smooth)) ** 4)
    return 1.0 - rest * (1.0 - p.stick_share)
