"""Stick and slip of a contact with bristles, and where these are left out.

Nothing jumps there, so the words are given to what an experimenter would call so. The block breaks
away where it slides faster than v_s, so that friction has lost most of its excess, and the bristles
follow no further; it sticks again where it slides at less than a tenth of v_s, or the bristles
spring back. The ringing of a block that has come to rest on its bristles is no slip. Only the count
of slips and the age of the contact depend on these words.
"""

from __future__ import annotations

from math import log

from .. import Floats
from ..contact import scaled_sliding_speed
from ..events import log_event, note_break_away
from ..friction.coefficient import age_left
from ..layout import *
from ..rest import look_at
from ..runge_kutta import load_instant, take_step
from .law import (
    bristle_energy,
    set_bristle_friction,
    set_holding_shear,
    set_presliding_shear,
    set_sliding_shear,
    yielding_share,
)

# Of v_s: sliding slower than this is a stick.
STICK_SPEED = 0.1
# Of P_FAST_SLIP: a fast slip ends between it and this, and begins above the second. In between
# either way of reckoning is good.
FAST_SLIP_ENDS = 1.1
FAST_SLIP_BEGINS = 1.25


def mode_excess(p: Floats, u: Floats, z: Floats, w: Floats, instant: int) -> float:
    """How far the contact is beyond its mode at an instant in ``z``: above 0 it has changed.

    The instant's mode says whether a break-away or a new stick is looked for.
    """
    look_at(p, u, z, w, instant)
    speed = scaled_sliding_speed(p, w) / p[P_TRANSITION_SPEED]
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


def change_mode(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats) -> None:
    """Move NEXT back to the moment at which the contact breaks away or sticks again, if it does.

    Illinois iteration on the size of the step, as `events.break_away` does it.
    """
    excess = mode_excess(p, u, z, w, NEXT)
    if excess < 0.0:
        return
    low = 0.0
    high = z[NEXT + TIME] - z[HERE + TIME]
    excess_low = mode_excess(p, u, z, w, HERE)
    excess_high = excess
    enough = max(1e-9, p[P_TOLERANCE])  # nothing that moves depends on it but the age
    finest = enough * high
    side = 0
    sweep = 0
    while high - low > finest and abs(excess) > enough and excess_low < 0.0 and sweep < 200:
        h = 0.5 * (low + high)
        if sweep % 4 != 3:
            h = high - excess_high * (high - low) / (excess_high - excess_low)
        load_instant(p, z, w, HERE)
        take_step(p, u, z, w, HERE, NEXT, h)
        excess = mode_excess(p, u, z, w, NEXT)
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
    if excess < -enough:
        load_instant(p, z, w, HERE)
        take_step(p, u, z, w, HERE, NEXT, high)
    load_instant(p, z, w, NEXT)
    if z[NEXT + MODE] == STICK:
        z[NEXT + MODE] = SLIP
        note_break_away(z, NEXT)
    else:
        z[NEXT + MODE] = STICK
        z[NEXT + HOLD_SINCE] = z[NEXT + TIME] - age_left(p, w)
    log_event(z, e, NEXT)


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
    speed = scaled_sliding_speed(p, w)
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
            if before == STICK:
                note_break_away(z, instant)
            else:
                z[instant + HOLD_SINCE] = z[instant + TIME] - age_left(p, w)
            log_event(z, e, instant)
        z[Z_ENERGY] += bristle_energy(p, z, instant)
    elif z[instant + BRISTLES] == 0.0 and speed <= fast:  # another surface speed, at once
        slide_steadily(p, u, z, w, instant, 1.0)
