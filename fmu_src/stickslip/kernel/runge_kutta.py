"""One explicit Runge-Kutta step with an error estimate (tableau in the parameter vector)."""

from math import sqrt

from .contact import set_sliding_velocity, speed_scale
from .layout import (
    AGE,
    ALL_STAGES,
    BLOCK,
    DIRECTION,
    DISTANCE,
    HEAT,
    LATE,
    MODE,
    OMEGA,
    P_FEEDING,
    P_FREE_PHI,
    P_FREE_Y,
    P_LATERAL,
    P_MASS,
    P_RADIUS,
    P_RATE,
    P_STATE_DISTANCE,
    P_TABLEAU,
    P_TOLERANCE,
    PHI,
    SLIP,
    SLIP_TIME,
    STAGES,
    STATES,
    STICK,
    T_A,
    T_B,
    T_C,
    T_E3,
    T_E5,
    TIME,
    TRAVEL,
    VX,
    VY,
    W_DIRECTION,
    W_SLOPES,
    W_SPAN,
    W_STATE,
    W_SURFACE,
    X,
    Y,
)
from .motion import set_slopes
from .surface import set_surface_phase, surface_motion


def load_block(p: "float[:]", z: "float[:]", w: "float[:]", block: int):
    """Make a block of ``z`` the moment that the laws of motion look at."""
    for i in range(BLOCK):
        w[W_STATE + i] = z[block + i]
    for i in range(3):
        w[W_DIRECTION + i] = z[block + DIRECTION + i]
    set_surface_phase(p, w, z[block + TIME])


def begin_step(p: "float[:]", u: "float[:]", z: "float[:]", w: "float[:]", start: int):
    """First stage of the step from block ``start``; every step size tried from there shares it."""
    load_block(p, z, w, start)
    set_slopes(p, u, w, z[start + MODE], W_SLOPES)


def state_scale(p: "float[:]", u: "float[:]", i: int, value: float) -> float:
    """Error of state i that counts as 1 in the error test, in the unit of the state."""
    speed = speed_scale(p, u)
    length = speed / p[P_RATE]
    scale = p[P_MASS] * speed * speed  # works and heat
    if i == X or i == Y or i == DISTANCE or i == TRAVEL:
        scale = length
    elif i == PHI:
        scale = length / p[P_RADIUS]
    elif i == VX or i == VY:
        scale = speed
    elif i == OMEGA:
        scale = speed / p[P_RADIUS]
    elif i == AGE:
        scale = p[P_STATE_DISTANCE] / speed
    elif i == HEAT:
        return p[P_TOLERANCE] * scale  # it only grows, and the ledger counts every part
    return p[P_TOLERANCE] * (scale + abs(value))


def add_stage(p: "float[:]", u: "float[:]", z: "float[:]", w: "float[:]", start: int, stage: int):
    """Slopes of one stage of the step of size ``w[W_SPAN]`` from block ``start``.

    Numbers that the slopes do not depend on, heat and works for instance, keep their value at the
    start.
    """
    h = w[W_SPAN]
    row = P_TABLEAU + T_A + stage * ALL_STAGES
    w[W_STATE + TIME] = z[start + TIME] + h * p[P_TABLEAU + T_C + stage]
    feeding = int(p[P_FEEDING])
    for i in range(feeding):
        w[W_STATE + 1 + i] = z[start + 1 + i]
    for before in range(stage):
        weight = h * p[row + before]
        if weight != 0.0:
            for i in range(feeding):
                w[W_STATE + 1 + i] += weight * w[W_SLOPES + before * STATES + i]
    set_slopes(p, u, w, z[start + MODE], W_SLOPES + stage * STATES)


def take_step(
    p: "float[:]", u: "float[:]", z: "float[:]", w: "float[:]", start: int, end: int, h: float
) -> float:
    """Step of size h from block ``start`` (see `begin_step`) to block ``end``.

    Returns the scaled error estimate: the step is good where it is at most 1.
    """
    mode = z[start + MODE]
    w[W_SPAN] = h
    for stage in range(1, STAGES):
        add_stage(p, u, z, w, start, stage)
    for i in range(TIME, BLOCK):
        z[end + i] = z[start + i]
    z[end + TIME] = z[start + TIME] + h
    if mode == SLIP:
        z[end + SLIP_TIME] += h
    error = close_step(p, u, z, w, end, h)
    if mode == STICK:
        follow_surface(p, u, z, w, end)
    return error


def close_step(
    p: "float[:]", u: "float[:]", z: "float[:]", w: "float[:]", end: int, h: float
) -> float:
    """Add the weighted slopes to block ``end``; the error norm is that of DOP853."""
    error5 = 0.0
    error3 = 0.0
    for i in range(STATES):
        slope = w[W_SLOPES + i]
        change = p[P_TABLEAU + T_B] * slope
        e5 = p[P_TABLEAU + T_E5] * slope
        e3 = p[P_TABLEAU + T_E3] * slope
        for stage in range(LATE, STAGES):
            slope = w[W_SLOPES + stage * STATES + i]
            change += p[P_TABLEAU + T_B + stage] * slope
            e5 += p[P_TABLEAU + T_E5 + stage] * slope
            e3 += p[P_TABLEAU + T_E3 + stage] * slope
        z[end + 1 + i] += h * change
        scale = state_scale(p, u, i + 1, z[end + 1 + i])
        error5 += (e5 / scale) * (e5 / scale)
        error3 += (e3 / scale) * (e3 / scale)
    bottom = error5 + 0.01 * error3
    if bottom == 0.0:
        return 0.0
    return abs(h) * error5 / sqrt(bottom * STATES)


def follow_surface(p: "float[:]", u: "float[:]", z: "float[:]", w: "float[:]", block: int):
    """Give the block the surface's velocity exactly, where friction holds it and it is free.

    Leaves the surface's motion and the sliding velocity at that moment in ``w``: zero, but for what
    guides keep from following.
    """
    for i in range(BLOCK):
        w[W_STATE + i] = z[block + i]
    surface_motion(p, u, w, W_STATE)
    z[block + VX] = w[W_SURFACE]
    w[W_STATE + VX] = w[W_SURFACE]
    if p[P_LATERAL] > 0.0:
        z[block + VY] = p[P_FREE_Y] * w[W_SURFACE + 1]
        z[block + OMEGA] = p[P_FREE_PHI] * w[W_SURFACE + 2]
        w[W_STATE + VY] = z[block + VY]
        w[W_STATE + OMEGA] = z[block + OMEGA]
    set_sliding_velocity(w, W_STATE)
