"""Motion along x alone: one contact point, tiny fixed steps, no stick/slip switch."""

from __future__ import annotations

import numpy as np
from numba import njit

from .friction import levels, remembered, sheared, shown_part, steepness_at
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


@njit(inline="always")
def step_line(p, motion, memory, step):
    """One step: new (x, v, x2, v2, t, travel), new memory, spring force, sliding speed.

    Positions leap over half steps (second order); friction is solved with the velocity of the new
    time and the steepness of the old one, so it never pushes the block back past the surface.
    x2, v2 are those of a hidden resonator.
    """
    x, v, x2, v2, t, travel = motion
    x += 0.5 * step * v
    x2 += 0.5 * step * v2
    t += 0.5 * step
    surface = surface_speed(p, t)
    travel += 0.5 * step * surface
    m = p.mass * (1.0 - p.melting * t)
    slip = abs(surface - v)
    level, static = levels(p, memory, travel - x)
    g = load(p, m, x) * steepness_at(p, level, static, slip, surface < v) + sheared(p, slip)
    springs = left_stiffness(p, t) * spring_force(p, stretch_of_frame(p, t, x))
    hidden = p.resonator_stiffness * (x2 - x) + p.resonator_damping * (v2 - v)
    force = springs + strange_force(p, x, travel) + hidden + m * 9.81 * p.tilt_x
    memory = remembered(p, memory, step, slip, g * slip * slip)
    v = (m * v + step * (force + g * surface)) / (m + step * (g + p.damping))
    if p.resonator_mass > 0.0:
        v2 -= step * hidden / p.resonator_mass
    x += 0.5 * step * v
    x2 += 0.5 * step * v2
    motion = (x, v, x2, v2, t + 0.5 * step, travel + 0.5 * step * surface)
    return motion, memory, springs, slip


@njit(cache=True, fastmath=True)
def walk_line(p, start, step, every, rows):
    """Motion from a state, recorded every so many steps; (rows, len(COLUMNS))."""
    out = np.zeros((rows, len(COLUMNS)))
    motion = (start.x, start.vx, start.x, start.vx, 0.0, 0.0)
    memory = (0.0, 0.0, 0.0)
    for row in range(rows):
        springs, slip = 0.0, 0.0
        for _ in range(every):
            motion, memory, springs, slip = step_line(p, motion, memory, step)
        out[row, 0], out[row, 3] = motion[0], motion[1]
        out[row, 6], out[row, 7] = springs * shown_part(p, slip), slip
    return out
