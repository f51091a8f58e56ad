"""The motion as a hybrid system for a host's own integrator (model exchange).

The host integrates the `EXCHANGED` continuous states of SHOWN: X ... DAMPED and the time in slip.
Between events the right-hand side is smooth, so that the order of the host's method is kept:

- In stick the velocity is the surface's, or that of presliding, whatever the host's rounding has
  made of the state; the state follows with the acceleration that goes with it.
- In slip, friction opposes the sliding velocity. A sliding that turns back beyond the event, in a
  step that the host will discard, is answered as its mirror image: without that, friction would
  jump where the host looks for the event.
- A slip begins and ends with sliding velocities that are too small to have a direction: there the
  direction is frozen, as in `advance` (SLIDING_BEGINS, SLIDING_ENDS). In between (SLIDING_GOES_ON)
  it is the velocity's own.
- In the plane friction turns a slow sliding at the rate mu g / speed: stiff at first, and soon no
  more. An implicit method that keeps the Jacobian of the slip's beginning for some tens of steps,
  as CVODE does, takes each correction for as small as that says, and what it has not corrected for
  solved. So a slip that gains speed has an event each time that it is `FASTER` by so much: there
  the host starts anew.
- The shear of bristles is always integrated, also in a fast slip, and no slip is quasi-steady: both
  are means of an explicit method, and stiff to an integrator that is made for that.

Events: the load of a stick reaches what the contact can hold; a slip has no velocity left along its
direction; its speed passes `slowest_slip`; the speed ramp ends (at a time known before); inputs or
parameters change. Each is decided where `advance` decides it, by `settle` and `release`, and
counted in the same way. An instant is made consistent there, and the ledger stays closed.

Inputs may change in events, and between them too: then their rates, and with them the acceleration
of the surface, come from their past, see `rig.history`.
"""

from .advance import settle_contact, sliding_along
from .bristles.law import has_bristles
from .contact import rest_speed, scaled_sliding_speed, set_contact, set_holding_load, speed_scale
from .events import (
    excess_load,
    judged_ratio,
    look_at,
    mode_excess,
    note_mode,
    release,
    set_direction,
    settle,
    stop_sliding,
    switch_mode,
)
from .friction.coefficient import holding_coefficient
from .layout import *
from .motion import set_slopes
from .outputs import show
from .rig.springs import shortest_spring
from .runge_kutta import load_instant, state_scale
from .steady_sliding import LOOK_AHEAD
from .stick import set_stick_velocity
from .terms import has_state_law

# What a load may lack of the limit, relative to that, for a host's event to be the break-away.
AT_THE_LIMIT = 1e-9
# Of `slowest_slip`: a slip that began from rest has turned back where it slides back that fast, and
# has a direction of its own where it slides on so fast.
TURNED_BACK = 0.5
WELL_ON = 2.0
# Of that speed: with this a slip goes on in an event, where an input is a little off the one that
# the host has found the event with. A slip that did not would have another event at once.
NEARLY = 0.75
# Of its speed: a slip is reversed, and not only turned, where it goes back that fast.
REVERSED = 0.5
# Factor of the speed from one event of a slip in the plane that gains speed to the next one, and
# part of the motion's own speed up to which there are any.
FASTER = 8.0
FAST_ENOUGH = 0.3
# Of the motion's own speed: up to that a slip is slow whose friction follows the state of the
# contact, see `slowest_slip`.
CREEPING = 2e-4
# By which an end of the speed ramp may be missed, relative to its time: hosts round.
RAMP_ROUNDING = 1e-8


def load_moment(p: Floats, z: Floats, w: Floats) -> None:
    """Make SHOWN what the laws of motion look at, in the phase of the surface between events."""
    load_instant(p, z, w, SHOWN)
    w[W_RUNNING_UP] = z[Z_RAMPING]


def put_states(z: Floats, s: Floats) -> None:
    """The host's continuous states ``s`` become those of SHOWN."""
    for i in range(STATES):
        z[SHOWN + 1 + i] = s[i]
    z[SHOWN + SLIP_TIME] = s[STATES]


def take_states(z: Floats, s: Floats) -> None:
    """Continuous states of SHOWN, into ``s``."""
    for i in range(STATES):
        s[i] = z[SHOWN + 1 + i]
    s[STATES] = z[SHOWN + SLIP_TIME]


def set_nominals(p: Floats, u: Floats, s: Floats) -> None:
    """Sizes of the continuous states that count in this motion, each in its unit, into ``s``."""
    for i in range(STATES):
        s[i] = state_scale(p, u, i + 1, 0.0) / p[P_TOLERANCE]
        if not s[i] > 0.0:
            s[i] = 1.0
    s[STATES] = 1.0 / p[P_RATE]


