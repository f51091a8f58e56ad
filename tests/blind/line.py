"""Motion along x alone: one contact point, tiny fixed steps, no stick/slip switch."""

from __future__ import annotations

import numpy as np
from numba import njit

from .friction import BUMP, aged, marked, sheared, steepness, warmed, weakened, worn
from .surface import left_stiffness, load, strange_force, stretch_of_frame, surface_speed

COLUMNS = ("x", "y", "phi", "vx", "vy", "omega", "force", "slip")  # of a recorded motion


@njit(inline="always")
def pull(p, elongation):
    """Tension of one spring, N."""
    tension = p.stiffness * elongation
    if p.cubic_form == 1.0:
        tension += p.cubic * elongation**3
    elif p.cubic_form == 2.0:
        tension += p.cubic * (elongation - (p.length - p.natural)) ** 3
    return tension


@njit(inline="always")
def spring_force(p, u):
    """Two springs to either side, all along x, N."""
    right = pull(p, p.length - u - p.natural)
    left = pull(p, p.length + u - p.natural)
    return 2.0 * (right - left)


@njit(cache=True, fastmath=True)
def walk_line(p, start, step, every, rows):
    """Motion from a state, recorded every so many steps; (rows, len(COLUMNS)).

    Positions leap over half steps (second order); friction is solved with the velocity of the new
    time and the steepness of the old one, so it never pushes the block back past the surface.
    """
    out = np.zeros((rows, 8))
    x, v, x2, v2 = start.x, start.vx, start.x, start.vx
    travel, age, heat, way, t, m = 0.0, 0.0, 0.0, 0.0, 0.0, p.mass
    for row in range(rows):
        for _ in range(every):
            x += 0.5 * step * v
            x2 += 0.5 * step * v2
            t += 0.5 * step
            surface = surface_speed(p, t)
            travel += 0.5 * step * surface
            slip = abs(surface - v)
            m = p.mass * (1.0 - p.melting * t)
            n = load(p, m, x)
            mark = marked(p, travel - x)
            level = mark * p.mu_k * warmed(p, heat) * worn(p, way)
            kinetic = level * weakened(p, slip)
            if p.asymmetry != 0.0 and surface < v:
                kinetic *= 1.0 + p.asymmetry
            static = max((mark * p.mu_s + aged(p, age)) / p.stick_share, kinetic)
            if p.asymmetry != 0.0 and surface < v:
                static *= 1.0 + p.asymmetry
            g = n * steepness(p, kinetic, static, slip) + sheared(p, slip)
            springs = left_stiffness(p, t) * spring_force(p, stretch_of_frame(p, t, x))
            hidden = p.resonator_stiffness * (x2 - x) + p.resonator_damping * (v2 - v)
            force = springs + strange_force(p, x, travel) + hidden + m * 9.81 * p.tilt_x
            v = (m * v + step * (force + g * surface)) / (m + step * (g + p.damping))
            if p.resonator_mass > 0.0:
                v2 -= step * hidden / p.resonator_mass
            if p.ageing_form > 0.0:
                age = (age + step) / (1.0 + step * slip / p.ageing_way)
            if p.thermal_form > 0.0:
                heat += step * (g * slip * slip - heat / p.thermal_time)
            way += step * slip
            x += 0.5 * step * v
            x2 += 0.5 * step * v2
            t += 0.5 * step
            travel += 0.5 * step * surface
        rest = 1.0 / (1.0 + (slip / (BUMP * p.smooth)) ** 4)
        out[row, 0], out[row, 3], out[row, 7] = x, v, slip
        out[row, 6] = springs * (1.0 - rest * (1.0 - p.stick_share))
    return out
