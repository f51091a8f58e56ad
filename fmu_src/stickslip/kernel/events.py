"""Stick and slip: the load that a contact at rest holds, where a slip begins and where it ends.

Both are events, located to rounding. How what slides comes to rest, and what the contact does then.
"""

from math import log, sqrt

from .bristles.law import has_bristles, set_bristle_friction, yielding_share
from .contact import (
    holding_ratio,
    rest_speed,
    scaled_sliding_speed,
    set_contact,
    set_holding_load,
    set_onset_direction,
)
from .friction.coefficient import age_left, holding_coefficient
from .friction.force import friction_in_slip
from .layout import *
from .motion import kinetic_energy
from .rig.drive import set_surface_phase
from .runge_kutta import begin_step, follow_surface, load_instant, take_step
from .steady_sliding import (
    may_slide_quasi_steadily,
    set_steady_direction,
    slides_quasi_steadily,
    sliding_energy,
    turn_to_steady_direction,
)
from .stick import fastest_presliding, set_stick_velocity

# Of v_s: sliding slower than this is a stick of a contact with bristles.
STICK_SPEED = 0.1


def look_at(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> None:
    """Loads, surface and sliding velocity at an instant in ``z``."""
    load_instant(p, z, w, instant)
    set_contact(p, u, w, W_STATE)


def set_contact_in_phase(
    p: Floats, u: Floats, z: Floats, w: Floats, instant: int, phase: float
) -> None:
    """Loads, surface and sliding velocity at an instant in ``z``, in a phase of the surface.

    ``phase`` is a time in the phase that counts: the end of the speed ramp belongs to the step that
    ends there as well as to the one that begins there, and the load differs.
    """
    load_instant(p, z, w, instant)
    set_surface_phase(p, w, phase)
    set_contact(p, u, w, W_STATE)


def excess_load(p: Floats, u: Floats, z: Floats, w: Floats, instant: int, phase: float) -> float:
    """Friction demand over friction capacity, less 1: the function whose zero is the break-away.

    ``phase`` as in `set_contact_in_phase`. A stick ratio below 1 judges stick by a part of the
    load (stick_stiffness, the study's fault).
    """
    set_contact_in_phase(p, u, z, w, instant, phase)
    set_holding_load(p, w)
    return judged_ratio(p, u, w) - 1.0


def judged_ratio(p: Floats, u: Floats, w: Floats) -> float:
    """`holding_ratio` of the part of the load in ``w`` that stick is judged by."""
    for i in range(3):
        w[W_FRICTION + i] *= p[P_STICK_RATIO]
    return holding_ratio(p, u, w)


def stop_sliding(
    p: Floats, u: Floats, z: Floats, w: Floats, instant: int, presliding: float
) -> None:
    """Take away what is left of the sliding velocity in ``w``, as friction would.

    What a stick has by ``presliding`` per load, m/(s N), is left. The impulse -M d that takes d
    away makes heat of M d^2 / 2, all of the sliding's energy where there is no presliding, and does
    work on the velocity that is left: the ledger stays closed.
    """
    dx = w[W_SLIDING]
    dy = 0.0
    dr = 0.0
    if p[P_LATERAL] > 0.0:
        dy = p[P_FREE_Y] * w[W_SLIDING + 1]
        dr = p[P_FREE_PHI] * w[W_SLIDING + 2]
    m = p[P_MASS]
    j = p[P_INERTIA]
    follow_surface(p, u, z, w, instant, presliding)
    if presliding != 0.0:
        dx -= w[W_SLIDING]
        if p[P_LATERAL] > 0.0:
            dy -= p[P_FREE_Y] * w[W_SLIDING + 1]
            dr -= p[P_FREE_PHI] * w[W_SLIDING + 2]
    z[instant + HEAT] += 0.5 * (m * (dx * dx + dy * dy) + j * dr * dr)
    work = m * (dx * z[instant + VX] + dy * z[instant + VY]) + j * dr * z[instant + OMEGA]
    z[instant + WORK_SURFACE] -= work


def stick_excess(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> float:
    """`excess_load` of a block that were to stick, with the presliding that it would then have."""
    load_instant(p, z, w, instant)
    set_stick_velocity(p, u, w, p[P_PRESLIDING])
    return judged_ratio(p, u, w) - 1.0


def come_to_rest(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> float:
    """Bring a block that hardly slides to rest on the surface, or to presliding; its `excess_load`.

    One that is not to stick preslides no longer, but keeps what velocity it had from that. Leaves
    the contact there in ``w``.
    """
    presliding = p[P_PRESLIDING]
    if presliding != 0.0:
        if stick_excess(p, u, z, w, instant) >= 0.0:
            presliding = 0.0
        look_at(p, u, z, w, instant)
    if presliding == p[P_PRESLIDING] or z[instant + MODE] == SLIP:
        stop_sliding(p, u, z, w, instant, presliding)
    return excess_load(p, u, z, w, instant, z[instant + TIME])


def stopping_time(p: Floats, w: Floats) -> float:
    """Time in which the scaled sliding speed would vanish at its present rate, s; -1 if it grows.

    With the slopes of `begin_step` and the contact in ``w``.
    """
    rate = sliding_rate(p, w, W_SLOPES + VX - 1)
    if rate >= 0.0:
        return -1.0
    speed = scaled_sliding_speed(w)
    return speed * speed / -rate


def time_to_rest(p: Floats, u: Floats, w: Floats) -> float:
    """As `stopping_time`, with the friction of the speeds on the way, where it depends on speed.

    When the end is near, ds / (-ds/dt) is integrated by Gauss-Legendre's three points, the other
    loads as they are now: the nearer to the end a step may go, the fewer are needed. Leaves the
    friction of a slower slip in ``w``.
    """
    rest = stopping_time(p, w)
    speed = scaled_sliding_speed(w)
    far = rest < 0.0 or rest > p[P_LONGEST_STEP]
    is_even = p[P_LOCAL_LAW] == 0.0 and p[P_TRANSITION_SPEED] == 0.0
    if is_even or far or speed <= rest_speed(p, u):
        return rest
    time = 0.0
    for i in range(3):
        part = 0.5 + 0.5 * (i - 1) * sqrt(0.6)
        weight = (5.0 + 3.0 * (i % 2)) / 18.0
        rate = slower_sliding_rate(p, u, w, part)
        if rate >= 0.0:
            return rest
        time += weight * speed * speed / -rate
    return time


def sliding_rate(p: Floats, w: Floats, at: int) -> float:
    """Scaled sliding velocity in ``w`` times its rate, m^2/s^3, of an acceleration ``w[at:]``."""
    rate = 0.0
    for i in range(3):
        scale = p[P_SCALES + i]
        rate += scale * scale * w[W_SLIDING + i] * (w[at + i] - w[W_SURFACE + 3 + i])
    return rate


def slower_sliding_rate(p: Floats, u: Floats, w: Floats, part: float) -> float:
    """As `sliding_rate`, with the friction of a part of the sliding velocity in ``w``."""
    sx = w[W_SCALED]
    friction_in_slip(p, u, w, part * sx, part * w[W_SCALED + 1], part * w[W_SCALED + 2])
    for i in range(3):
        force = w[W_LOAD + i] + w[W_FRICTION + i]
        w[W_RATES + i] = p[P_FREE + i] * force / p[P_MASS + i]
    return sliding_rate(p, w, W_RATES)


def set_direction(p: Floats, z: Floats, w: Floats, instant: int, speed: float) -> None:
    """Remember the direction of sliding, from the sliding velocity in ``w``."""
    for i in range(3):
        z[instant + DIRECTION + i] = w[W_SCALED + i] / speed


def note_mode(p: Floats, z: Floats, w: Floats, e: Floats, instant: int) -> None:
    """Note that the contact at an instant has just changed its mode: age, count and log.

    How old is the contact that gives way? Events beyond the log's capacity are counted only.
    """
    if z[instant + MODE] == SLIP:
        z[instant + SLIPS] += 1.0
        z[instant + AGE_AWAY] = z[instant + TIME] - z[instant + HOLD_SINCE]
        z[instant + DISTANCE_AWAY] = z[instant + DISTANCE]
    else:
        z[instant + HOLD_SINCE] = z[instant + TIME] - age_left(p, w)
    count = int(e[E_COUNT])
    if count < int(e[E_CAPACITY]):
        e[E_FIRST + E_WIDTH * count] = z[instant + TIME]
        e[E_FIRST + E_WIDTH * count + 1] = z[instant + MODE]
        e[E_FIRST + E_WIDTH * count + 2] = z[instant + X]
    e[E_COUNT] = count + 1.0


def release(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> None:
    """Let the contact slide, in the direction that the loads in ``w`` ask for.

    Where guides make it slide already, that is the direction.
    """
    z[instant + MODE] = SLIP
    z[instant + QUASI_STEADY] = 0.0
    speed = scaled_sliding_speed(w)
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
    speed = scaled_sliding_speed(w)
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
        note_mode(p, z, w, e, instant)


def mode_excess(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> float:
    """How far a contact with bristles is beyond its mode at an instant: above 0 it has changed.

    The instant's mode says whether a break-away or a new stick is looked for.
    """
    look_at(p, u, z, w, instant)
    speed = scaled_sliding_speed(w) / p[P_TRANSITION_SPEED]
    if z[instant + MODE] == STICK:
        grown = log(max(speed, 1e-9))  # it grows by e in a time
        if grown < 0.0:
            return grown
        set_bristle_friction(p, u, w)
        return min(grown, yielding_share(p, w) - 1.0)
    slow = 1.0 - speed / STICK_SPEED
    if speed > 1.0 or slow >= 0.0:
        return slow
    set_bristle_friction(p, u, w)
    return max(slow, -yielding_share(p, w))


def event_excess(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> float:
    """The function whose zero, in the step from HERE, is the break-away or the change of mode."""
    if has_bristles(p):
        return mode_excess(p, u, z, w, instant)
    return excess_load(p, u, z, w, instant, z[HERE + TIME])


def step_to_event(p: Floats, u: Floats, z: Floats, w: Floats) -> bool:
    """Move NEXT back to the event, if there is one in the step from HERE.

    Illinois iteration on the size of the step until time itself has no finer resolution, or the
    load is at the limit by far better than a step's error: every trial is a step of full order
    from HERE, so the event is as exact as the motion. NEXT ends at the side where the load has
    reached the limit. With bristles nothing that moves depends on the event but the age.
    """
    excess = event_excess(p, u, z, w, NEXT)
    if excess < 0.0:
        return False
    load_instant(p, z, w, HERE)  # the trials belong to the surface phase of HERE
    low = 0.0
    high = z[NEXT + TIME] - z[HERE + TIME]
    excess_low = event_excess(p, u, z, w, HERE)
    excess_high = excess
    finest = 4e-16 * max(abs(z[NEXT + TIME]), high)
    enough = p[P_TOLERANCE] * sqrt(p[P_TOLERANCE])
    lack = 0.0
    side = 0
    sweep = 0
    if has_bristles(p):
        enough = max(1e-9, p[P_TOLERANCE])
        lack = enough
        finest = enough * high
        if excess_low >= 0.0:  # beyond its mode from the beginning
            sweep = 200
    while high - low > finest and not -lack <= excess <= enough and sweep < 200:
        h = 0.5 * (low + high)
        if excess_low < 0.0 and sweep % 4 != 3:
            h = high - excess_high * (high - low) / (excess_high - excess_low)
        load_instant(p, z, w, HERE)
        take_step(p, u, z, w, HERE, NEXT, h)
        excess = event_excess(p, u, z, w, NEXT)
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
    if excess < -lack:
        load_instant(p, z, w, HERE)
        take_step(p, u, z, w, HERE, NEXT, high)
    return True


def break_away(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats) -> None:
    """Let the contact slide from NEXT on, moved back to the break-away, if there is one."""
    if step_to_event(p, u, z, w):
        set_contact_in_phase(p, u, z, w, NEXT, z[HERE + TIME])
        release(p, u, z, w, NEXT)
        note_mode(p, z, w, e, NEXT)


def switch_mode(p: Floats, z: Floats, w: Floats, e: Floats, instant: int) -> None:
    """Give a contact with bristles its other mode."""
    load_instant(p, z, w, instant)
    z[instant + MODE] = SLIP + STICK - z[instant + MODE]
    note_mode(p, z, w, e, instant)


def turn(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> None:
    """Turn quasi-steady sliding at an instant to the direction in ``w[W_STEADY:]``.

    What the block's kinetic energy gains is the surface's work: the energy of the sliding stays.
    """
    energy = kinetic_energy(p, z, instant)
    turn_to_steady_direction(p, w)
    for i in range(3):
        z[instant + VX + i] = p[P_FREE + i] * w[W_STATE + VX + i]
        z[instant + DIRECTION + i] = w[W_STEADY + i]
    z[instant + WORK_SURFACE] += kinetic_energy(p, z, instant) - energy


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
