"""What the inputs are at a time, and how the surface moves by them: a belt, or a turning slab.

Inputs are constant during a call of `advance`, or go on in time. A host gives them at its
communication points. What they are in between is a matter of the parameter `input.hold`, and of the
rates that it may give with them: see `lead_inputs`.

Where a host gives the rate of the surface's speed at every point, the speed is quadratic in time:
the acceleration, which decides when a stick ends, is then right to h^2, see `curve_of`.

An event may end a step before the host's own end of it. Such a point may lie a moment behind the
last one or before the next, so nothing is divided by its distance from them: slopes are those
between *regular* points, the ends that a host asks for. Inputs that go on linearly keep to their
way up to there, whatever the host says at the event: a surface whose acceleration changes just
where a block breaks away would make it stick again. Inputs that are held jump there as anywhere.
"""

from ..layout import *
from ..terms import with_surface_acceleration, with_surface_speed

# Of a step: by how much what is left of it behind an event may miss its end, as a host rounds.
ROUNDING = 1e-9


def input_at(u: Floats, i: int, t: float) -> float:
    """Input i at the time t; of the surface's speed see `driven_speed`."""
    return u[i] + u[U_RATE + i] * (t - u[U_SINCE])


def driven_speed(u: Floats, t: float) -> float:
    """Speed that the surface is driven with, after its ramp, m/s."""
    since = t - u[U_SINCE]
    return u[U_SPEED] + (u[U_RATE + U_SPEED] + 0.5 * u[U_SPEED_CURVE] * since) * since


def driven_acceleration(u: Floats, t: float) -> float:
    """Rate of `driven_speed`, m/s^2."""
    return u[U_RATE + U_SPEED] + u[U_SPEED_CURVE] * (t - u[U_SINCE])


def varies(u: Floats) -> bool:
    """Does any input go on in time?"""
    for i in range(GIVEN_INPUTS):
        if u[U_RATE + i] != 0.0:
            return True
    return u[U_SPEED_CURVE] != 0.0


def is_mean(i: int) -> bool:
    """Is input i constant in a step: half way to what it becomes?"""
    return i == U_TEMPERATURE or i == U_FILM


def is_due(g: Floats, end: float) -> bool:
    """Does a step up to the time `end` reach the next regular point, s?"""
    return end >= g[G_POINT] + g[G_STEP] * (1.0 - ROUNDING)


def is_overdue(g: Floats, end: float) -> bool:
    """Does it go beyond that?"""
    return end > g[G_POINT] + g[G_STEP] * (1.0 + ROUNDING)


def is_heard(g: Floats, i: int, end: float) -> bool:
    """Does what the host says of input i count in the step up to the time `end`?

    At a regular point it does: a value that stays is one that does not change. At an event one that
    has changed does, if it is held, or if the step is more than the rest of the one cut short.
    """
    if g[G_CUT] == 0.0 or g[G_HAS_RATE + i] == 1.0:
        return True
    if g[G_VALUE + i] == g[G_LAST + i]:
        return False
    return g[G_FIRST] == 0.0 or is_overdue(g, end)


def slope_of(g: Floats, i: int, t: float) -> float:
    """Rate with which what the host says of input i goes on from the time t, per s.

    That between the last two regular points, of which this may be one. An event keeps it.
    """
    if g[G_HAS_RATE + i] == 1.0:
        return g[G_RATE + i]
    if g[G_CUT] == 1.0:
        return g[G_SLOPE + i]
    if g[G_FIRST] == 1.0 and g[G_STEP] > 0.0:
        return (g[G_VALUE + i] - g[G_BEFORE + i]) / (t - g[G_POINT])
    return 0.0


def curve_of(g: Floats, t: float) -> float:
    """Rate of the rate of the surface's speed from the regular point at t on, m/s^3.

    From rates at this point and the last one; not more than the value here has come of it, so that
    a speed that is linear between the points stays so. 0 where the rates are not known.
    """
    h = t - g[G_POINT]
    if g[G_HAD_RATE] == 0.0 or g[G_HAS_RATE + U_SPEED] == 0.0 or h <= 0.0:
        return 0.0
    by_rates = (g[G_RATE + U_SPEED] - g[G_RATE_BEFORE]) / h
    by_value = g[G_VALUE + U_SPEED] - g[G_BEFORE + U_SPEED] - g[G_RATE_BEFORE] * h
    by_value = 2.0 * by_value / (h * h)
    if by_rates * by_value <= 0.0:
        return 0.0
    if abs(by_value) < abs(by_rates):
        return by_value
    return by_rates


