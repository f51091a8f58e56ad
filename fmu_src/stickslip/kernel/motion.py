"""Equations of motion: slopes of the integrated state in stick and in slip."""

from .coefficient import ageing_rate
from .contact import rest_speed, scaled_sliding_speed, set_contact, set_holding_load
from .creep import set_creeping_motion
from .friction import friction_at_onset, friction_in_slip
from .layout import (
    AGE,
    CREEPING,
    DAMPED,
    DISTANCE,
    HEAT,
    OMEGA,
    P_FREE_PHI,
    P_FREE_Y,
    P_INERTIA,
    P_LATERAL,
    P_MASS,
    P_RADIUS,
    P_RELAXATION,
    P_STICK_CREEP,
    P_WEAKENING,
    PHI,
    SLIP,
    STICK,
    TIME,
    TRAVEL,
    U_FORCE_X,
    U_FORCE_Y,
    U_MOMENT,
    VX,
    VY,
    W_DIRECTION,
    W_FRICTION,
    W_LOAD,
    W_MEAN_SPEED,
    W_SLIDING,
    W_STATE,
    W_SURFACE,
    WARMTH,
    WORK_EXTERNAL,
    WORK_SURFACE,
    X,
    Y,
)
from .springs import damping_power, elastic_energy
from .stick import set_creeping_stick
from .surface import surface_speed


def set_slip_friction(p: "float[:]", u: "float[:]", w: "float[:]"):
    """Kinetic friction into ``w[W_FRICTION:]``.

    Where the sliding velocity is too small to have a direction, at the first instant of a slip,
    the direction is the one of `set_onset_direction`.
    """
    if scaled_sliding_speed(p, w) > rest_speed(p, u):
        sx = w[W_SLIDING]
        sy = p[P_LATERAL] * w[W_SLIDING + 1]
        sr = p[P_LATERAL] * p[P_RADIUS] * w[W_SLIDING + 2]
        friction_in_slip(p, u, w, sx, sy, sr)
    else:
        speed = scaled_sliding_speed(p, w)
        friction_at_onset(p, u, w, w[W_DIRECTION], w[W_DIRECTION + 1], w[W_DIRECTION + 2], speed)
        w[W_MEAN_SPEED] = speed


def set_motion(p: "float[:]", u: "float[:]", w: "float[:]", mode: float, out: int) -> float:
    """Rates of x, y, phi and of their velocities at ``w[W_STATE:]``, into ``w[out:]``.

    Returns power of the surface beyond that of friction, W: 0 but in creep, of either kind.
    """
    if mode == STICK and p[P_STICK_CREEP] != 0.0:
        power = set_creeping_stick(p, u, w)
        set_rates(p, w, out)
        return power
    set_contact(p, u, w, W_STATE)
    if mode == SLIP and w[W_STATE + CREEPING] == 1.0:
        power = set_creeping_motion(p, u, w, out)
        set_rates_of_place(p, w, out)
        return power
    if mode == SLIP:
        set_slip_friction(p, u, w)
    else:
        set_holding_load(p, w)
        w[W_MEAN_SPEED] = 0.0
        w[W_STATE + VX] = w[W_SURFACE]
        if p[P_LATERAL] > 0.0:
            w[W_STATE + VY] = p[P_FREE_Y] * w[W_SURFACE + 1]
            w[W_STATE + OMEGA] = p[P_FREE_PHI] * w[W_SURFACE + 2]
    set_rates(p, w, out)
    return 0.0


def set_rates(p: "float[:]", w: "float[:]", out: int):
    """Rates of x, y, phi and of their velocities, into ``w[out:]``, from loads and friction."""
    set_rates_of_place(p, w, out)
    w[out + VX - 1] = (w[W_LOAD] + w[W_FRICTION]) / p[P_MASS]
    w[out + VY - 1] = p[P_FREE_Y] * (w[W_LOAD + 1] + w[W_FRICTION + 1]) / p[P_MASS]
    w[out + OMEGA - 1] = p[P_FREE_PHI] * (w[W_LOAD + 2] + w[W_FRICTION + 2]) / p[P_INERTIA]


def set_rates_of_place(p: "float[:]", w: "float[:]", out: int):
    """Rates of x, y, phi, into ``w[out:]``: the velocities, where the block is free."""
    w[out + X - 1] = w[W_STATE + VX]
    w[out + Y - 1] = p[P_FREE_Y] * w[W_STATE + VY]
    w[out + PHI - 1] = p[P_FREE_PHI] * w[W_STATE + OMEGA]


def set_slopes(p: "float[:]", u: "float[:]", w: "float[:]", mode: float, out: int):
    """All slopes at the moment in ``w[W_STATE:]``, into ``w[out:]``: motion, heat, works,
    warmth, age.

    Friction heat is what friction takes out of the relative motion; the surface's work is what
    it puts into the block through friction. Their difference drives block and springs.
    """
    work = set_motion(p, u, w, mode, out)
    heat = 0.0
    if mode == SLIP or p[P_STICK_CREEP] != 0.0:
        heat -= w[W_FRICTION] * w[W_SLIDING] + w[W_FRICTION + 1] * w[W_SLIDING + 1]
        heat -= w[W_FRICTION + 2] * w[W_SLIDING + 2]
    work += w[W_FRICTION] * w[W_SURFACE] + w[W_FRICTION + 1] * w[W_SURFACE + 1]
    work += w[W_FRICTION + 2] * w[W_SURFACE + 2]
    external = u[U_FORCE_X] * w[W_STATE + VX] + u[U_FORCE_Y] * w[W_STATE + VY]
    external += u[U_MOMENT] * w[W_STATE + OMEGA]
    w[out + HEAT - 1] = heat
    w[out + DISTANCE - 1] = w[W_MEAN_SPEED]
    w[out + TRAVEL - 1] = surface_speed(p, u, w, w[W_STATE + TIME])
    w[out + WORK_SURFACE - 1] = work
    w[out + WORK_EXTERNAL - 1] = external
    w[out + DAMPED - 1] = damping_power(p, w, W_STATE)
    w[out + AGE - 1] = ageing_rate(p, w[W_STATE + AGE], w[W_MEAN_SPEED])
    w[out + WARMTH - 1] = 0.0
    if p[P_WEAKENING] != 0.0:
        w[out + WARMTH - 1] = heat - w[W_STATE + WARMTH] / p[P_RELAXATION]


def kinetic_energy(p: "float[:]", z: "float[:]", block: int) -> float:
    """Kinetic energy of the block, J."""
    vx = z[block + VX]
    vy = z[block + VY]
    omega = z[block + OMEGA]
    return 0.5 * p[P_MASS] * (vx * vx + vy * vy) + 0.5 * p[P_INERTIA] * omega * omega


def block_energy(p: "float[:]", z: "float[:]", block: int) -> float:
    """Kinetic energy of the block and elastic energy of the springs, J."""
    return kinetic_energy(p, z, block) + elastic_energy(p, z, block)
