"""The Iwan contact: springs with sliders side by side, of spread strengths.

An element's slider holds up to its share of mu N and then gives way (Jenkins); many of them make
a contact that slides bit by bit and remembers where it turned (Masing). With u = v/v_s,

    mu = mu_k W(v) + (mu_s - mu_k) r / (1 + u^p),   dr/dt = (1 - r)/T - r w/(v_s T)

where w is the mean speed of the sliders: what rest has built up within T is lost over a slip of
v_s T. Steps are velocity Verlet (kick, drift, kick), the sliders by return mapping between.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numba import njit

from .apparatus import ELEMENTS, GRAVITY, LEVELS
from .contacts import add_point, drift, kick, points, slip_velocity
from .forces import belt_speed, disturbance, free_forces
from .friction_law import TRAVEL, age_contact, film_force, kinetic_and_excess, weakening_factor
from .rows import BRISTLES, COLUMNS, FORCE, FRICTION, IWAN_COLUMNS, REST, SLIP, SLOWS


@njit(error_model="numpy")
def iwan_coefficient(p, kinetic, excess, rest, speed):
    """mu at a sliding speed, m/s >= 0, and a state of rest from 0 to 1."""
    fall = speed / p.fall_speed
    if p.fall_power != 1.0:
        fall = fall**p.fall_power
    return kinetic * weakening_factor(p, speed) + excess * rest / (1.0 + fall)


@njit(error_model="numpy")
def slide(p, s, elements, rest, load, kinetic, excess, belt, h, total):
    """Move the surface on below the elements by h, s; their force into total; mean slip, m.

    Below its strength a slider creeps at slider_creep times the eighth power of its use.
    """
    weight = p.mu_s * p.mass * GRAVITY
    slid, creep = 0.0, h * p.slider_creep
    total[:] = 0.0
    for i in range(points(p)):
        vx, vy = slip_velocity(p, s, i, belt)
        speed = sqrt(vx * vx + vy * vy)
        part = p.point_weight[i] if p.planar else 1.0
        use = iwan_coefficient(p, kinetic, excess, rest, speed) * load / weight
        film = film_force(p, speed) / max(speed, 1e-12)
        fx, fy = film * vx, film * vy
        for j in range(LEVELS if p.planar else ELEMENTS):
            share = p.level_share[j] if p.planar else p.element_share[j]
            give = p.level_give[j] if p.planar else p.element_give[j]
            e = 2 * (i * LEVELS + j)
            zx, zy = elements[e] + h * vx, elements[e + 1] + h * vy
            size, limit = sqrt(zx * zx + zy * zy) if p.planar else abs(zx), give * use
            kept = size
            if creep > 0.0 and size > 0.2 * limit:  # below, not worth its while
                square = min(size / limit, 1.0) ** 2
                kept = max(kept - creep * square * square * square * square, 0.0)
            kept = min(kept, limit)
            if kept < size:
                slid += part * share * (size - kept)
                zx *= kept / size
                zy *= kept / size
            elements[e], elements[e + 1] = zx, zy
            fx += weight * share / give * zx
            fy += weight * share / give * zy
        add_point(p, i, -part * fx, -part * fy, total)
    return slid


@njit(error_model="numpy")
def iwan_step(p, s, elements, rest, push, spring_share, load, kinetic, excess, belt, h, total):
    """One step; total is the contact's force from the last step to this. Friction N, mean slip m"""
    gx, gy, gm = free_forces(p, s, push, spring_share)
    kick(p, s, gx + total[0], gy + total[1], gm + total[2], 0.5 * h)
    friction = 0.5 * total[0]
    drift(p, s, h)
    slid = slide(p, s, elements, rest, load, kinetic, excess, belt, h, total)
    gx, gy, gm = free_forces(p, s, push, spring_share)
    kick(p, s, gx + total[0], gy + total[1], gm + total[2], 0.5 * h)
    return friction + 0.5 * total[0], slid


@njit(cache=True, error_model="numpy")
def march_iwan(records, start, begin, count, every, h):
    """Rows at begin, and after every `every` steps of h, s; shape (count + 1, IWAN_COLUMNS)."""
    p = records[0]
    row = start.copy()
    s, slow, elements = row[:BRISTLES], row[SLOWS:FRICTION], row[COLUMNS:REST]
    total = row[FORCE:IWAN_COLUMNS]
    rows = np.empty((count + 1, IWAN_COLUMNS))
    rows[0] = row
    for k in range(count):
        for j in range(every):
            t = begin + (k * every + j) * h
            push, load, springs, mu, extra = disturbance(p, slow, t, h, s, row[FRICTION])
            load *= p.mass * GRAVITY
            belt = belt_speed(p, t + 0.5 * h) + extra
            kinetic, excess = kinetic_and_excess(p, slow, s[0], load)
            row[FRICTION], slid = iwan_step(
                p, s, elements, row[REST], push, springs, load, mu * kinetic, mu * excess,
                belt, h, total,
            )  # fmt: skip
            gain = h / p.rebuild_time
            loss = slid / (p.fall_speed * p.rebuild_time)
            row[REST] = (row[REST] + gain) / (1.0 + gain + loss)
            ux, uy = s[3] - belt, s[4] if p.planar else 0.0
            row[SLIP] = sqrt(ux * ux + uy * uy)
            slow[TRAVEL] += belt * h
            age_contact(p, slow, row[SLIP], abs(row[FRICTION] * ux), h)
        rows[k + 1] = row
    return rows
