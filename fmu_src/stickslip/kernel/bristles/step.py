"""Events of a contact with bristles, where these are left out, and one internal step.

Nothing jumps there, so the words are given to what an experimenter would call so. The block breaks
away where it slides faster than v_s, so that friction has lost most of its excess, and the bristles
follow no further; it sticks again where it slides at less than a tenth of v_s, or the bristles
spring back. The ringing of a block that has come to rest on its bristles is no slip. Only the count
of slips and the age of the contact depend on these words.

Bristles are stiff only as their own vibration is, so that the explicit method follows them. At
sliding speeds far above v_s they would be the stiffer the faster the slip, and have nothing left to
say.
"""

from math import sqrt

from ..contact import scaled_sliding_speed, speed_scale
from ..events import STICK_SPEED, look_at, note_mode, step_to_event, stopping_time, switch_mode
from ..layout import *
from ..runge_kutta import begin_step, load_instant, take_step
from .law import (
    bristle_energy,
    set_holding_shear,
    set_presliding_shear,
    set_sliding_shear,
    yielding_share,
)

# Of P_FAST_SLIP: a fast slip ends between it and this, and begins above the second. In between
# either way of reckoning is good.
FAST_SLIP_ENDS = 1.1
FAST_SLIP_BEGINS = 1.25


def slide_steadily(
    p: Floats, u: Floats, z: Floats, w: Floats, instant: int, bristles: float
) -> None:
    """Give the bristles the shear of steady sliding at an instant whose contact is in ``w``.

    ``bristles`` as of BRISTLES from there on. What their energy changes by is friction heat.
    """
    energy = bristle_energy(p, z, instant)
    set_sliding_shear(p, u, z, w, instant)
    z[instant + HEAT] += energy - bristle_energy(p, z, instant)
    z[instant + BRISTLES] = bristles


def settle_bristles(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats, instant: int) -> None:
    """Make an instant consistent at which a run begins, is set to a state, or its inputs change.

    Where the shear is not known, it is that of steady sliding in slip, and in stick what the
    load asks for; the run's energy then counts from there. A block that is known to have been HELD
    has the velocity of its presliding, too.
    """
    look_at(p, u, z, w, instant)
    speed = scaled_sliding_speed(w)
    fast = FAST_SLIP_ENDS * p[P_FAST_SLIP]
    if z[instant + BRISTLES] < 0.0:
        held = z[instant + BRISTLES] == HELD
        z[Z_ENERGY] -= bristle_energy(p, z, instant)
        z[instant + BRISTLES] = 1.0
        before = z[instant + MODE]
        slow = p[P_TRANSITION_SPEED]
        if before == SLIP:
            slow *= STICK_SPEED
        if speed > slow:
            z[instant + MODE] = SLIP
            load_instant(p, z, w, instant)
            set_sliding_shear(p, u, z, w, instant)
            if speed > fast:
                z[instant + BRISTLES] = 0.0
        else:
            z[instant + MODE] = STICK
            set_holding_shear(p, u, z, w, instant)
            if held:
                set_presliding_shear(p, u, z, w, instant)
        if z[instant + MODE] != before:
            note_mode(p, z, w, e, instant)
        z[Z_ENERGY] += bristle_energy(p, z, instant)
    elif z[instant + BRISTLES] == 0.0 and speed <= fast:  # another surface speed, at once
        slide_steadily(p, u, z, w, instant, 1.0)


# Rate times step up to which DOP853 is stable for bristles of any usual damping; it would find out
# by itself, and reject every other step.
STABLE = 6.0
# Part of the sliding that the bristles may still follow, or spring back from, when they are left
# out: what is then missing of friction is gone after some z_0 of slip.
YIELDED = 1e-5
# Angle by which friction may then lag behind the sliding: worth a ten-thousandth of it, across.
TURNS = 1e-4


def stable_step(p: Floats, w: Floats) -> float:
    """Longest step with which the method follows the bristles, s; the slopes at its start in ``w``.

    Their own vibration has the rate sqrt(sigma_0 / m), their yielding in slip that of `yield_rate`.
    """
    rate = sqrt(p[P_BRISTLE_STIFFNESS] / p[P_MASS])
    return STABLE / max(rate, w[W_YIELD_RATE])


