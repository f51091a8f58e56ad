"""A contact at rest: the load that it holds, and how what slides comes to rest on it."""

from __future__ import annotations

from math import sqrt

from . import Floats
from .contact import holding_ratio, rest_speed, scaled_sliding_speed, set_contact, set_holding_load
from .friction.force import friction_in_slip
from .layout import *
from .rig.surface import set_surface_phase
from .runge_kutta import follow_surface, load_instant
from .stick import set_stick_velocity


def look_at(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> None:
    """Loads, surface and sliding velocity at an instant in ``z``."""
    load_instant(p, z, w, instant)
    set_contact(p, u, w, W_STATE)


def set_contact_in_phase(
    p: Floats, u: Floats, z: Floats, w: Floats, instant: int, phase: float
) -> None:
    """Loads, surface and sliding velocity at an instant in ``z``, in a phase of the surface.

    ``phase`` is a time in the phase that counts: the end of the speed ramp belongs to the step that
    ends there as well as to the one that begins there, and the load differs.
    """
    load_instant(p, z, w, instant)
    set_surface_phase(p, w, phase)
    set_contact(p, u, w, W_STATE)


def excess_load(p: Floats, u: Floats, z: Floats, w: Floats, instant: int, phase: float) -> float:
    """Friction demand over friction capacity, less 1: the function whose zero is the break-away.

    ``phase`` as in `set_contact_in_phase`. A stick ratio below 1 judges stick by a part of the
    load (stick_stiffness, the study's fault).
    """
    set_contact_in_phase(p, u, z, w, instant, phase)
    set_holding_load(p, w)
    for i in range(3):
        w[W_FRICTION + i] *= p[P_STICK_RATIO]
    return holding_ratio(p, u, w) - 1.0


def stop_sliding(
    p: Floats, u: Floats, z: Floats, w: Floats, instant: int, presliding: float
) -> None:
    """Take away what is left of the sliding velocity in ``w``, as friction would.

    What a stick has by ``presliding`` per load, m/(s N), is left. The impulse -M d that takes d
    away makes heat of M d^2 / 2, all of the sliding's energy where there is no presliding, and does
    work on the velocity that is left: the ledger stays closed.
    """
    dx = w[W_SLIDING]
    dy = 0.0
    dr = 0.0
    if p[P_LATERAL] > 0.0:
        dy = p[P_FREE_Y] * w[W_SLIDING + 1]
        dr = p[P_FREE_PHI] * w[W_SLIDING + 2]
    m = p[P_MASS]
    j = p[P_INERTIA]
    follow_surface(p, u, z, w, instant, presliding)
    if presliding != 0.0:
        dx -= w[W_SLIDING]
        if p[P_LATERAL] > 0.0:
            dy -= p[P_FREE_Y] * w[W_SLIDING + 1]
            dr -= p[P_FREE_PHI] * w[W_SLIDING + 2]
    z[instant + HEAT] += 0.5 * (m * (dx * dx + dy * dy) + j * dr * dr)
    work = m * (dx * z[instant + VX] + dy * z[instant + VY]) + j * dr * z[instant + OMEGA]
    z[instant + WORK_SURFACE] -= work


def stick_excess(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> float:
    """`excess_load` of a block that were to stick, with the presliding that it would then have."""
    load_instant(p, z, w, instant)
    set_stick_velocity(p, u, w, p[P_PRESLIDING])
    for i in range(3):
        w[W_FRICTION + i] *= p[P_STICK_RATIO]
    return holding_ratio(p, u, w) - 1.0


def come_to_rest(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> float:
    """Bring a block that hardly slides to rest on the surface, or to presliding; its `excess_load`.

    One that is not to stick preslides no longer, but keeps what velocity it had from that. Leaves
    the contact there in ``w``.
    """
    presliding = p[P_PRESLIDING]
    if presliding != 0.0:
        if stick_excess(p, u, z, w, instant) >= 0.0:
            presliding = 0.0
        look_at(p, u, z, w, instant)
    if presliding == p[P_PRESLIDING] or z[instant + MODE] == SLIP:
        stop_sliding(p, u, z, w, instant, presliding)
    return excess_load(p, u, z, w, instant, z[instant + TIME])


def stopping_time(p: Floats, w: Floats) -> float:
    """Time in which the scaled sliding speed would vanish at its present rate, s; -1 if it grows.

    With the slopes of `begin_step` and the contact in ``w``.
    """
    rate = sliding_rate(p, w, w[W_SLOPES + VX - 1], w[W_SLOPES + VY - 1], w[W_SLOPES + OMEGA - 1])
    if rate >= 0.0:
        return -1.0
    speed = scaled_sliding_speed(p, w)
    return speed * speed / -rate


def time_to_rest(p: Floats, u: Floats, w: Floats) -> float:
    """As `stopping_time`, with the friction of the speeds on the way, where it depends on speed.

    When the end is near, ds / (-ds/dt) is integrated by Gauss-Legendre's three points, the other
    loads as they are now: the nearer to the end a step may go, the fewer are needed. Leaves the
    friction of a slower slip in ``w``.
    """
    rest = stopping_time(p, w)
    speed = scaled_sliding_speed(p, w)
    far = rest < 0.0 or rest > p[P_LONGEST_STEP]
    if p[P_LOCAL_LAW] == 0.0 or far or speed <= rest_speed(p, u):
        return rest
    time = 0.0
    for i in range(3):
        part = 0.5 + 0.5 * (i - 1) * sqrt(0.6)
        weight = (5.0 + 3.0 * (i % 2)) / 18.0
        rate = slower_sliding_rate(p, u, w, part)
        if rate >= 0.0:
            return rest
        time += weight * speed * speed / -rate
    return time


def sliding_rate(p: Floats, w: Floats, ax: float, ay: float, ar: float) -> float:
    """Scaled sliding velocity in ``w`` times its rate, m^2/s^3, where the block accelerates so."""
    kappa = p[P_LATERAL]
    arm = kappa * p[P_RADIUS]
    rate = w[W_SLIDING] * (ax - w[W_SURFACE + 3])
    rate += kappa * kappa * w[W_SLIDING + 1] * (ay - w[W_SURFACE + 4])
    rate += arm * arm * w[W_SLIDING + 2] * (ar - w[W_SURFACE + 5])
    return rate


def slower_sliding_rate(p: Floats, u: Floats, w: Floats, part: float) -> float:
    """As `sliding_rate`, with the friction of a part of the sliding velocity in ``w``."""
    kappa = p[P_LATERAL]
    sy = kappa * w[W_SLIDING + 1]
    sr = kappa * p[P_RADIUS] * w[W_SLIDING + 2]
    friction_in_slip(p, u, w, part * w[W_SLIDING], part * sy, part * sr)
    ax = (w[W_LOAD] + w[W_FRICTION]) / p[P_MASS]
    ay = p[P_FREE_Y] * (w[W_LOAD + 1] + w[W_FRICTION + 1]) / p[P_MASS]
    ar = p[P_FREE_PHI] * (w[W_LOAD + 2] + w[W_FRICTION + 2]) / p[P_INERTIA]
    return sliding_rate(p, w, ax, ay, ar)
