"""Quasi-steady sliding: a slip so slow that the load alone says where it goes.

Where the sliding speed s is small, friction turns the sliding velocity at the rate mu g / s: the
faster, the slower the slip. A contact loaded to just its limit (mu_k as large as mu_s, or friction
weaker across the motion than along it) slides like that for long, and a method that follows the
turning crawls. But then the direction is known: relative acceleration and sliding velocity are
parallel, so the unit vector n solves

    M (a n + s n') = T - mu N grad P(n),

with the load T that the surface would have to hold, the mean local sliding speed P and the
acceleration a, small against mu g: n is normal to the limit surface at T - M (a n + s n'). The rate
n' at which it turns is that of the n which the same equation gives without it; what this leaves out
is of second order in s n' / (mu g). What is left to integrate is not stiff: the places, moving with
s n, and sigma = s sqrt(n . M n), whose square is twice the kinetic energy of the sliding. The
direction of the stored velocity stays that of the step's beginning and is turned to n at its end,
at the same sigma.
"""

from __future__ import annotations

from math import sqrt

from .contact import (
    rest_speed,
    scaled_sliding_speed,
    set_contact,
    set_holding_load,
    set_yielding_motion,
    speed_scale,
)
from .friction.coefficient import feels_slow_speed, onset_coefficient, slow_coefficient
from .friction.disc import disc_friction
from .friction.force import friction_at_onset, friction_in_slip
from .layout import *

# Of the motion's own speed; above it an explicit step is long enough to follow the turning.
QUASI_STEADY_SPEED = 1e-4
# The time over which the rate of turning is a difference quotient, per time of the motion: its
# error of first order is below that of leaving out the second order.
LOOK_AHEAD = 1e-4
# Acceleration along the sliding, per friction over mass, up to which a slip is quasi-steady. An
# ordinary slip begins with (mu_s - mu_k) / mu_k and ends with more.
QUASI_STEADY_ACCELERATION = 0.01


def direction_is_free(p: Floats) -> bool:
    """Is the direction of sliding free to turn?"""
    guided = p[P_FREE_Y] == 0.0 or p[P_FREE_PHI] == 0.0
    if guided and p[P_CURVATURE] != 0.0:  # a turning surface carries nothing along the guides
        return False
    return p[P_LATERAL] > 0.0


def sliding_inertia(p: Floats, w: Floats, at: int) -> float:
    """n . M n for the scaled direction n at ``w[at:]``, kg: twice the kinetic energy at 1 m/s."""
    kappa = p[P_LATERAL]
    nx = w[at]
    ny = w[at + 1] / kappa
    nr = w[at + 2] / (kappa * p[P_RADIUS])
    return p[P_MASS] * (nx * nx + ny * ny) + p[P_INERTIA] * nr * nr


def mean_part(w: Floats) -> float:
    """Mean local sliding speed over the scaled sliding speed, along ``w[W_STEADY:]``."""
    sliding = sqrt(w[W_STEADY] * w[W_STEADY] + w[W_STEADY + 1] * w[W_STEADY + 1])
    spinning = abs(w[W_STEADY + 2])
    disc_friction(sliding, spinning, w)
    return w[W_PAIR] * sliding + w[W_PAIR + 1] * spinning


def solve_direction(
    p: Floats, u: Floats, w: Floats, speed: float, qx: float, qy: float, qr: float
) -> float:
    """Direction n under the loads in ``w``, into ``w[W_STEADY:]``; returns a, m/s^2.

    ``speed`` is the mean local sliding speed, (qx, qy, qr) is s n', in the velocities of the
    block. The search ends where a comes to a tenth of
    what friction gives: that is not quasi-steady.
    """
    kappa = p[P_LATERAL]
    arm = kappa * p[P_RADIUS]
    m = p[P_MASS]
    j = p[P_INERTIA]
    set_holding_load(p, w)
    hx = w[W_FRICTION] + m * qx
    hy = w[W_FRICTION + 1] + p[P_FREE_Y] * m * qy
    hr = w[W_FRICTION + 2] + p[P_FREE_PHI] * j * qr
    ex = w[W_DIRECTION]
    ey = w[W_DIRECTION + 1]
    er = w[W_DIRECTION + 2]
    limit = slow_coefficient(p, u, w, speed) * p[P_NORMAL_FORCE]
    a = 0.0
    more = limit / m
    sweep = 0
    while abs(more) > 1e-12 * limit / m and abs(a) < 0.1 * limit / m and sweep < 20:
        w[W_FRICTION] = hx
        w[W_FRICTION + 1] = hy
        w[W_FRICTION + 2] = hr
        if sweep > 0:
            w[W_FRICTION] += a * m * w[W_DIRECTION]
            w[W_FRICTION + 1] += a * p[P_FREE_Y] * m * w[W_DIRECTION + 1] / kappa
            w[W_FRICTION + 2] += a * p[P_FREE_PHI] * j * w[W_DIRECTION + 2] / arm
        more = set_yielding_motion(p, limit, w)
        a += more
        sweep += 1
    for i in range(3):
        w[W_STEADY + i] = w[W_DIRECTION + i]
    w[W_DIRECTION] = ex
    w[W_DIRECTION + 1] = ey
    w[W_DIRECTION + 2] = er
    return a


