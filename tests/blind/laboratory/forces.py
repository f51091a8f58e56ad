"""What acts on the block besides the contact: springs, damping; and how fast the surface moves."""

from __future__ import annotations

from math import cos, exp, pi, sin, sinh, sqrt

import numpy as np
from numba import njit

from .curves import FRESH, curve, fresh_pull, wave
from .fresh_kinds import FIRST_KIND, fresh_kind
from .held_back import held_back
from .out_of_catalogue import out_of_catalogue


@njit
def spring_pull(p, extension):
    """Force of one spring, N, positive in tension."""
    pull = extension
    if p.spring_form == 1:  # quintic
        pull += extension * (extension / p.spring_b) ** 4
    elif p.spring_form == 2:  # progressive
        pull = p.spring_b * sinh(extension / p.spring_b)
    elif p.spring_form == 3 and extension > 0:  # stiffens in tension only
        pull += extension * (extension / p.spring_b) ** 2
    elif p.spring_form >= FRESH:
        pull = fresh_pull(p.spring_form, extension, p.spring_b)
    if extension < 0 and p.slack > 0:  # a cord does not push
        pull *= 1.0 - p.slack
    return p.stiffness * pull


@njit
def spring_forces(p, x, y, phi):
    """Force and moment about the block's centre of the four springs: N, N, N m."""
    fx, fy, moment = 0.0, 0.0, 0.0
    if p.inverse_inertia == 0.0:  # guided: only what pulls along x counts
        for i in range(4):
            dx = p.anchor_x[i] - x - p.hook_x[i]
            dy = p.anchor_y[i] - p.hook_y[i]
            length = sqrt(dx * dx + dy * dy)
            fx += spring_pull(p, length - p.natural[i]) * dx / length
        return fx, fy, moment
    c, s = cos(phi), sin(phi)
    for i in range(4):
        hx = c * p.hook_x[i] - s * p.hook_y[i]
        hy = s * p.hook_x[i] + c * p.hook_y[i]
        dx, dy = p.anchor_x[i] - x - hx, p.anchor_y[i] - y - hy
        length = sqrt(dx * dx + dy * dy)
        pull = spring_pull(p, length - p.natural[i]) / length
        fx += pull * dx
        fy += pull * dy
        moment += pull * (hx * dy - hy * dx)
    return fx, fy, moment


@njit
def damping_force(p, v):
    """Resistance of the frame to a speed along one axis, N."""
    if p.damping == 0.0:
        return 0.0
    if p.damping_form >= FRESH:
        size = p.damping * curve(p.damping_form, abs(v) / p.damping_speed, p.damping_power)
        return -size if v > 0.0 else size
    return (
        -p.damping
        * v
        / p.damping_speed
        * (abs(v) / p.damping_speed + 1e-6) ** (p.damping_power - 1.0)
    )


@njit
def free_forces(p, s, push, spring_share):
    """Everything but the contact at a state (x, y, phi and their rates)."""
    fx, fy, moment = spring_forces(p, s[0], s[1], s[2])
    return (
        spring_share * fx + damping_force(p, s[3]) + push,
        spring_share * fy + damping_force(p, s[4]),
        spring_share * moment,
    )


@njit
def belt_speed(p, t):
    """Speed of the surface along x at the rig's origin, m/s."""
    u = p.ripple_frequency * t + p.ripple_start
    if p.ripple_form == 1:  # a bump once in a roller's turn
        d = (u - np.floor(u + 0.5)) / p.ripple_width
        return p.belt_speed * (1.0 + p.ripple * (exp(-d * d) - p.ripple_width * sqrt(pi)))
    if p.ripple_form == 2:  # two harmonics, as of a worn gear
        return p.belt_speed * (1.0 + p.ripple * (sin(2 * pi * u) + 0.6 * sin(4 * pi * u + 1.0)))
    if p.ripple_form == 3:  # slow rise, quick fall
        return p.belt_speed * (1.0 + p.ripple * (2.0 * (u - np.floor(u)) - 1.0))
    if p.ripple_form >= FRESH:
        return p.belt_speed * (1.0 + p.ripple * wave(p.ripple_form, u))
    return p.belt_speed


@njit
def disturbance(p, slow, t, h, s, friction):
    """What no catalogue holds: push N, factors of load, spring and friction, belt's extra m/s."""
    if p.other_form == 0:
        return 0.0, 1.0, 1.0, 1.0, 0.0
    if p.other_form < 100:
        return out_of_catalogue(p, slow, t, h, s, friction)
    if p.other_form >= FIRST_KIND:
        return fresh_kind(p, slow, t, h, s, friction)
    return held_back(p, slow, t, h, s, friction)