def slowest_slip(p: Floats, u: Floats) -> float:
    """Scaled sliding speed below which a slip begins or ends, m/s.

    With friction that follows the state of the contact a slip creeps for a while, and stiffly, at
    speeds that a host's integrator does not resolve: it keeps the block's velocity to its tolerance
    of the surface's. What that makes of a creeping slip is no event, or there is one at every step.
    """
    if has_state_law(p):
        return max(rest_speed(p, u), CREEPING * speed_scale(p, u))
    return rest_speed(p, u)


# --- right-hand side --------------------------------------------------------------------------


def set_rates_in_slip(p: Floats, u: Floats, z: Floats, w: Floats) -> None:
    """Slopes of a slip, into ``w[W_SLOPES:]``; of one that has turned back, of its mirror image."""
    set_contact(p, u, w, W_STATE)
    along = sliding_along(p, z, w, SHOWN)
    if along < 0.0:
        back = 2.0 * along
        for i in range(3):
            if p[P_SCALES + i] > 0.0:
                w[W_STATE + VX + i] -= back * z[SHOWN + DIRECTION + i] / p[P_SCALES + i]
    elif z[Z_SLIDING] == SLIDING_GOES_ON:
        speed = scaled_sliding_speed(w)
        if speed > 0.0:
            for i in range(3):
                w[W_DIRECTION + i] = w[W_SCALED + i] / speed
    set_slopes(p, u, w, SLIP, W_SLOPES)
    for i in range(3):
        w[W_SLOPES + X - 1 + i] = p[P_FREE + i] * z[SHOWN + VX + i]


def set_presliding_velocity(p: Floats, u: Floats, z: Floats, w: Floats, ahead: float) -> None:
    """Velocity of a presliding contact a time ``ahead`` of SHOWN, s, into ``w[W_STATE:]``."""
    load_moment(p, z, w)
    set_stick_velocity(p, u, w, p[P_PRESLIDING])
    for i in range(3):
        w[W_STATE + X + i] += ahead * w[W_STATE + VX + i]
    w[W_STATE + TIME] += ahead
    set_stick_velocity(p, u, w, p[P_PRESLIDING])


def keep_to_velocity(p: Floats, z: Floats, w: Floats) -> None:
    """Let the velocities of a stick at SHOWN follow those in ``w[W_STATE:]``; as `set_slopes`.

    Their rates follow from the load, or from places ahead, and from the acceleration of the
    surface. What that leaves a state behind goes at the motion's own rate. What the rates make of
    the kinetic energy is the surface's work, see `stick.held_energy`: the ledger is closed.
    """
    for i in range(3):
        if p[P_SCALES + i] > 0.0:
            behind = w[W_STATE + VX + i] - z[SHOWN + VX + i]
            rate = w[W_SLOPES + VX - 1 + i] + p[P_RATE] * behind
            w[W_SLOPES + VX - 1 + i] = rate
            w[W_SLOPES + WORK_SURFACE - 1] += p[P_MASS + i] * z[SHOWN + VX + i] * rate


def set_rates_in_stick(p: Floats, u: Floats, z: Floats, w: Floats) -> None:
    """Slopes of a stick without presliding, into ``w[W_SLOPES:]``."""
    set_slopes(p, u, w, STICK, W_SLOPES)
    work = 0.0
    for i in range(3):
        if p[P_SCALES + i] > 0.0:
            work += p[P_FREE + i] * w[W_SURFACE + 3 + i] * w[W_SURFACE + i] * p[P_MASS + i]
    w[W_SLOPES + WORK_SURFACE - 1] -= work
    keep_to_velocity(p, z, w)


def set_rates_in_presliding(p: Floats, u: Floats, z: Floats, w: Floats) -> None:
    """Slopes of a stick with presliding, into ``w[W_SLOPES:]``.

    Velocities follow from places there; their rates are central differences along the motion.
    """
    load_moment(p, z, w)
    set_slopes(p, u, w, STICK, W_SLOPES)
    ahead = LOOK_AHEAD / p[P_RATE]
    set_presliding_velocity(p, u, z, w, ahead)
    for i in range(3):
        w[W_RATES + i] = w[W_STATE + VX + i]
    set_presliding_velocity(p, u, z, w, -ahead)
    for i in range(3):
        if p[P_SCALES + i] > 0.0:
            w[W_SLOPES + VX - 1 + i] = (w[W_RATES + i] - w[W_STATE + VX + i]) / (2.0 * ahead)
    set_presliding_velocity(p, u, z, w, 0.0)
    keep_to_velocity(p, z, w)


