"""The moving surface: a belt (translation) or a slab that turns about a centre at (0, R)."""

from __future__ import annotations

from .. import Floats
from ..layout import *
from ..terms import with_surface_acceleration, with_surface_speed
from .drive import driven_acceleration, driven_speed


def set_surface_phase(p: Floats, w: Floats, t: float) -> None:
    """Say whether the internal step that begins at t lies in the speed ramp or behind it.

    No internal step straddles the end of the speed ramp, so the phase belongs to the step and not
    to the time: the acceleration, which jumps there, is unambiguous at both ends of every step.
    """
    w[W_RUNNING_UP] = 0.0
    if t < p[P_RUN_UP]:
        w[W_RUNNING_UP] = 1.0


def steady_speed(p: Floats, u: Floats, w: Floats, t: float) -> float:
    """Speed of the surface without ripple, m/s: a linear speed ramp, then constant."""
    if w[W_RUNNING_UP] == 1.0:
        return driven_speed(u, t) * t / p[P_RUN_UP]
    return driven_speed(u, t)


def surface_speed(p: Floats, u: Floats, w: Floats, t: float) -> float:
    """Speed of the surface where the block rests, m/s."""
    return with_surface_speed(p, u, w, steady_speed(p, u, w, t), t)


def surface_acceleration(p: Floats, u: Floats, w: Floats, t: float) -> float:
    """Rate of `surface_speed`, m/s^2."""
    rate = driven_acceleration(u, t)
    if w[W_RUNNING_UP] == 1.0:
        rate = (driven_speed(u, t) + rate * t) / p[P_RUN_UP]
    return with_surface_acceleration(p, u, w, rate, steady_speed(p, u, w, t), t)


def surface_motion(p: Floats, u: Floats, w: Floats, state: int) -> None:
    """Motion of the surface under the block's centre, into ``w[W_SURFACE:]``.

    Three velocities and three accelerations (x, y, turning). With curvature c = 1/R the surface
    turns at v c about (0, R): v_s = (v (1 - c y), v c x). The accelerations are those of a block
    whose centre moves with (vx, vy) and keeps the velocity of the surface under it.
    """
    v = surface_speed(p, u, w, w[state + TIME])
    a = surface_acceleration(p, u, w, w[state + TIME])
    c = p[P_CURVATURE]
    w[W_SURFACE] = v * (1.0 - c * w[state + Y])
    w[W_SURFACE + 1] = v * c * w[state + X]
    w[W_SURFACE + 2] = v * c
    w[W_SURFACE + 3] = a * (1.0 - c * w[state + Y]) - v * c * w[state + VY]
    w[W_SURFACE + 4] = a * c * w[state + X] + v * c * w[state + VX]
    w[W_SURFACE + 5] = a * c
