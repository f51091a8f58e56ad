"""Motion in the plane: x, y and rotation, friction summed over the points of the disc."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

import numpy as np
from numba import njit

from .friction import BUMP, aged, marked, sheared, steepness, warmed, weakened, worn
from .line import pull
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

    motion is (x, y, c, s, vx, vy, omega). The last value is the power lost, W.
    """
    x, y, c, s, vx, vy, omega = motion
    gxx, gyy, gxw, gyw, gww, hx, hy, hw, power = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    lateral = p.lateral
    for i in range(len(points)):
        a = c * points[i, 0] - s * points[i, 1]
        b = s * points[i, 0] + c * points[i, 1]
        sx = surface * (1.0 - p.curvature * (y + b))
        sy = surface * p.curvature * (x + a)
        wx, wy = sx - vx + omega * b, sy - vy - omega * a
        slip = sqrt(wx * wx + lateral * wy * wy)
        kinetic = level * weakened(p, slip)
        held = max(static, kinetic)
        if p.asymmetry != 0.0 and wx < 0.0:
            kinetic *= 1.0 + p.asymmetry
            held *= 1.0 + p.asymmetry
        g = points[i, 2] * (n * steepness(p, kinetic, held, slip) + sheared(p, slip))
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
def solve_velocity(mx, my, mw, sums, step, px, py, pw):
    """Velocities that the momenta px, py, pw leave when friction acts with them: 3 x 3, symmetric.

    There is no coupling of x and y: (mx + step G) v = p.
    """
    a, b, w = mx + step * sums[0], my + step * sums[1], mw + step * sums[4]
    e, f = step * sums[2], step * sums[3]
    omega = (pw - e * px / a - f * py / b) / (w - e * e / a - f * f / b)
    return (px - e * omega) / a, (py - f * omega) / b, omega


@njit(cache=True, fastmath=True)
def walk_plane(p, start, points, step, every, rows):
    """Motion from a state, recorded every so many steps; (rows, 8) as `line.COLUMNS`."""
    out = np.zeros((rows, 8))
    frame = anchors(p)
    x, y, phi, vx, vy, omega = start
    x2, v2 = start.x, start.vx
    travel, age, heat, way, t = 0.0, 0.0, 0.0, 0.0, 0.0
    for row in range(rows):
        for _ in range(every):
            x += 0.5 * step * vx
            y += 0.5 * step * vy
            phi += 0.5 * step * omega
            x2 += 0.5 * step * v2
            t += 0.5 * step
            surface = surface_speed(p, t)
            travel += 0.5 * step * surface
            m = p.mass * (1.0 - p.melting * t)
            n = load(p, m, x)
            c, s = cos(phi), sin(phi)
            mark = marked(p, travel - x)
            level = mark * p.mu_k * warmed(p, heat) * worn(p, way)
            static = (mark * p.mu_s + aged(p, age)) / p.stick_share
            motion = (x, y, c, s, vx, vy, omega)
            sums = contact_sums(p, points, n, level, static, motion, surface)
            u = stretch_of_frame(p, t, x)
            fx, fy, moment = spring_load(p, frame, u, y, c, s)
            left = left_stiffness(p, t)
            hidden = p.resonator_stiffness * (x2 - x) + p.resonator_damping * (v2 - vx)
            extra = strange_force(p, x, travel) + hidden + m * 9.81 * p.tilt_x
            px = m * vx + step * (left * fx + extra + sums[5])
            py = m * vy + step * (left * fy + m * 9.81 * p.tilt_y + sums[6])
            pw = p.inertia * omega + step * (left * moment + sums[7])
            damp = step * p.damping
            turn = p.inertia + step * p.damping_yaw
            slip = sqrt((surface - vx) ** 2 + p.lateral * vy * vy)
            vx, vy, omega = solve_velocity(m + damp, m + damp, turn, sums, step, px, py, pw)
            if p.resonator_mass > 0.0:
                v2 -= step * hidden / p.resonator_mass
            age = (age + step) / (1.0 + step * slip / p.ageing_way)
            heat += step * (sums[8] - heat / p.thermal_time)
            way += step * slip
            x += 0.5 * step * vx
            y += 0.5 * step * vy
            phi += 0.5 * step * omega
            x2 += 0.5 * step * v2
            t += 0.5 * step
            travel += 0.5 * step * surface
        rest = 1.0 / (1.0 + (slip / (BUMP * p.smooth)) ** 4)
        force = left * fx * (1.0 - rest * (1.0 - p.stick_share))
        for k, value in enumerate((x, y, phi, vx, vy, omega, force, slip)):
            out[row, k] = value
    return out
