"""Four contacts, each advanced by an integrator of its own, a fixed small step at a time.

A step takes a record p, the state s = (x, y, phi and their rates), the bristles z (2 numbers a
contact point), what acts from outside for this step (push, spring_share, load, kinetic, excess,
belt: see forces and friction_law) and h, s. It changes s and z and returns the friction along x, N.
"""

from __future__ import annotations

from math import exp, pi, sin, sqrt, tanh

import numpy as np
from numba import njit

from .apparatus import POINTS
from .forces import free_forces
from .friction_law import coefficient, film_force

SWEEPS = 12  # of the projected Gauss-Seidel at most
STILL = 1e-9  # m/s below which a point of the jump contact sticks


@njit
def drift(p, s, h):
    s[0] += h * s[3]
    if p.inverse_inertia > 0.0:
        s[1] += h * s[4]
        s[2] += h * s[5]


@njit
def kick(p, s, fx, fy, moment, h):
    s[3] += h * fx / p.mass
    s[4] += h * fy * p.inverse_mass_y
    s[5] += h * moment * p.inverse_inertia


@njit
def points(p):
    return POINTS if p.planar else 1


@njit
def slip_velocity(p, s, i, belt):
    """Velocity of a contact point of the block over the surface, m/s; along x alone on a line."""
    if not p.planar:
        return s[3] - belt, 0.0
    px, py = p.point_x[i], p.point_y[i]
    ux, uy = s[3] - s[5] * py, s[4] + s[5] * px
    if p.slab_y == 0.0:
        return ux - belt, uy
    turn = belt / p.slab_y  # rad/s about (slab_x, slab_y)
    return ux + turn * (s[1] + py - p.slab_y), uy - turn * (s[0] + px - p.slab_x)


@njit
def add_point(p, i, fx, fy, total):
    """Add a point's force to the sum of force and moment."""
    total[0] += fx
    if p.planar:
        total[1] += fy
        total[2] += p.point_x[i] * fy - p.point_y[i] * fx


@njit
def elastic_share(p, zx, zy, vx, vy, limit):
    """alpha of Dupont et al. (IEEE Trans. Automat. Contr. 47, 787, 2002): 0 elastic, 1 plastic."""
    if p.contact == 0:
        return 1.0
    if zx * vx + zy * vy <= 0.0:
        return 0.0
    z, least = sqrt(zx * zx + zy * zy), p.elastic_share * limit
    if z <= least:
        return 0.0
    if z >= limit:
        return 1.0
    return 0.5 + 0.5 * sin(pi * (z - 0.5 * (limit + least)) / (limit - least))


@njit
def bristle_force(p, s, z, load, kinetic, excess, belt, total):
    """Sum of sigma_0 z + sigma_1 dz/dt and film drag over the contact points, into total."""
    stiff = p.mu_s * load / p.presliding
    damper = 2.0 * p.bristle_damping * sqrt(stiff * p.mass)
    total[:] = 0.0
    for i in range(points(p)):
        share = p.point_weight[i] if p.planar else 1.0
        vx, vy = slip_velocity(p, s, i, belt)
        speed = sqrt(vx * vx + vy * vy)
        limit = p.presliding * coefficient(p, kinetic, excess, speed) / p.mu_s
        zx, zy = z[2 * i], z[2 * i + 1]
        give = elastic_share(p, zx, zy, vx, vy, limit) * speed / limit
        film = film_force(p, speed) / max(speed, 1e-12)
        fx = stiff * zx + damper * (vx - give * zx) + film * vx
        fy = stiff * zy + damper * (vy - give * zy) + film * vy
        add_point(p, i, -share * fx, -share * fy, total)


