"""One explicit Runge-Kutta step with an error estimate (tableau: ``dormand_prince.toml``)."""

from math import sqrt

from .bristles.law import has_bristles
from .contact import speed_scale
from .layout import *
from .motion import set_slopes
from .rig.drive import set_surface_phase
from .stick import held_energy, set_stick_velocity
from .terms import with_state_scale


def load_instant(p: Floats, z: Floats, w: Floats, instant: int) -> None:
    """Make an instant in ``z`` the instant that the laws of motion look at."""
    for i in range(INSTANT):
        w[W_STATE + i] = z[instant + i]
    for i in range(3):
        w[W_DIRECTION + i] = z[instant + DIRECTION + i]
    set_surface_phase(p, w, z[instant + TIME])


def begin_step(p: Floats, u: Floats, z: Floats, w: Floats, start: int) -> None:
    """First stage of the step from instant ``start``; every size tried from there shares it."""
    load_instant(p, z, w, start)
    set_slopes(p, u, w, z[start + MODE], W_SLOPES)


def state_scale(p: Floats, u: Floats, i: int, value: float) -> float:
    """Error of state i that counts as 1 in the error test, in the unit of the state."""
    speed = speed_scale(p, u)
    length = speed / p[P_RATE]
    scale = p[P_MASS] * speed * speed  # works, heat, and states of effects that say nothing else
    if i == X or i == Y or i == DISTANCE or i == TRAVEL or MOVING < i <= SHEARED:
        scale = length
    elif i == PHI:
        scale = length / p[P_RADIUS]
    elif i == VX or i == VY:
        scale = speed
    elif i == OMEGA:
        scale = speed / p[P_RADIUS]
    elif i == HEAT:
        return p[P_TOLERANCE] * scale  # it only grows, and the ledger counts every part
    else:
        scale = with_state_scale(p, i, scale, speed)
    return p[P_TOLERANCE] * (scale + abs(value))


def add_stage(p: Floats, u: Floats, z: Floats, w: Floats, start: int, stage: int) -> None:
    """Slopes of one stage of the step of size ``w[W_SPAN]`` from instant ``start``.

    Numbers that the slopes do not depend on, heat and works for instance, keep their value at the
    start.
    """
    h = w[W_SPAN]
    row = stage * ALL_STAGES
    w[W_STATE + TIME] = z[start + TIME] + h * NODES[stage]
    feeding = int(p[P_FEEDING])
    for i in range(feeding):
        w[W_STATE + 1 + i] = z[start + 1 + i]
    for before in range(stage):
        weight = h * STAGE_WEIGHTS[row + before]
        if weight != 0.0:
            for i in range(feeding):
                w[W_STATE + 1 + i] += weight * w[W_SLOPES + before * STATES + i]
    set_slopes(p, u, w, z[start + MODE], W_SLOPES + stage * STATES)


def take_step(p: Floats, u: Floats, z: Floats, w: Floats, start: int, end: int, h: float) -> float:
    """Step of size h from instant ``start`` (see `begin_step`) to instant ``end``.

    Returns the scaled error estimate: the step is good where it is at most 1.
    """
    mode = z[start + MODE]
    w[W_SPAN] = h
    for stage in range(1, STAGES):
        add_stage(p, u, z, w, start, stage)
    for i in range(TIME, INSTANT):
        z[end + i] = z[start + i]
    z[end + TIME] = z[start + TIME] + h
    if mode == SLIP:
        z[end + SLIP_TIME] += h
    error = close_step(p, u, z, w, end, h)
    if mode == STICK and not has_bristles(p):
        finish_stick(p, u, z, w, start, end)
    return error


def close_step(p: Floats, u: Floats, z: Floats, w: Floats, end: int, h: float) -> float:
    """Add the weighted slopes to instant ``end``; the error norm is that of DOP853."""
    error5 = 0.0
    error3 = 0.0
    for i in range(STATES):
        slope = w[W_SLOPES + i]
        change = STAGE_WEIGHTS[END_OF_STEP] * slope
        e5 = ERROR_WEIGHTS_5[0] * slope
        e3 = ERROR_WEIGHTS_3[0] * slope
        for stage in range(LATE, STAGES):
            slope = w[W_SLOPES + stage * STATES + i]
            change += STAGE_WEIGHTS[END_OF_STEP + stage] * slope
            e5 += ERROR_WEIGHTS_5[stage] * slope
            e3 += ERROR_WEIGHTS_3[stage] * slope
        z[end + 1 + i] += h * change
        scale = state_scale(p, u, i + 1, z[end + 1 + i])
        error5 += (e5 / scale) * (e5 / scale)
        error3 += (e3 / scale) * (e3 / scale)
    bottom = error5 + 0.01 * error3
    if bottom == 0.0:
        return 0.0
    return abs(h) * error5 / sqrt(bottom * NORM)


def follow_surface(
    p: Floats, u: Floats, z: Floats, w: Floats, instant: int, presliding: float
) -> None:
    """Give the block the velocity with which it sticks exactly, where friction holds it.

    Takes ``presliding`` and leaves the contact as `set_stick_velocity` does.
    """
    for i in range(INSTANT):
        w[W_STATE + i] = z[instant + i]
    set_stick_velocity(p, u, w, presliding)
    for i in range(3):
        if p[P_SCALES + i] > 0.0:
            z[instant + VX + i] = w[W_STATE + VX + i]


def finish_stick(p: Floats, u: Floats, z: Floats, w: Floats, start: int, end: int) -> None:
    """Velocity of a stick at instant ``end``, and the surface's work on it since ``start``."""
    follow_surface(p, u, z, w, end, p[P_PRESLIDING])
    if p[P_PRESLIDING] != 0.0:
        z[end + WORK_SURFACE] += held_energy(p, z, end) - held_energy(p, z, start)
