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


def solve_direction(p: Floats, u: Floats, w: Floats, speed: float) -> float:
    """Direction n under the loads in ``w``, into ``w[W_STEADY:]``; returns a, m/s^2.

    ``speed`` is the mean local sliding speed, ``w[W_TURNING:]`` is s n', in the velocities of the
    block. The search ends where a comes to a tenth of
    what friction gives: that is not quasi-steady.
    """
    set_holding_load(p, w)
    for i in range(3):
        w[W_HELD + i] = w[W_FRICTION + i] + p[P_FREE + i] * p[P_MASS + i] * w[W_TURNING + i]
        w[W_BEFORE + i] = w[W_DIRECTION + i]
    limit = slow_coefficient(p, u, w, speed) * p[P_NORMAL_FORCE]
    a = 0.0
    more = limit / p[P_MASS]
    sweep = 0
    while abs(more) > 1e-12 * limit / p[P_MASS] and abs(a) < 0.1 * limit / p[P_MASS] and sweep < 20:
        for i in range(3):
            w[W_FRICTION + i] = w[W_HELD + i]
            if sweep > 0:
                turned = a * p[P_FREE + i] * p[P_MASS + i] * w[W_DIRECTION + i]
                w[W_FRICTION + i] += turned / p[P_SCALES + i]
        more = set_yielding_motion(p, limit, w)
        a += more
        sweep += 1
    for i in range(3):
        w[W_STEADY + i] = w[W_DIRECTION + i]
        w[W_DIRECTION + i] = w[W_BEFORE + i]
    return a


def set_steady_direction(p: Floats, u: Floats, w: Floats, sigma: float) -> float:
    """Direction n of quasi-steady sliding at the instant in ``w``; returns a, m/s^2.

    n goes into ``w[W_STEADY:]``.
    """
    for i in range(3):
        w[W_TURNING + i] = 0.0
    a = solve_direction(p, u, w, 0.0)
    speed = sigma / sqrt(sliding_inertia(p, w, W_STEADY))
    if speed <= 0.0:
        return a
    mean = 0.0
    if feels_slow_speed(p):  # what the contact holds is known once its speed is
        mean = speed * mean_part(w)
        a = solve_direction(p, u, w, mean)
    ahead = LOOK_AHEAD / p[P_RATE]
    for i in range(4):
        w[W_PLACE + i] = w[W_STATE + TIME + i]
    w[W_STATE + TIME] += ahead
    for i in range(3):
        w[W_RATES + i] = w[W_STEADY + i]
        velocity = w[W_SURFACE + i] + speed * w[W_STEADY + i] / p[P_SCALES + i]
        w[W_STATE + X + i] += ahead * p[P_FREE + i] * velocity
    set_contact(p, u, w, W_STATE)
    solve_direction(p, u, w, mean)
    for i in range(3):
        change = speed * (w[W_STEADY + i] - w[W_RATES + i])
        w[W_TURNING + i] = change / (p[P_SCALES + i] * ahead)
    for i in range(4):
        w[W_STATE + TIME + i] = w[W_PLACE + i]
    set_contact(p, u, w, W_STATE)
    return solve_direction(p, u, w, mean)


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
    root = sqrt(sliding_inertia(p, w, W_DIRECTION))
    ey = w[W_DIRECTION + 1] / p[P_SCALES + 1]
    er = w[W_DIRECTION + 2] / p[P_SCALES + 2]
    along = p[P_MASS] * (w[W_SLIDING] * w[W_DIRECTION] + w[W_SLIDING + 1] * ey)
    sigma = (along + p[P_INERTIA] * w[W_SLIDING + 2] * er) / root
    for i in range(3):
        w[W_STORED + i] = w[W_SLIDING + i]
    set_steady_direction(p, u, w, sigma)
    root_n = sqrt(sliding_inertia(p, w, W_STEADY))
    speed = sigma / root_n
    for i in range(3):
        sliding = speed * (w[W_STEADY + i] / p[P_SCALES + i])
        w[W_STATE + VX + i] = w[W_SURFACE + i] + sliding
    set_contact(p, u, w, W_STATE)
    if speed > 0.0:
        sx = speed * w[W_STEADY]
        friction_in_slip(p, u, w, sx, speed * w[W_STEADY + 1], speed * w[W_STEADY + 2])
    else:
        friction_at_onset(p, u, w, w[W_STEADY], w[W_STEADY + 1], w[W_STEADY + 2], 0.0)
        w[W_MEAN_SPEED] = 0.0
    rate = 0.0
    for i in range(3):
        carried = p[P_MASS + i] * w[W_SURFACE + 3 + i]
        w[W_HELD + i] = w[W_LOAD + i] + w[W_FRICTION + i] - carried
        rate += w[W_STEADY + i] / p[P_SCALES + i] * w[W_HELD + i]
    rate /= root_n * root
    power = 0.0
    for i in range(3):
        e = w[W_DIRECTION + i] / p[P_SCALES + i]
        w[out + VX - 1 + i] = p[P_FREE + i] * (w[W_SURFACE + 3 + i] + rate * e)
        power += w[W_SURFACE + i] * (p[P_MASS + i] * rate * e - w[W_HELD + i])
    for i in range(3):
        slower = w[W_STORED + i] - w[W_SLIDING + i]
        power += p[P_MASS + i] * w[W_SURFACE + 3 + i] * slower
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
    grip = onset_coefficient(p, u, w) * p[P_NORMAL_FORCE]
    grip /= sliding_inertia(p, w, W_STEADY)
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
    speed = scaled_sliding_speed(w)
    if speed > QUASI_STEADY_SPEED * speed_scale(p, u):
        return False
    moves = speed > rest_speed(p, u)
    rate = 0.0
    for i in range(3):
        along = w[W_DIRECTION + i]
        if moves:
            along = w[W_SCALED + i] / speed
        rate += along * p[P_SCALES + i] * (w[W_SLOPES + VX - 1 + i] - w[W_SURFACE + 3 + i])
    limit = onset_coefficient(p, u, w) * p[P_NORMAL_FORCE]
    return abs(rate) < 10.0 * QUASI_STEADY_ACCELERATION * limit / p[P_MASS]


def turn_to_steady_direction(p: Floats, w: Floats) -> None:
    """Turn the velocities in ``w[W_STATE:]`` to ``w[W_STEADY:]``, at the same energy of sliding."""
    speed = sqrt(sliding_energy(p, w) / sliding_inertia(p, w, W_STEADY))
    for i in range(3):
        sliding = speed * w[W_STEADY + i] / p[P_SCALES + i]
        w[W_STATE + VX + i] = w[W_SURFACE + i] + sliding