def set_exchanged_rates(p: Floats, u: Floats, z: Floats, w: Floats, s: Floats) -> None:
    """Rates of the continuous states at SHOWN, into ``s``."""
    load_moment(p, z, w)
    mode = z[SHOWN + MODE]
    if has_bristles(p) or z[SHOWN + QUASI_STEADY] == 1.0:  # the latter where `advance` has led
        set_slopes(p, u, w, mode, W_SLOPES)
    elif mode == SLIP:
        set_rates_in_slip(p, u, z, w)
    elif p[P_PRESLIDING] != 0.0:
        set_rates_in_presliding(p, u, z, w)
    else:
        set_rates_in_stick(p, u, z, w)
    for i in range(STATES):
        s[i] = w[W_SLOPES + i]
    s[STATES] = mode


# --- event indicators -------------------------------------------------------------------------


def stick_reserve(p: Floats, u: Floats, z: Floats, w: Floats) -> float:
    """What is left to the load of a stick at SHOWN up to the limit, relative to the limit."""
    load_moment(p, z, w)
    set_stick_velocity(p, u, w, p[P_PRESLIDING])
    if p[P_PRESLIDING] == 0.0:
        set_contact(p, u, w, W_STATE)
        set_holding_load(p, w)
    return 1.0 - judged_ratio(p, u, w)


def set_indicators(p: Floats, u: Floats, z: Floats, w: Floats, g: Floats) -> None:
    """Event indicators at SHOWN, into ``g``: above 0 until their event, with 1 for none.

    The last is at the same time that of the inputs, see `rig.history.course_reserve`.
    """
    g[1] = 1.0
    g[2] = 1.0
    if has_bristles(p):
        g[0] = -mode_excess(p, u, z, w, SHOWN)
        return
    if z[SHOWN + MODE] == STICK:
        g[0] = stick_reserve(p, u, z, w)
        return
    load_moment(p, z, w)
    set_contact(p, u, w, W_STATE)
    slow = slowest_slip(p, u)
    speed = scaled_sliding_speed(w)
    g[0] = sliding_along(p, z, w, SHOWN)
    if z[Z_SLIDING] == SLIDING_BEGINS:
        g[0] += TURNED_BACK * slow
    g[0] /= speed_scale(p, u)
    if z[Z_SLIDING] != SLIDING_GOES_ON:
        g[1] = WELL_ON - speed / slow
    elif p[P_LATERAL] > 0.0:  # on a line the velocity itself passes zero
        g[1] = (speed - slow) / speed_scale(p, u)
        if z[Z_FASTER] > 0.0:
            g[2] = 1.0 - speed / z[Z_FASTER]


# --- events -----------------------------------------------------------------------------------


def begin_exchange(p: Floats, u: Floats, z: Floats, w: Floats) -> None:
    """Hand a run that `advance` has begun over to a host's integrator."""
    set_ramp(p, z)
    settle_sliding(p, u, z, w)


def set_ramp(p: Floats, z: Floats) -> None:
    """Say whether the surface is in its speed ramp at SHOWN, by the time."""
    z[Z_RAMPING] = 0.0
    if z[SHOWN + TIME] < p[P_RUN_UP]:
        z[Z_RAMPING] = 1.0


def settle_sliding(p: Floats, u: Floats, z: Floats, w: Floats) -> None:
    """Say which part of a slip SHOWN is in, after what `settle` has made of it."""
    if has_bristles(p):
        z[SHOWN + BRISTLES] = 1.0  # its shear is that of steady sliding where it has been left out
        return
    z[Z_SLIDING] = SLIDING_BEGINS
    if z[SHOWN + MODE] == STICK:
        return
    look_at(p, u, z, w, SHOWN)
    speed = scaled_sliding_speed(w)
    if speed > slowest_slip(p, u):
        slide_on(p, u, z, speed)
    if speed > 0.0 and sliding_along(p, z, w, SHOWN) < 0.0:  # nothing has stopped it: no friction
        set_direction(p, z, w, SHOWN, speed)


def slide_on(p: Floats, u: Floats, z: Floats, speed: float) -> None:
    """Let a slip go on at a sliding speed, m/s, up to the next event by its speed."""
    z[Z_SLIDING] = SLIDING_GOES_ON
    z[Z_FASTER] = FASTER * speed
    if speed > FAST_ENOUGH * speed_scale(p, u):
        z[Z_FASTER] = 0.0  # none