@njit
def lugre_step(p, s, z, push, spring_share, load, kinetic, excess, belt, h, total):
    """LuGre (Canudas de Wit et al. 1995): Strang splitting, bristles by their exponential.

    The bristles' damping is explicit, which leaves the whole of first order, with a small constant.
    """
    drift(p, s, 0.5 * h)
    gx, gy, gm = free_forces(p, s, push, spring_share)
    bristle_force(p, s, z, load, kinetic, excess, belt, total)
    kick(p, s, gx + total[0], gy + total[1], gm + total[2], 0.5 * h)
    friction = 0.5 * total[0]
    for i in range(points(p)):
        vx, vy = slip_velocity(p, s, i, belt)
        speed = sqrt(vx * vx + vy * vy)
        limit = p.presliding * coefficient(p, kinetic, excess, speed) / p.mu_s
        u = h * speed / limit
        kept = exp(-u)
        gain = h * (1.0 - kept) / u if u > 1e-8 else h
        z[2 * i] = kept * z[2 * i] + gain * vx
        z[2 * i + 1] = kept * z[2 * i + 1] + gain * vy
    gx, gy, gm = free_forces(p, s, push, spring_share)
    bristle_force(p, s, z, load, kinetic, excess, belt, total)
    kick(p, s, gx + total[0], gy + total[1], gm + total[2], 0.5 * h)
    drift(p, s, 0.5 * h)
    return friction + 0.5 * total[0]


@njit
def elasto_plastic_step(p, s, z, push, spring_share, load, kinetic, excess, belt, h, total):
    """Elasto-plastic bristles: implicit midpoint, three fixed-point sweeps."""
    n = points(p)
    first, first_z = s.copy(), z.copy()
    middle, middle_z = s.copy(), z.copy()
    for _ in range(3):
        for i in range(n):
            vx, vy = slip_velocity(p, middle, i, belt)
            speed = sqrt(vx * vx + vy * vy)
            limit = p.presliding * coefficient(p, kinetic, excess, speed) / p.mu_s
            share = elastic_share(p, middle_z[2 * i], middle_z[2 * i + 1], vx, vy, limit)
            a = 0.5 * h * share * speed / limit
            middle_z[2 * i] = (first_z[2 * i] + 0.5 * h * vx) / (1.0 + a)
            middle_z[2 * i + 1] = (first_z[2 * i + 1] + 0.5 * h * vy) / (1.0 + a)
        for j in range(3):
            middle[j] = first[j] + 0.5 * h * middle[3 + j]
        gx, gy, gm = free_forces(p, middle, push, spring_share)
        bristle_force(p, middle, middle_z, load, kinetic, excess, belt, total)
        for j in range(3):
            middle[3 + j] = first[3 + j]
        kick(p, middle, gx + total[0], gy + total[1], gm + total[2], 0.5 * h)
    for j in range(6):
        s[j] = 2.0 * middle[j] - first[j]
    for j in range(2 * n):
        z[j] = 2.0 * middle_z[j] - first_z[j]
    return total[0]


@njit
def smooth_forces(p, s, push, spring_share, load, kinetic, excess, belt, total):
    """All forces with friction mu(|v|) tanh(|v|/creep) along the slip velocity."""
    total[:] = 0.0
    for i in range(points(p)):
        share = p.point_weight[i] if p.planar else 1.0
        vx, vy = slip_velocity(p, s, i, belt)
        speed = sqrt(vx * vx + vy * vy) + 1e-15
        pull = load * coefficient(p, kinetic, excess, speed) * tanh(speed / p.creep_speed)
        pull = share * (pull + film_force(p, speed)) / speed
        add_point(p, i, -pull * vx, -pull * vy, total)
    friction = total[0]
    gx, gy, gm = free_forces(p, s, push, spring_share)
    total[0] += gx
    total[1] += gy
    total[2] += gm
    return friction


