"""Equations of motion: slopes of the integrated state in stick and in slip."""

from .bristles.law import bristle_energy, has_bristles, set_bristle_friction, storing_power
from .contact import rest_speed, scaled_sliding_speed, set_contact, set_holding_load
from .friction.force import friction_at_onset, friction_in_slip
from .layout import *
from .rig.drive import input_at, surface_speed
from .rig.springs import damping_power, elastic_energy
from .steady_sliding import set_quasi_steady_motion
from .stick import ride_surface, set_presliding
from .terms import set_state_rates


def set_slip_friction(p: Floats, u: Floats, w: Floats) -> None:
    """Kinetic friction into ``w[W_FRICTION:]``.

    Where the sliding velocity is too small to have a direction, at the first instant of a slip,
    the direction is the one of `set_onset_direction`.
    """
    speed = scaled_sliding_speed(w)
    if speed > rest_speed(p, u):
        friction_in_slip(p, u, w, w[W_SCALED], w[W_SCALED + 1], w[W_SCALED + 2])
    else:
        friction_at_onset(p, u, w, w[W_DIRECTION], w[W_DIRECTION + 1], w[W_DIRECTION + 2], speed)
        w[W_MEAN_SPEED] = speed


def set_motion(p: Floats, u: Floats, w: Floats, mode: float, out: int) -> float:
    """Rates of x, y, phi and of their velocities at ``w[W_STATE:]``, into ``w[out:]``.

    Returns power of the surface beyond that of friction, W: 0 but in presliding and
    in quasi-steady sliding.
    """
    if has_bristles(p):
        set_contact(p, u, w, W_STATE)
        if w[W_STATE + BRISTLES] == 1.0:
            set_bristle_friction(p, u, w)
        else:
            set_slip_friction(p, u, w)
        set_rates(p, w, out)
        return 0.0
    if mode == STICK and p[P_PRESLIDING] != 0.0:
        power = set_presliding(p, u, w)
        set_rates(p, w, out)
        return power
    set_contact(p, u, w, W_STATE)
    if mode == SLIP and w[W_STATE + QUASI_STEADY] == 1.0:
        power = set_quasi_steady_motion(p, u, w, out)
        set_rates_of_place(p, w, out)
        return power
    if mode == SLIP:
        set_slip_friction(p, u, w)
    else:
        set_holding_load(p, w)
        w[W_MEAN_SPEED] = 0.0
        ride_surface(p, w)
    set_rates(p, w, out)
    return 0.0


def set_rates(p: Floats, w: Floats, out: int) -> None:
    """Rates of x, y, phi and of their velocities, into ``w[out:]``, from loads and friction."""
    set_rates_of_place(p, w, out)
    for i in range(3):
        force = w[W_LOAD + i] + w[W_FRICTION + i]
        w[out + VX - 1 + i] = p[P_FREE + i] * force / p[P_MASS + i]


def set_rates_of_place(p: Floats, w: Floats, out: int) -> None:
    """Rates of x, y, phi, into ``w[out:]``: the velocities, where the block is free."""
    for i in range(3):
        w[out + X - 1 + i] = p[P_FREE + i] * w[W_STATE + VX + i]


def set_slopes(p: Floats, u: Floats, w: Floats, mode: float, out: int) -> None:
    """All slopes at the instant in ``w[W_STATE:]``, into ``w[out:]``: motion, heat, works
    and the effects' states.

    Friction heat is what friction takes out of the relative motion; the surface's work is what
    it puts into the block through friction. Their difference drives block and springs.
    """
    work = set_motion(p, u, w, mode, out)
    heat = 0.0
    for i in range(3):
        w[out + SHEAR_X - 1 + i] = 0.0
    if has_bristles(p) and w[W_STATE + BRISTLES] == 1.0:
        for i in range(3):
            w[out + SHEAR_X - 1 + i] = w[W_SHEARING + i]
        heat -= storing_power(p, w)
    if mode == SLIP or p[P_PRESLIDING] != 0.0 or has_bristles(p):
        heat -= w[W_FRICTION] * w[W_SLIDING] + w[W_FRICTION + 1] * w[W_SLIDING + 1]
        heat -= w[W_FRICTION + 2] * w[W_SLIDING + 2]
    work += w[W_FRICTION] * w[W_SURFACE] + w[W_FRICTION + 1] * w[W_SURFACE + 1]
    work += w[W_FRICTION + 2] * w[W_SURFACE + 2]
    t = w[W_STATE + TIME]
    external = input_at(u, U_FORCE_X, t) * w[W_STATE + VX]
    external += input_at(u, U_FORCE_Y, t) * w[W_STATE + VY]
    external += input_at(u, U_MOMENT, t) * w[W_STATE + OMEGA]
    w[out + HEAT - 1] = heat
    w[out + DISTANCE - 1] = w[W_MEAN_SPEED]
    w[out + TRAVEL - 1] = surface_speed(p, u, w, w[W_STATE + TIME])
    w[out + WORK_SURFACE - 1] = work
    w[out + WORK_EXTERNAL - 1] = external
    w[out + DAMPED - 1] = damping_power(p, w, W_STATE)
    set_state_rates(p, u, w, out, heat, w[W_MEAN_SPEED])


def kinetic_energy(p: Floats, z: Floats, instant: int) -> float:
    """Kinetic energy of the block, J."""
    vx = z[instant + VX]
    vy = z[instant + VY]
    omega = z[instant + OMEGA]
    return 0.5 * p[P_MASS] * (vx * vx + vy * vy) + 0.5 * p[P_INERTIA] * omega * omega


def block_energy(p: Floats, z: Floats, instant: int) -> float:
    """Kinetic energy of the block and elastic energy of springs and contact, J."""
    energy = kinetic_energy(p, z, instant) + elastic_energy(p, z, instant)
    if has_bristles(p):
        energy += bristle_energy(p, z, instant)
    return energy
