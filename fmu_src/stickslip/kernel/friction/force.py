"""Friction on a contact that slides.

One formula serves friction along x and friction along the local velocity. With the ratio kappa
(`P_LATERAL`) the contact feels the scaled sliding velocity (U_x, kappa U_y, kappa Omega) and
answers with (F_x, kappa F_y, kappa M): at kappa = 1 the isotropic disc, at kappa = 0 a force
along x alone. The scaling is that of an elliptic dissipation potential, so friction opposes the
motion for every kappa.
"""

from math import sqrt

from ..layout import *
from ..terms import with_contact_drag
from .coefficient import (
    kinetic_coefficient,
    set_excess,
    sliding_coefficient,
    slow_coefficient,
    state_coefficient,
)
from .disc import add_local_law, disc_friction


def set_friction(p: Floats, w: Floats, sx: float, sy: float, sr: float, sliding: float) -> None:
    """Friction from the coefficients in ``w[W_PAIR:]`` (force, moment), into ``w[W_FRICTION:]``.

    (sx, sy, sr) is the scaled sliding velocity, of which only the direction counts here;
    ``sliding`` is the length of (sx, sy).
    """
    moment = p[P_NORMAL_FORCE] * w[W_PAIR + 1] * p[P_LATERAL] * p[P_RADIUS]
    w[W_FRICTION] = 0.0
    w[W_FRICTION + 1] = 0.0
    w[W_FRICTION + 2] = 0.0
    if sliding > 0.0:
        drag = p[P_NORMAL_FORCE] * w[W_PAIR] / sliding
        w[W_FRICTION] = -drag * sx
        w[W_FRICTION + 1] = -drag * p[P_LATERAL] * sy
    if sr > 0.0:
        w[W_FRICTION + 2] = -moment
    elif sr < 0.0:
        w[W_FRICTION + 2] = moment


def friction_at_onset(
    p: Floats, u: Floats, w: Floats, sx: float, sy: float, sr: float, speed: float
) -> None:
    """Friction against a slip that has a direction, but next to no ``speed`` (m/s) yet.

    (sx, sy, sr) is the direction. Writes force and moment to ``w[W_FRICTION:]``.
    """
    sliding = sqrt(sx * sx + sy * sy)
    disc_friction(sliding, abs(sr), w)
    mu = slow_coefficient(p, u, w, speed * (w[W_PAIR] * sliding + w[W_PAIR + 1] * abs(sr)))
    w[W_PAIR] *= mu
    w[W_PAIR + 1] *= mu
    set_friction(p, w, sx, sy, sr, sliding)


def set_sliding_coefficients(
    p: Floats, u: Floats, w: Floats, sx: float, sy: float, sr: float
) -> None:
    """Force and moment per normal force (and radius) against a sliding, into ``w[W_PAIR:]``.

    (sx, sy, sr) is the scaled sliding velocity; sr is a rim speed. The mean local sliding speed
    (m/s) goes to ``w[W_MEAN_SPEED]``. Where friction depends on the local speed, the closed form
    takes its value at the mean speed and a quadrature adds what differs from that. The age of the
    contact (rate_and_state) belongs to the whole of it and goes with the mean speed. No point of
    the disc slides more slowly than its centre less the rim speed: mu_s is not felt beyond that.
    """
    mu = kinetic_coefficient(p, u, w)
    sliding = sqrt(sx * sx + sy * sy)
    disc_friction(sliding, abs(sr), w)
    mean_speed = w[W_PAIR] * sliding + w[W_PAIR + 1] * abs(sr)
    w[W_MEAN_SPEED] = mean_speed
    reference = mu
    slowest = max(0.0, sliding - abs(sr))
    is_local = p[P_LOCAL_LAW] == 1.0 or slowest < p[P_TRANSITION_END]
    if is_local:
        set_excess(p, u, w, mu)
        reference = sliding_coefficient(p, u, w, mu, mean_speed)
    aged = state_coefficient(p, u, w, mean_speed)
    whole = max(0.0, reference + aged)
    w[W_PAIR] *= whole
    w[W_PAIR + 1] *= whole
    if is_local and sr != 0.0:
        w[W_KINETIC] = mu
        w[W_AGED] = aged
        w[W_WHOLE] = whole
        add_local_law(p, u, w, sliding, abs(sr))


def add_contact_drag(p: Floats, w: Floats, sx: float, sy: float, sr: float) -> None:
    """Add the drag of a film to ``w[W_FRICTION:]``."""
    drag = with_contact_drag(p, 0.0)
    if drag != 0.0:
        kappa = p[P_LATERAL]
        w[W_FRICTION] -= drag * sx
        w[W_FRICTION + 1] -= drag * kappa * sy
        # a uniform film: the mean of r^2 over the disc is a^2/2
        w[W_FRICTION + 2] -= drag * kappa * 0.5 * p[P_RADIUS] * sr


def friction_in_slip(p: Floats, u: Floats, w: Floats, sx: float, sy: float, sr: float) -> None:
    """Friction against the scaled sliding velocity (sx, sy, sr), not zero; sr is a rim speed.

    Writes force and moment on the block to ``w[W_FRICTION:]`` (N, N, N m) and the mean local
    sliding speed to ``w[W_MEAN_SPEED]`` (m/s).
    """
    set_sliding_coefficients(p, u, w, sx, sy, sr)
    set_friction(p, w, sx, sy, sr, sqrt(sx * sx + sy * sy))
    add_contact_drag(p, w, sx, sy, sr)