def end_stick(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats) -> None:
    """Let the stick at SHOWN break away if its load has reached the limit; make it exact."""
    look_at(p, u, z, w, SHOWN)
    stop_sliding(p, u, z, w, SHOWN, p[P_PRESLIDING])
    if excess_load(p, u, z, w, SHOWN, z[SHOWN + TIME]) < -AT_THE_LIMIT:
        return
    release(p, u, z, w, SHOWN)
    note_mode(p, z, w, e, SHOWN)
    settle_sliding(p, u, z, w)


def end_part_of_slip(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats) -> None:
    """Go from one part of a slip at SHOWN to the next, or let the contact settle.

    A host that looks for no events finds a slip reversed that has come to rest on the way: what
    the step has made of that is taken away. One that has found the event has only turned.
    """
    look_at(p, u, z, w, SHOWN)
    slow = slowest_slip(p, u)
    speed = scaled_sliding_speed(w)
    along = sliding_along(p, z, w, SHOWN)
    grip = holding_coefficient(p, u, w)  # without it nothing comes to rest
    if along < -REVERSED * speed and grip > 0.0:
        stop_sliding(p, u, z, w, SHOWN, 0.0)
    if z[Z_SLIDING] == SLIDING_BEGINS:
        along += TURNED_BACK * slow
    if along <= AT_THE_LIMIT * slow:
        settle(p, u, z, w, e, SHOWN)
        settle_sliding(p, u, z, w)
    elif z[Z_SLIDING] == SLIDING_GOES_ON:
        if p[P_LATERAL] > 0.0 and speed <= (1.0 + AT_THE_LIMIT) * slow:
            z[Z_SLIDING] = SLIDING_ENDS
            set_direction(p, z, w, SHOWN, speed)
        elif 0.0 < z[Z_FASTER] <= (1.0 + AT_THE_LIMIT) * speed:
            slide_on(p, u, z, speed)
            set_direction(p, z, w, SHOWN, speed)
    elif speed >= NEARLY * WELL_ON * slow:
        slide_on(p, u, z, speed)
        set_direction(p, z, w, SHOWN, speed)


def change_bristle_mode(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats) -> None:
    """Give the contact with bristles at SHOWN its other mode if it is beyond the present one."""
    if mode_excess(p, u, z, w, SHOWN) < -AT_THE_LIMIT:
        return
    switch_mode(p, z, w, e, SHOWN)


def update_event(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats, anew: bool) -> None:
    """Decide at an event what the contact does from SHOWN on, and make SHOWN consistent.

    ``anew``: inputs have jumped there, or parameters have changed.
    """
    if z[Z_RAMPING] == 1.0 and z[SHOWN + TIME] >= p[P_RUN_UP] * (1.0 - RAMP_ROUNDING):
        z[Z_RAMPING] = 0.0
        z[SHOWN + TIME] = max(z[SHOWN + TIME], p[P_RUN_UP])
    if anew:
        settle_contact(p, u, z, w, e)
        settle_sliding(p, u, z, w)
    elif has_bristles(p):
        change_bristle_mode(p, u, z, w, e)
    elif z[SHOWN + MODE] == STICK:
        end_stick(p, u, z, w, e)
    else:
        end_part_of_slip(p, u, z, w, e)


def complete_step(p: Floats, u: Floats, z: Floats, w: Floats) -> int:
    """Note the course of a slip at the end of a step of the host; DONE, or why it cannot go on.

    MODE_CHANGED where a stick has been carried beyond its limit: the host has to enter an event.
    """
    if z[SHOWN + MODE] == SLIP and z[Z_SLIDING] == SLIDING_GOES_ON and not has_bristles(p):
        look_at(p, u, z, w, SHOWN)
        speed = scaled_sliding_speed(w)
        if sliding_along(p, z, w, SHOWN) > 0.0 and speed > slowest_slip(p, u):
            set_direction(p, z, w, SHOWN, speed)
            if z[Z_FASTER] == 0.0 or z[Z_FASTER] > FASTER * speed:
                slide_on(p, u, z, speed)
    if p[P_SHORTEST] > 0.0 and shortest_spring(p, z, SHOWN) < p[P_SHORTEST]:
        return SPRING_COLLAPSED
    if z[SHOWN + MODE] == STICK and not has_bristles(p):
        if stick_reserve(p, u, z, w) < -AT_THE_LIMIT:
            return MODE_CHANGED
    return DONE


def show_moment(p: Floats, u: Floats, z: Floats, w: Floats, s: Floats, o: Floats) -> None:
    """Outputs at SHOWN into ``o``; the heat flow is the one of the moment. Rates into ``s``."""
    show(p, u, z, w, o, 0)
    set_exchanged_rates(p, u, z, w, s)
    o[O_HEAT_FLOW] = s[HEAT - 1]
