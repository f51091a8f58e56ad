"""What the inputs are at a time: constant during a call of `advance`, or linear in time.

A host gives inputs at its communication points. What they are in between is a matter of the
parameter `input.hold`, and of the rates that it may give with them: see `lead_inputs`.
"""

from __future__ import annotations

from .. import Floats
from ..layout import (
    G_BEFORE,
    G_FIRST,
    G_HAS_RATE,
    G_RATE,
    G_REACHED,
    G_SPAN,
    G_VALUE,
    GIVEN_INPUTS,
    U_FORCE_X,
    U_FORCE_X_RATE,
    U_FORCE_Y,
    U_FORCE_Y_RATE,
    U_MOMENT,
    U_MOMENT_RATE,
    U_SINCE,
    U_SPEED,
    U_SPEED_RATE,
)


def driven_speed(u: Floats, t: float) -> float:
    """Speed that the surface is driven with, after its ramp, m/s."""
    return u[U_SPEED] + u[U_SPEED_RATE] * (t - u[U_SINCE])


def force_along(u: Floats, t: float) -> float:
    """External force on the block along x, N."""
    return u[U_FORCE_X] + u[U_FORCE_X_RATE] * (t - u[U_SINCE])


def force_across(u: Floats, t: float) -> float:
    """External force on the block along y, N."""
    return u[U_FORCE_Y] + u[U_FORCE_Y_RATE] * (t - u[U_SINCE])


def external_moment(u: Floats, t: float) -> float:
    """External moment on the block, N m."""
    return u[U_MOMENT] + u[U_MOMENT_RATE] * (t - u[U_SINCE])


def varies(u: Floats) -> bool:
    """Does any input go on linearly in time?"""
    if u[U_SPEED_RATE] != 0.0 or u[U_MOMENT_RATE] != 0.0:
        return True
    return u[U_FORCE_X_RATE] != 0.0 or u[U_FORCE_Y_RATE] != 0.0


def end_value(g: Floats, i: int, h: float) -> float:
    """What input i will have become at the end of a step of size h, as far as anybody knows."""
    value = g[G_VALUE + i]
    if g[G_HAS_RATE + i] == 1.0:
        return value + g[G_RATE + i] * h
    if g[G_FIRST] == 1.0 and g[G_SPAN] > 0.0:
        return value + (value - g[G_BEFORE + i]) / g[G_SPAN] * h
    return value


def goes_on(g: Floats, i: int, sticks: bool) -> bool:
    """Does input i set out from where the last step has left it, rather than jump?

    A surface's speed that is given in steps stands for one that changes between them: a block that
    sticks could not follow a jump, and would seem to slip at every one.
    """
    if g[G_SPAN] == 0.0:
        return False
    if sticks and i == U_SPEED:
        return True
    return g[G_HAS_RATE + i] == 1.0 or g[G_FIRST] == 1.0


def lead_inputs(g: Floats, u: Floats, sticks: bool, t: float, h: float):
    """Inputs during the step of size ``h`` from the time ``t``, into ``u``, of those in ``g``.

    The error of an input that is smooth in time is of the order h where it is held, h^2 where it
    goes on linearly. Temperature and film are constant in a step: half way to what they become.
    """
    u[U_SINCE] = t
    for i in range(GIVEN_INPUTS):
        start = g[G_VALUE + i]
        if goes_on(g, i, sticks):
            start = g[G_REACHED + i]
        end = end_value(g, i, h)
        u[i] = start
        if i == U_SPEED:
            u[U_SPEED_RATE] = (end - start) / h
        elif i == U_FORCE_X:
            u[U_FORCE_X_RATE] = (end - start) / h
        elif i == U_FORCE_Y:
            u[U_FORCE_Y_RATE] = (end - start) / h
        elif i == U_MOMENT:
            u[U_MOMENT_RATE] = (end - start) / h
        else:
            u[i] = 0.5 * (g[G_VALUE + i] + end)
        g[G_REACHED + i] = end
        g[G_BEFORE + i] = g[G_VALUE + i]
        g[G_HAS_RATE + i] = 0.0
    g[G_SPAN] = h


def cut_inputs(g: Floats, u: Floats, t: float):
    """Note in ``g`` that the step which `lead_inputs` has prepared has ended early, at ``t``."""
    g[G_REACHED + U_SPEED] = driven_speed(u, t)
    g[G_REACHED + U_FORCE_X] = force_along(u, t)
    g[G_REACHED + U_FORCE_Y] = force_across(u, t)
    g[G_REACHED + U_MOMENT] = external_moment(u, t)
    g[G_SPAN] = t - u[U_SINCE]
