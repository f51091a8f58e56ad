"""Stick and slip as events: where a slip begins, where it ends, and what the contact does then."""

from __future__ import annotations

from math import sqrt

from . import Floats
from .contact import rest_speed, scaled_sliding_speed, set_holding_load, set_onset_direction
from .friction.coefficient import age_left, holding_coefficient
from .layout import *
from .motion import kinetic_energy
from .rest import come_to_rest, excess_load, look_at, set_contact_in_phase
from .runge_kutta import begin_step, load_instant, take_step
from .steady_sliding import (
    may_slide_quasi_steadily,
    set_steady_direction,
    slides_quasi_steadily,
    sliding_energy,
    turn_to_steady_direction,
)
from .stick import fastest_presliding


def log_event(z: Floats, e: Floats, instant: int) -> None:
    """Note time, new mode and x; events beyond the capacity are counted only."""
    count = int(e[E_COUNT])
    if count < int(e[E_CAPACITY]):
        e[E_FIRST + E_WIDTH * count] = z[instant + TIME]
        e[E_FIRST + E_WIDTH * count + 1] = z[instant + MODE]
        e[E_FIRST + E_WIDTH * count + 2] = z[instant + X]
    e[E_COUNT] = count + 1.0


def set_direction(p: Floats, z: Floats, w: Floats, instant: int, speed: float) -> None:
    """Remember the direction of sliding, from the sliding velocity in ``w``."""
    z[instant + DIRECTION] = w[W_SLIDING] / speed
    z[instant + DIRECTION + 1] = p[P_LATERAL] * w[W_SLIDING + 1] / speed
    z[instant + DIRECTION + 2] = p[P_LATERAL] * p[P_RADIUS] * w[W_SLIDING + 2] / speed


def note_break_away(z: Floats, instant: int) -> None:
    """Count a break-away at an instant, and note how old the contact is that gives way."""
    z[instant + SLIPS] += 1.0
    z[instant + AGE_AWAY] = z[instant + TIME] - z[instant + HOLD_SINCE]
    z[instant + DISTANCE_AWAY] = z[instant + DISTANCE]


def release(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> None:
    """Let the contact slide, in the direction that the loads in ``w`` ask for.

    Where guides make it slide already, that is the direction.
    """
    z[instant + MODE] = SLIP
    z[instant + QUASI_STEADY] = 0.0
    speed = scaled_sliding_speed(p, w)
    if speed > rest_speed(p, u):
        set_direction(p, z, w, instant, speed)
    else:
        set_holding_load(p, w)
        set_onset_direction(p, u, w)
        for i in range(3):
            z[instant + DIRECTION + i] = w[W_DIRECTION + i]


def settle(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats, instant: int) -> None:
    """Decide whether the contact at an instant sticks or slips, and make the instant consistent.

    A stick goes on where the block slides no faster than presliding may be.
    """
    look_at(p, u, z, w, instant)
    before = z[instant + MODE]
    speed = scaled_sliding_speed(p, w)
    slow = rest_speed(p, u)
    if before == STICK:
        slow += fastest_presliding(p, u, w)
    z[instant + QUASI_STEADY] = 0.0
    if speed > slow:
        z[instant + MODE] = SLIP
        set_direction(p, z, w, instant, speed)
    elif holding_coefficient(p, u, w) * p[P_NORMAL_FORCE] == 0.0:
        z[instant + MODE] = SLIP
    elif come_to_rest(p, u, z, w, instant) < 0.0:
        z[instant + MODE] = STICK
    else:
        release(p, u, z, w, instant)
    if z[instant + MODE] != before:
        if z[instant + MODE] == SLIP:
            note_break_away(z, instant)
        else:
            z[instant + HOLD_SINCE] = z[instant + TIME] - age_left(p, w)
        log_event(z, e, instant)


def break_away(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats) -> None:
    """Move NEXT back to the break-away, if the contact gives way in the step from HERE.

    Illinois iteration on the size of the step until time itself has no finer resolution, or the
    load is at the limit by far better than a step's error: every trial is a step of full order
    from HERE, so the event is as exact as the motion. NEXT ends at the side where the load has
    reached the limit.
    """
    excess = excess_load(p, u, z, w, NEXT, z[HERE + TIME])
    if excess < 0.0:
        return
    load_instant(p, z, w, HERE)  # the trials belong to the surface phase of HERE
    low = 0.0
    high = z[NEXT + TIME] - z[HERE + TIME]
    excess_low = excess_load(p, u, z, w, HERE, z[HERE + TIME])
    excess_high = excess
    finest = 4e-16 * max(abs(z[NEXT + TIME]), high)
    side = 0
    sweep = 0
    enough = p[P_TOLERANCE] * sqrt(p[P_TOLERANCE])
    while high - low > finest and not 0.0 <= excess <= enough and sweep < 200:
        h = 0.5 * (low + high)
        if excess_low < 0.0 and sweep % 4 != 3:
            h = high - excess_high * (high - low) / (excess_high - excess_low)
        load_instant(p, z, w, HERE)
        take_step(p, u, z, w, HERE, NEXT, h)
        excess = excess_load(p, u, z, w, NEXT, z[HERE + TIME])
        if excess < 0.0:
            low = h
            excess_low = excess
            if side == -1:
                excess_high = 0.5 * excess_high
            side = -1
        else:
            high = h
            excess_high = excess
            if side == 1:
                excess_low = 0.5 * excess_low
            side = 1
        sweep += 1
    if excess < 0.0:
        load_instant(p, z, w, HERE)
        take_step(p, u, z, w, HERE, NEXT, high)
    set_contact_in_phase(p, u, z, w, NEXT, z[HERE + TIME])
    release(p, u, z, w, NEXT)
    note_break_away(z, NEXT)
    log_event(z, e, NEXT)


def turn(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> None:
    """Turn quasi-steady sliding at an instant to the direction in ``w[W_STEADY:]``.

    What the block's kinetic energy gains is the surface's work: the energy of the sliding stays.
    """
    energy = kinetic_energy(p, z, instant)
    turn_to_steady_direction(p, w)
    z[instant + VX] = w[W_STATE + VX]
    z[instant + VY] = p[P_FREE_Y] * w[W_STATE + VY]
    z[instant + OMEGA] = p[P_FREE_PHI] * w[W_STATE + OMEGA]
    z[instant + WORK_SURFACE] += kinetic_energy(p, z, instant) - energy
    for i in range(3):
        z[instant + DIRECTION + i] = w[W_STEADY + i]


def keep_direction_steady(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> None:
    """Give quasi-steady sliding the direction that the load asks for."""
    look_at(p, u, z, w, instant)
    set_steady_direction(p, u, w, sqrt(sliding_energy(p, w)))
    turn(p, u, z, w, instant)


def choose_sliding(p: Floats, u: Floats, z: Floats, w: Floats) -> None:
    """Decide whether the slip from HERE is quasi-steady; slopes and contact are in ``w``."""
    before = z[HERE + QUASI_STEADY]
    now = 0.0
    if before == 1.0 or may_slide_quasi_steadily(p, u, w):
        look_at(p, u, z, w, HERE)
        if slides_quasi_steadily(p, u, w, before):
            now = 1.0
    if now != before:
        z[HERE + QUASI_STEADY] = now
        if now == 1.0:
            turn(p, u, z, w, HERE)
        begin_step(p, u, z, w, HERE)
    elif now == 1.0:
        begin_step(p, u, z, w, HERE)
