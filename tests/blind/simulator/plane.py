"""Motion in the plane: x, y and rotation, friction summed over the points of the disc."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

import numpy as np
from numba import njit

from .friction import levels, remembered, sheared, shown_part, steepness_at
from .line import COLUMNS, pull
from .surface import left_stiffness, load, strange_force, stretch_of_frame, surface_speed

ANGLES = tuple(pi * degrees / 180.0 for degrees in (160.0, 20.0, 200.0, 340.0))


@njit
def anchors(p):
    """Attachments on the block and anchors on the frame, four rows of (a, b, X, Y)."""
    rows = np.empty((4, 4))
    for i in range(4):
        a, b = p.attachment * cos(ANGLES[i]), p.attachment * sin(ANGLES[i])
        side = 1.0 if a > 0.0 else -1.0
        rows[i, 0], rows[i, 1] = a, b
        rows[i, 2] = a + side * p.length * cos(p.spring_turn)
        rows[i, 3] = b + side * p.length * sin(p.spring_turn) + p.spring_shift
    return rows


@njit
def spring_load(p, rows, x, y, c, s):
    """Force and moment of four springs of exact length: along x, along y, about the centre."""
    fx, fy, moment = 0.0, 0.0, 0.0
    for i in range(4):
        a = c * rows[i, 0] - s * rows[i, 1]
        b = s * rows[i, 0] + c * rows[i, 1]
        dx, dy = rows[i, 2] - x - a, rows[i, 3] - y - b
        length = sqrt(dx * dx + dy * dy)
        tension = pull(p, length - p.natural) / length
        fx += tension * dx
        fy += tension * dy
        moment += tension * (a * dy - b * dx)
    return fx, fy, moment


@njit(fastmath=True)
def contact_sums(p, points, n, level, static, motion, surface):
    """Friction of the disc as (G, h): force = h - G v, with G the six sums of a 3 x 3 matrix.

    motion is (x, y, c, s, vx, vy, omega). The last value is the power lost, W. Friction along x
    alone acts at the centre: what of it turns the block belongs to the friction across, by as much.
    """
    x, y, c, s, vx, vy, omega = motion
    gxx, gyy, gxw, gyw, gww, hx, hy, hw, power = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    lateral, turned = p.lateral, sqrt(p.lateral)
    for i in range(len(points)):
        a = c * points[i, 0] - s * points[i, 1]
        b = turned * (s * points[i, 0] + c * points[i, 1])
        sx = surface * (1.0 - p.curvature * (y + b))
        sy = surface * p.curvature * (x + a)
        wx, wy = sx - vx + omega * b, sy - vy - omega * a
        slip = sqrt(wx * wx + lateral * wy * wy)
        mu = steepness_at(p, level, static, slip, wx < 0.0)
        g = points[i, 2] * (n * mu + sheared(p, slip))
        gy = lateral * g
        gxx += g
        gyy += gy
        gxw -= g * b
        gyw += gy * a
        gww += g * b * b + gy * a * a
        hx += g * sx
        hy += gy * sy
        hw += gy * sy * a - g * sx * b
        power += g * wx * wx + gy * wy * wy
    return gxx, gyy, gxw, gyw, gww, hx, hy, hw, power


@njit(inline="always")
def sliding_speed(p, place, v, surface):
    """Of the centre against the surface there, m/s: a slab turns under a block that rests on it."""
    wx = surface * (1.0 - p.curvature * place[1]) - v[0]
    wy = surface * p.curvature * place[0] - v[1]
    return sqrt(wx * wx + p.lateral * wy * wy)


@njit(inline="always")
def solve_velocity(inertia, sums, step, momentum):
    """Velocities that the momenta leave when friction acts with them: (inertia + step G) v = p.

    inertia is (along x and y, about the centre); G does not couple x and y.
    """
    a, b = inertia[0] + step * sums[0], inertia[0] + step * sums[1]
    e, f = step * sums[2], step * sums[3]
    px, py, turn = momentum
    omega = (turn - e * px / a - f * py / b) / (inertia[1] + step * sums[4] - e * e / a - f * f / b)
    return (px - e * omega) / a, (py - f * omega) / b, omega


@njit(inline="always")
def applied_force(p, frame, t, travel, place, angle, m):
    """Forces and moment that are neither friction nor resonator, and the springs' own along x."""
    x, y = place
    fx, fy, moment = spring_load(p, frame, stretch_of_frame(p, t, x), y, angle[0], angle[1])
    left = left_stiffness(p, t)
    along = left * fx + strange_force(p, x, travel) + m * 9.81 * p.tilt_x
    return along, left * fy + m * 9.81 * p.tilt_y, left * moment, left * fx


@njit(inline="always")
def step_plane(p, frame, points, q, v, hidden, clock, memory, step):
    """One step of place q, velocity v (three each), hidden resonator (x2, v2), (t, travel).

    Returns them new, the memory, the springs' force along x and the sliding speed of the centre.
    """
    h = 0.5 * step
    x, y, phi = q[0] + h * v[0], q[1] + h * v[1], q[2] + h * v[2]
    x2, v2 = hidden[0] + h * hidden[1], hidden[1]
    t = clock[0] + h
    surface = surface_speed(p, t)
    travel = clock[1] + h * surface
    m = p.mass * (1.0 - p.melting * t)
    angle = (cos(phi), sin(phi))
    level, static = levels(p, memory, travel - x)
    motion = (x, y, angle[0], angle[1], v[0], v[1], v[2])
    sums = contact_sums(p, points, load(p, m, x), level, static, motion, surface)
    fx, fy, moment, springs = applied_force(p, frame, t, travel, (x, y), angle, m)
    inner = p.resonator_stiffness * (x2 - x) + p.resonator_damping * (v2 - v[0])
    slip = sliding_speed(p, (x, y), v, surface)
    momentum = (
        m * v[0] + step * (fx + inner + sums[5]),
        m * v[1] + step * (fy + sums[6]),
        p.inertia * v[2] + step * (moment + sums[7]),
    )
    inertia = (m + step * p.damping, p.inertia + step * p.damping_yaw)
    v = solve_velocity(inertia, sums, step, momentum)
    if p.resonator_mass > 0.0:
        v2 -= step * inner / p.resonator_mass
    q = (x + h * v[0], y + h * v[1], phi + h * v[2])
    memory = remembered(p, memory, step, slip, sums[8])
    return q, v, (x2 + h * v2, v2), (t + h, travel + h * surface), memory, springs, slip


@njit(cache=True, fastmath=True)
def walk_plane(p, start, points, step, every, rows):
    """Motion from a state, recorded every so many steps; (rows, len(COLUMNS))."""
    out = np.zeros((rows, len(COLUMNS)))
    frame = anchors(p)
    q, v = (start.x, start.y, start.phi), (start.vx, start.vy, start.omega)
    hidden, clock, memory = (start.x, start.vx), (0.0, 0.0), (0.0, 0.0, 0.0)
    for row in range(rows):
        springs, slip = 0.0, 0.0
        for _ in range(every):
            q, v, hidden, clock, memory, springs, slip = step_plane(
                p, frame, points, q, v, hidden, clock, memory, step
            )
        for k in range(3):
            out[row, k], out[row, 3 + k] = q[k], v[k]
        out[row, 6], out[row, 7] = springs * shown_part(p, slip), slip
    return out