def set_steady_direction(p: Floats, u: Floats, w: Floats, sigma: float) -> float:
    """Direction n of quasi-steady sliding at the instant in ``w``; returns a, m/s^2.

    n goes into ``w[W_STEADY:]``.
    """
    a = solve_direction(p, u, w, 0.0, 0.0, 0.0, 0.0)
    speed = sigma / sqrt(sliding_inertia(p, w, W_STEADY))
    if speed <= 0.0:
        return a
    mean = 0.0
    if feels_slow_speed(p):  # what the contact holds is known once its speed is
        mean = speed * mean_part(w)
        a = solve_direction(p, u, w, mean, 0.0, 0.0, 0.0)
    kappa = p[P_LATERAL]
    arm = kappa * p[P_RADIUS]
    ahead = LOOK_AHEAD / p[P_RATE]
    nx = w[W_STEADY]
    ny = w[W_STEADY + 1]
    nr = w[W_STEADY + 2]
    time = w[W_STATE + TIME]
    x = w[W_STATE + X]
    y = w[W_STATE + Y]
    phi = w[W_STATE + PHI]
    w[W_STATE + TIME] = time + ahead
    w[W_STATE + X] = x + ahead * (w[W_SURFACE] + speed * nx)
    w[W_STATE + Y] = y + ahead * p[P_FREE_Y] * (w[W_SURFACE + 1] + speed * ny / kappa)
    w[W_STATE + PHI] = phi + ahead * p[P_FREE_PHI] * (w[W_SURFACE + 2] + speed * nr / arm)
    set_contact(p, u, w, W_STATE)
    solve_direction(p, u, w, mean, 0.0, 0.0, 0.0)
    qx = speed * (w[W_STEADY] - nx) / ahead
    qy = speed * (w[W_STEADY + 1] - ny) / (kappa * ahead)
    qr = speed * (w[W_STEADY + 2] - nr) / (arm * ahead)
    w[W_STATE + TIME] = time
    w[W_STATE + X] = x
    w[W_STATE + Y] = y
    w[W_STATE + PHI] = phi
    set_contact(p, u, w, W_STATE)
    return solve_direction(p, u, w, mean, qx, qy, qr)


def sliding_energy(p: Floats, w: Floats) -> float:
    """Twice the kinetic energy of the sliding in ``w``, J."""
    ux = w[W_SLIDING]
    uy = w[W_SLIDING + 1]
    ur = w[W_SLIDING + 2]
    return p[P_MASS] * (ux * ux + uy * uy) + p[P_INERTIA] * ur * ur