@njit
def smooth_step(p, s, z, push, spring_share, load, kinetic, excess, belt, h, total):
    """Regularised friction with a Stribeck peak: classical Runge-Kutta of order four."""
    first, rate, change = s.copy(), np.zeros(6), np.zeros(6)
    friction = 0.0
    for stage in range(4):
        ahead = 0.0 if stage == 0 else (h if stage == 3 else 0.5 * h)
        weight = h / 6.0 if stage in (0, 3) else h / 3.0
        for j in range(6):
            s[j] = first[j] + ahead * rate[j]
        pull = smooth_forces(p, s, push, spring_share, load, kinetic, excess, belt, total)
        friction += weight / h * pull
        rate[0] = s[3]
        rate[1] = s[4] if p.inverse_inertia > 0.0 else 0.0
        rate[2] = s[5] if p.inverse_inertia > 0.0 else 0.0
        rate[3] = total[0] / p.mass
        rate[4] = total[1] * p.inverse_mass_y
        rate[5] = total[2] * p.inverse_inertia
        for j in range(6):
            change[j] += weight * rate[j]
    for j in range(6):
        s[j] = first[j] + change[j]
    return friction


@njit
def jump_step(p, s, z, push, spring_share, load, kinetic, excess, belt, h, total):
    """Set-valued Coulomb friction that jumps from mu_s to mu_k: Moreau's midpoint time-stepping.

    The impulses of the contact points solve the cone condition at the end of the step by projected
    Gauss-Seidel, warm-started from z (Acary and Brogliato 2008, chapters 10 and 13).
    """
    n = points(p)
    limits, speeds = np.empty(n), np.empty(n)
    for i in range(n):
        share = p.point_weight[i] if p.planar else 1.0
        vx, vy = slip_velocity(p, s, i, belt)
        speed = sqrt(vx * vx + vy * vy)
        speeds[i] = speed
        sticks = speed < STILL * 100
        mu = kinetic + excess if sticks else coefficient(p, kinetic, 0.0, speed)
        limits[i] = share * h * mu * load
    drift(p, s, 0.5 * h)
    gx, gy, gm = free_forces(p, s, push, spring_share)
    total[:] = 0.0
    for i in range(n):  # film: explicit
        if speeds[i] > 0.0:
            share = p.point_weight[i] if p.planar else 1.0
            vx, vy = slip_velocity(p, s, i, belt)
            film = share * film_force(p, speeds[i]) / speeds[i]
            add_point(p, i, -film * vx, -film * vy, total)
    friction = total[0]
    kick(p, s, gx + total[0], gy + total[1], gm + total[2], h)
    friction += solve_impulses(p, s, z, limits, belt) / h
    drift(p, s, 0.5 * h)
    return friction


@njit
def solve_impulses(p, s, z, limits, belt):
    """Bring the contact points to rest on the surface within their limits, N s; sum along x."""
    n = limits.size
    for i in range(n):
        size = sqrt(z[2 * i] ** 2 + z[2 * i + 1] ** 2)
        cut = limits[i] / size if size > limits[i] else 1.0
        z[2 * i] *= cut
        z[2 * i + 1] *= cut
        strike(p, s, i, z[2 * i], z[2 * i + 1])
    for _ in range(SWEEPS if p.planar else 1):
        change = 0.0
        for i in range(n):
            vx, vy = slip_velocity(p, s, i, belt)
            inverse = 1.0 / p.mass
            if p.planar:
                arm = p.point_x[i] ** 2 + p.point_y[i] ** 2
                inverse += p.inverse_inertia * arm
            zx, zy = z[2 * i] - vx / inverse, z[2 * i + 1] - vy / inverse
            size = sqrt(zx * zx + zy * zy)
            if size > limits[i]:
                zx *= limits[i] / size
                zy *= limits[i] / size
            dx, dy = zx - z[2 * i], zy - z[2 * i + 1]
            strike(p, s, i, dx, dy)
            z[2 * i], z[2 * i + 1] = zx, zy
            change = max(change, abs(dx) + abs(dy))
        if change < 1e-9 * p.mass:
            break
    along = 0.0
    for i in range(n):
        along += z[2 * i]
    return along


@njit
def strike(p, s, i, jx, jy):
    s[3] += jx / p.mass
    if p.planar:
        s[4] += jy * p.inverse_mass_y
        s[5] += (p.point_x[i] * jy - p.point_y[i] * jx) * p.inverse_inertia