def fast_slip_bound(p: Floats, w: Floats) -> float:
    """Time in which a fast slip would come to its end at its present rate, s; -1 if it does not.

    With the slopes of `begin_step` and the contact in ``w``.
    """
    rest = stopping_time(p, w)
    if rest < 0.0:
        return -1.0
    speed = scaled_sliding_speed(w)
    aim = 0.5 * (1.0 + FAST_SLIP_ENDS) * p[P_FAST_SLIP]
    return rest * max(1e-3, 1.0 - aim / speed)


def end_fast_slip(p: Floats, u: Floats, z: Floats, w: Floats) -> None:
    """Where a fast slip has become slow at NEXT, let it end there, after P_FAST_SLIP or before.

    A step beyond that speed is taken again, shorter.
    """
    look_at(p, u, z, w, HERE)
    fastest = scaled_sliding_speed(w)
    look_at(p, u, z, w, NEXT)
    speed = scaled_sliding_speed(w)
    aim = 0.5 * (1.0 + FAST_SLIP_ENDS) * p[P_FAST_SLIP]
    low = 0.0
    high = z[NEXT + TIME] - z[HERE + TIME]
    slowest = speed
    sweep = 0
    beyond = speed < p[P_FAST_SLIP]
    while beyond and sweep < 60:
        h = 0.5 * (low + high)
        if sweep % 3 != 2:
            h = low + (high - low) * (fastest - aim) / (fastest - slowest)
        load_instant(p, z, w, HERE)
        take_step(p, u, z, w, HERE, NEXT, h)
        look_at(p, u, z, w, NEXT)
        speed = scaled_sliding_speed(w)
        if speed < p[P_FAST_SLIP]:
            high = h
            slowest = speed
        else:
            low = h
            fastest = speed
            beyond = speed > FAST_SLIP_ENDS * p[P_FAST_SLIP]
        sweep += 1
    if speed <= FAST_SLIP_ENDS * p[P_FAST_SLIP]:
        slide_steadily(p, u, z, w, NEXT, 1.0)


def shear_at_most(p: Floats) -> float:
    """z_0, m."""
    return max(p[P_MU_S], p[P_MU_K]) * p[P_NORMAL_FORCE] / p[P_BRISTLE_STIFFNESS]


def turning_lag(p: Floats, w: Floats) -> float:
    """Angle by which bristles trail behind a sliding that turns: z_0 over the way of a turn by 1.

    With the slopes of `begin_step` and the contact in ``w``.
    """
    size = 0.0
    along = 0.0
    for i in range(3):
        rate = p[P_SCALES + i] * (w[W_SLOPES + VX - 1 + i] - w[W_SURFACE + 3 + i])
        w[W_RATES + i] = rate
        size += w[W_SCALED + i] * w[W_SCALED + i]
        along += rate * w[W_SCALED + i]
    along /= size
    across = 0.0
    for i in range(3):
        rate = w[W_RATES + i] - along * w[W_SCALED + i]
        across += rate * rate
    return shear_at_most(p) * sqrt(across) / size


def choose_bristles(p: Floats, u: Floats, z: Floats, w: Floats) -> None:
    """Decide whether the bristles count in a fast slip from HERE; slopes and contact are in ``w``.

    They are left out where they hardly move any more, and come back where the sliding turns.
    """
    fast = FAST_SLIP_BEGINS * p[P_FAST_SLIP]
    if z[HERE + MODE] == STICK or scaled_sliding_speed(w) < fast:
        return
    bristles = z[HERE + BRISTLES]
    lag = turning_lag(p, w)
    if bristles == 1.0 and lag < TURNS:
        noise = p[P_TOLERANCE] * speed_scale(p, u) / p[P_RATE]  # of z, in the error test
        if abs(yielding_share(p, w) - 1.0) < YIELDED + 10.0 * noise / shear_at_most(p):
            bristles = 0.0
    elif bristles == 0.0 and lag > 2.0 * TURNS:
        bristles = 1.0
    if bristles != z[HERE + BRISTLES]:
        slide_steadily(p, u, z, w, HERE, bristles)
        begin_step(p, u, z, w, HERE)


def finish_bristle_step(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats) -> None:
    """Events of a contact with bristles in the step from HERE to NEXT."""
    if z[HERE + BRISTLES] == 0.0:
        end_fast_slip(p, u, z, w)
    elif step_to_event(p, u, z, w):
        switch_mode(p, z, w, e, NEXT)