def set_quasi_steady_motion(p: Floats, u: Floats, w: Floats, out: int) -> float:
    """Rates of the velocities in quasi-steady sliding, into ``w[out:]``, from the contact in ``w``.

    Puts the velocity with which the block really moves into ``w[W_STATE:]``, its friction and its
    sliding into ``w``. Returns what the surface's power differs by from friction times velocity, W:
    the stored velocity keeps its direction, and the surface's work is that on its momentum.
    """
    kappa = p[P_LATERAL]
    arm = kappa * p[P_RADIUS]
    m = p[P_MASS]
    j = p[P_INERTIA]
    ex = w[W_DIRECTION]
    ey = w[W_DIRECTION + 1] / kappa
    er = w[W_DIRECTION + 2] / arm
    root = sqrt(sliding_inertia(p, w, W_DIRECTION))
    ux = w[W_SLIDING]
    uy = w[W_SLIDING + 1]
    ur = w[W_SLIDING + 2]
    sigma = (m * (ux * ex + uy * ey) + j * ur * er) / root
    set_steady_direction(p, u, w, sigma)
    nx = w[W_STEADY]
    ny = w[W_STEADY + 1] / kappa
    nr = w[W_STEADY + 2] / arm
    root_n = sqrt(sliding_inertia(p, w, W_STEADY))
    speed = sigma / root_n
    w[W_STATE + VX] = w[W_SURFACE] + speed * nx
    w[W_STATE + VY] = w[W_SURFACE + 1] + speed * ny
    w[W_STATE + OMEGA] = w[W_SURFACE + 2] + speed * nr
    set_contact(p, u, w, W_STATE)
    if speed > 0.0:
        sy = speed * w[W_STEADY + 1]
        friction_in_slip(p, u, w, speed * nx, sy, speed * w[W_STEADY + 2])
    else:
        friction_at_onset(p, u, w, nx, w[W_STEADY + 1], w[W_STEADY + 2], 0.0)
        w[W_MEAN_SPEED] = 0.0
    fx = w[W_LOAD] + w[W_FRICTION] - m * w[W_SURFACE + 3]
    fy = w[W_LOAD + 1] + w[W_FRICTION + 1] - m * w[W_SURFACE + 4]
    fr = w[W_LOAD + 2] + w[W_FRICTION + 2] - j * w[W_SURFACE + 5]
    rate = (nx * fx + ny * fy + nr * fr) / (root_n * root)
    w[out + VX - 1] = w[W_SURFACE + 3] + rate * ex
    w[out + VY - 1] = p[P_FREE_Y] * (w[W_SURFACE + 4] + rate * ey)
    w[out + OMEGA - 1] = p[P_FREE_PHI] * (w[W_SURFACE + 5] + rate * er)
    power = w[W_SURFACE] * (m * rate * ex - fx) + w[W_SURFACE + 1] * (m * rate * ey - fy)
    power += w[W_SURFACE + 2] * (j * rate * er - fr)
    power += m * w[W_SURFACE + 3] * (ux - w[W_SLIDING])
    power += m * w[W_SURFACE + 4] * (uy - w[W_SLIDING + 1])
    power += j * w[W_SURFACE + 5] * (ur - w[W_SLIDING + 2])
    return power


def slides_quasi_steadily(p: Floats, u: Floats, w: Floats, before: float) -> bool:
    """Does the slip at the instant in ``w``, with its contact and direction, slide quasi-steadily?

    ``before`` is 1 where it has done so; then it may be twice as fast, so that it does not
    change back and forth. Leaves the direction in ``w[W_STEADY:]``.
    """
    speed = scaled_sliding_speed(w)
    if speed > (1.0 + before) * QUASI_STEADY_SPEED * speed_scale(p, u):
        return False
    a = set_steady_direction(p, u, w, sqrt(sliding_energy(p, w)))
    grip = onset_coefficient(p, u, w) * p[P_NORMAL_FORCE] / sliding_inertia(p, w, W_STEADY)
    if abs(a) > (1.0 + before) * QUASI_STEADY_ACCELERATION * grip:
        return False
    if before == 1.0 or speed <= rest_speed(p, u):
        return True
    along = 0.0
    for i in range(3):
        along += w[W_SCALED + i] * w[W_STEADY + i]
    return along > 0.999 * speed


def may_slide_quasi_steadily(p: Floats, u: Floats, w: Floats) -> bool:
    """Is the acceleration along the sliding small enough for that? From the slopes in ``w``.

    A cheap look that spares ordinary slips the search for the direction.
    """
    kappa = p[P_LATERAL]
    arm = kappa * p[P_RADIUS]
    dx = w[W_DIRECTION]
    dy = w[W_DIRECTION + 1]
    dr = w[W_DIRECTION + 2]
    speed = scaled_sliding_speed(w)
    if speed > QUASI_STEADY_SPEED * speed_scale(p, u):
        return False
    if speed > rest_speed(p, u):
        dx = w[W_SCALED] / speed
        dy = w[W_SCALED + 1] / speed
        dr = w[W_SCALED + 2] / speed
    rate = dx * (w[W_SLOPES + VX - 1] - w[W_SURFACE + 3])
    rate += dy * kappa * (w[W_SLOPES + VY - 1] - w[W_SURFACE + 4])
    rate += dr * arm * (w[W_SLOPES + OMEGA - 1] - w[W_SURFACE + 5])
    limit = onset_coefficient(p, u, w) * p[P_NORMAL_FORCE]
    return abs(rate) < 10.0 * QUASI_STEADY_ACCELERATION * limit / p[P_MASS]


def turn_to_steady_direction(p: Floats, w: Floats) -> None:
    """Turn the velocities in ``w[W_STATE:]`` to ``w[W_STEADY:]``, at the same energy of sliding."""
    kappa = p[P_LATERAL]
    speed = sqrt(sliding_energy(p, w) / sliding_inertia(p, w, W_STEADY))
    w[W_STATE + VX] = w[W_SURFACE] + speed * w[W_STEADY]
    w[W_STATE + VY] = w[W_SURFACE + 1] + speed * w[W_STEADY + 1] / kappa
    turning = speed * w[W_STEADY + 2] / (kappa * p[P_RADIUS])
    w[W_STATE + OMEGA] = w[W_SURFACE + 2] + turning
