"""The moving surface and the forces along x that are no friction."""

from __future__ import annotations

from math import exp, pi, sin

from numba import njit


@njit(inline="always")
def surface_speed(p, t):
    """Speed of the surface at a time, m/s."""
    if p.ripple_form == 0.0:
        return p.speed
    angle = 2.0 * pi * p.ripple_hz * t + p.ripple_phase
    if p.ripple_form == 2.0:
        return p.speed * (1.0 + p.ripple * (sin(angle) + 0.3 * sin(2.0 * angle + 1.0)))
    return p.speed * (1.0 + p.ripple * sin(angle))


@njit(inline="always")
def stretch_of_frame(p, t, x):
    """Displacement that the springs feel: the frame may shake, the attachment may have play."""
    u = x
    if p.shake > 0.0:
        u -= p.shake * sin(2.0 * pi * p.shake_hz * t)
    if p.play > 0.0:
        u -= min(max(u, -p.play), p.play)
    return u


@njit(inline="always")
def strange_force(p, x, travel):
    """Force along x of a belt seam and of a magnet, N."""
    force = 0.0
    if p.seam != 0.0:
        way = (travel - x) % p.seam_loop - 0.5 * p.seam_loop
        force += p.seam * exp(-0.5 * (way / p.seam_width) ** 2)
    if p.magnet != 0.0:
        d = (x - p.magnet_place) / p.magnet_width
        force -= p.magnet * d * exp(0.5 - 0.5 * d * d)
    return force


@njit(inline="always")
def left_stiffness(p, t):
    """Part of the spring stiffness that has not crept away."""
    if p.leak == 0.0:
        return 1.0
    return 1.0 - p.leak * (1.0 - exp(-t / p.leak_time))


@njit(inline="always")
def load(p, mass, x):
    """Normal force, N."""
    return max(9.81 * mass - p.lifting * x, 0.0)