def curve(g: Floats, i: int) -> float:
    """Rate of the rate with which input i goes on, per s^2."""
    if i == U_SPEED:
        return g[G_CURVE]
    return 0.0


def goes_on(g: Floats, i: int, sticks: bool) -> bool:
    """Does input i, of which something is heard, set out from where the last step has left it,
    rather than jump?

    A surface's speed that is given in steps stands for one that changes between them: a block that
    sticks could not follow a jump, and would seem to slip at every one.
    """
    if g[G_STEP] == 0.0:
        return False
    if sticks and i == U_SPEED:
        return True
    return g[G_HAS_RATE + i] == 1.0 or g[G_FIRST] == 1.0


def lead_anew(g: Floats, u: Floats, i: int, start: float, line: float, h: float) -> None:
    """Lead input i, in a step of size h, from ``start`` to where the line of what the host says is
    at its end; from an event on not faster than over a whole step."""
    span = h
    if g[G_CUT] == 1.0:
        span = max(h, g[G_STEP])
    half = 0.5 * curve(g, i)
    end = line + (g[G_SLOPE + i] + half * span) * span
    g[G_GOING + i] = (end - start) / span - half * span
    g[G_REACHED + i] = end
    if span > h:
        g[G_REACHED + i] = start + (g[G_GOING + i] + half * h) * h
    u[i] = start
    if is_mean(i):
        u[i] = line + 0.5 * g[G_SLOPE + i] * h


def keep_on(g: Floats, u: Floats, i: int, h: float) -> None:
    """Let input i go on, in a step of size h, as it has before the event."""
    if is_mean(i):
        return  # the mean of the whole step, up to its end
    u[i] = g[G_REACHED + i]
    g[G_REACHED + i] = u[i] + (g[G_GOING + i] + 0.5 * curve(g, i) * h) * h


def lead_input(g: Floats, u: Floats, i: int, sticks: bool, t: float, h: float) -> None:
    """Input i during the step of size h from the time t: where it begins, into ``u``, and its rate,
    into ``g``."""
    line = g[G_VALUE + i]
    since = t - u[U_SINCE]
    passed = (g[G_SLOPE + i] - 0.5 * curve(g, i) * since) * since  # the slope is that at its end
    g[G_SLOPE + i] = slope_of(g, i, t)
    start = g[G_REACHED + i]
    if is_heard(g, i, t + h):
        if not goes_on(g, i, sticks):
            start = line
        lead_anew(g, u, i, start, line, h)
        g[G_LAST + i] = line
    else:
        line = g[G_LINE + i] + passed
        if is_overdue(g, t + h):
            lead_anew(g, u, i, start, line, h)
        else:
            keep_on(g, u, i, h)
    g[G_LINE + i] = line


def lead_inputs(g: Floats, u: Floats, sticks: bool, t: float, h: float) -> None:
    """Inputs during the step of size ``h`` from the time ``t``, into ``u``, of those in ``g``.

    The error of an input that is smooth in time is of the order h where it is held, h^2 where it
    goes on linearly, h^3 where it has a
    curve, whether or not events cut steps. Temperature and film are constant in a step:
    half way to what they become.
    """
    if g[G_CUT] == 0.0:
        g[G_CURVE] = curve_of(g, t)
        g[G_HAD_RATE] = g[G_HAS_RATE + U_SPEED]
        g[G_RATE_BEFORE] = g[G_RATE + U_SPEED]
    for i in range(GIVEN_INPUTS):
        lead_input(g, u, i, sticks, t, h)
        if g[G_CUT] == 0.0:
            g[G_BEFORE + i] = g[G_VALUE + i]
        g[G_HAS_RATE + i] = 0.0
        if not is_mean(i):
            u[U_RATE + i] = g[G_GOING + i]
    u[U_SINCE] = t
    u[U_SPEED_CURVE] = g[G_CURVE]
    if g[G_CUT] == 0.0:
        g[G_POINT] = t
        g[G_STEP] = h
    elif is_due(g, t + h):
        g[G_CUT] = 0.0


def cut_inputs(g: Floats, u: Floats, t: float) -> None:
    """Note in ``g`` that the step which `lead_inputs` has prepared has ended early, at ``t``."""
    for i in range(3):
        g[G_REACHED + U_FORCE_X + i] = input_at(u, U_FORCE_X + i, t)
    g[G_REACHED + U_SPEED] = driven_speed(u, t)
    g[G_GOING + U_SPEED] = driven_acceleration(u, t)
    g[G_SLOPE + U_SPEED] += g[G_CURVE] * (t - u[U_SINCE])
    g[G_CUT] = 1.0


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
