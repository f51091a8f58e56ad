"""From one instant to another: internal steps, events, and the instants a caller asks for.

The integrator walks on its own grid, HERE to NEXT, and an instant asked for inside a step is
reached by a shorter step from HERE that leaves the grid alone. As long as the inputs do not
change, the trajectory therefore does not depend on when anybody looks at it.
"""

from math import isfinite

from .bristles.law import has_bristles
from .bristles.step import (
    choose_bristles,
    fast_slip_bound,
    finish_bristle_step,
    settle_bristles,
    stable_step,
)
from .contact import rest_speed, scaled_sliding_speed
from .events import (
    break_away,
    choose_sliding,
    keep_direction_steady,
    look_at,
    set_direction,
    settle,
    time_to_rest,
)
from .friction.coefficient import holding_coefficient, is_felt
from .interpolant import copy_instant, look_inside, set_interpolant
from .layout import *
from .motion import block_energy
from .rig.drive import set_surface_phase
from .rig.springs import shortest_spring
from .runge_kutta import begin_step, load_instant, take_step
from .steady_sliding import direction_is_free
from .terms import set_starting_states


def initialise(p: Floats, z: Floats, time: float) -> None:
    """Lay out a run that starts at ``time`` from the parameters' initial state."""
    for i in range(Z_SIZE):
        z[i] = 0.0
    z[SHOWN + TIME] = time
    for i in range(6):
        z[SHOWN + X + i] = p[P_INITIAL + i]
    z[SHOWN + MODE] = STICK
    z[SHOWN + DIRECTION] = 1.0
    z[SHOWN + BRISTLES] = UNKNOWN
    z[Z_STEP] = 0.01 / p[P_RATE]
    z[Z_ENERGY] = block_energy(p, z, SHOWN)
    z[Z_TIME_BEFORE] = time
    z[SHOWN + HOLD_SINCE] = time
    set_starting_states(p, z, SHOWN)


def longest_step(p: Floats, z: Floats, w: Floats, rest: float) -> float:
    """Bound on the internal step from HERE, s.

    A twelfth of the shortest period, so that no break-away is stepped over, in stick longer where
    its load is known to grow all along; the end of the speed ramp; and, where the block is coming
    to rest on the surface in the time ``rest``, most of that time: the approach is geometric, and
    faster the nearer it is, because the estimate's own error falls with the time that is left.
    """
    h = p[P_LONGEST_STEP]
    if z[HERE + MODE] == STICK:
        h = p[P_LONGEST_STICK]
    if z[HERE + TIME] < p[P_RUN_UP]:
        h = min(h, p[P_RUN_UP] - z[HERE + TIME])
    if rest > 0.0:
        h = min(h, rest * (1.0 - min(0.1, max(1e-4, 4.0 * rest * p[P_RATE]))))
    return h


def first_step(p: Floats, mode: float) -> float:
    """Step to try first in a mode, s: a slip gains speed as friction falls from mu_s to mu_k."""
    h = 0.1 / p[P_RATE]
    falls = (p[P_MU_S] - p[P_MU_K]) * p[P_NORMAL_FORCE]
    if mode == SLIP and falls > 0.0 and p[P_TRANSITION_SPEED] > 0.0:
        h = min(h, 3.0 * p[P_MASS] * p[P_TRANSITION_SPEED] / falls)
    return h


def sliding_along(p: Floats, z: Floats, w: Floats, at: int) -> float:
    """Sliding velocity in ``w`` along the direction of an instant, m/s: below 0 if reversed."""
    along = 0.0
    for i in range(3):
        along += w[W_SCALED + i] * z[at + DIRECTION + i]
    return along


def try_step(p: Floats, u: Floats, z: Floats, w: Floats, bound: float, grip: float) -> float:
    """Step from HERE to NEXT that passes the error test; returns its error, or -1 on failure.

    A slip that would come out reversed is stepped over its end: the step is halved until it
    stops short of it, or is too short to tell. ``grip`` is what the contact can hold, per load.
    ``z[Z_STEP]`` becomes the step to try next. In slip, the contact at NEXT is left in ``w``.
    """
    h = min(z[Z_STEP], bound)
    good = h  # as far as the error test knows
    finest = 1e-15 * max(1.0, abs(z[HERE + TIME]))
    error = 2.0
    while error > 1.0:
        if h < finest:
            return -1.0
        error = take_step(p, u, z, w, HERE, NEXT, h)
        if h == p[P_RUN_UP] - z[HERE + TIME]:
            z[NEXT + TIME] = p[P_RUN_UP]
        if not isfinite(error):
            error = 1e8
        if error > 1.0:
            h *= max(0.1, 0.9 * error ** (-0.125))
            good = h
        elif z[HERE + MODE] == SLIP:
            look_at(p, u, z, w, NEXT)
            moves = scaled_sliding_speed(w) > rest_speed(p, u)
            if sliding_along(p, z, w, HERE) < 0.0 and grip > 0.0 and moves and h > 16.0 * finest:
                error = 2.0
                h *= 0.5
                load_instant(p, z, w, HERE)
    z[Z_STEP] = h * min(8.0, 0.9 * max(error, 1e-12) ** (-0.125))
    if h < good:  # only the end of the slip has shortened it
        z[Z_STEP] = max(z[Z_STEP], good)
    return error


def finish_slip_step(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats) -> None:
    """Note the course of a slip at NEXT, or settle the contact where the slip has turned round.

    Takes the contact at NEXT that `try_step` has left in ``w``.
    """
    speed = scaled_sliding_speed(w)
    if sliding_along(p, z, w, HERE) < 0.0:
        settle(p, u, z, w, e, NEXT)
    elif z[NEXT + QUASI_STEADY] == 1.0:
        keep_direction_steady(p, u, z, w, NEXT)
    elif speed > rest_speed(p, u):
        set_direction(p, z, w, NEXT, speed)


def land(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats, rest: float) -> None:
    """Last step of a slip: the time to rest in one go, then stick or a new slip.

    Where what is left of the sliding has turned away from the frozen friction, the landing misses;
    then the block is stopped where it is.
    """
    speed = scaled_sliding_speed(w)
    take_step(p, u, z, w, HERE, NEXT, rest)
    look_at(p, u, z, w, NEXT)
    if scaled_sliding_speed(w) > 0.1 * speed:
        copy_instant(z, HERE, NEXT)
    settle(p, u, z, w, e, NEXT)


def spring_status(p: Floats, z: Floats) -> int:
    """DONE, or why a run cannot go on from NEXT."""
    if p[P_SHORTEST] > 0.0 and shortest_spring(p, z, NEXT) < p[P_SHORTEST]:
        return SPRING_COLLAPSED
    return DONE


def bristle_step(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats, cap: float) -> int:
    """As `internal_step`, of a contact with bristles; the slopes at HERE are in ``w``."""
    choose_bristles(p, u, z, w)
    bound = longest_step(p, z, w, -1.0)
    if cap > 0.0:
        bound = min(bound, cap)
    if z[HERE + BRISTLES] == 0.0:
        slow = fast_slip_bound(p, w)
        if slow > 0.0:
            bound = min(bound, slow)
    else:
        bound = min(bound, stable_step(p, w))
    if try_step(p, u, z, w, bound, 0.0) < 0.0:
        return STEP_VANISHED
    finish_bristle_step(p, u, z, w, e)
    if z[NEXT + BRISTLES] != z[HERE + BRISTLES]:
        z[Z_STEP] = 0.1 / p[P_RATE]
    return spring_status(p, z)


def internal_step(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats, cap: float) -> int:
    """One step of the integrator's own grid: fills NEXT, events at its end included."""
    begin_step(p, u, z, w, HERE)
    if has_bristles(p):
        return bristle_step(p, u, z, w, e, cap)
    rest = -1.0
    grip = holding_coefficient(p, u, w)  # without it there is no coming to rest
    if z[HERE + MODE] == SLIP and grip > 0.0:
        if direction_is_free(p):
            choose_sliding(p, u, z, w)
        rest = time_to_rest(p, u, w)
    to_run_up = p[P_RUN_UP] - z[HERE + TIME]
    slow = scaled_sliding_speed(w) <= rest_speed(p, u)
    # a landing that takes longer is no landing, and none crosses the end of the speed ramp
    if slow and 0.0 < rest and rest * p[P_RATE] < 1e-3 and not 0.0 < to_run_up < rest:
        land(p, u, z, w, e, rest)
    else:
        bound = longest_step(p, z, w, rest)
        if cap > 0.0:
            bound = min(bound, cap)
        error = try_step(p, u, z, w, bound, grip)
        if error < 0.0:
            return STEP_VANISHED
        if z[HERE + MODE] == STICK:
            break_away(p, u, z, w, e)
        else:
            finish_slip_step(p, u, z, w, e)
    if z[NEXT + MODE] != z[HERE + MODE]:
        z[Z_STEP] = first_step(p, z[NEXT + MODE])
    return spring_status(p, z)


def settle_contact(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats) -> None:
    """Decide what the contact does at SHOWN."""
    if has_bristles(p):
        settle_bristles(p, u, z, w, e, SHOWN)
    else:
        settle(p, u, z, w, e, SHOWN)


def has_just_begun(p: Floats, u: Floats, z: Floats, w: Floats) -> bool:
    """Is SHOWN a break-away that the last call has stopped at, from where the slip has to go on?

    Its load was at the limit. Judged anew, by inputs that differ by a rounding or by what they
    become, the contact would stick for a moment and break away a second time. What has begun to
    slide goes on with kinetic friction, and if that is too much for it, comes to rest.
    """
    if z[Z_STATUS] != MODE_CHANGED or z[SHOWN + MODE] != SLIP or has_bristles(p):
        return False
    look_at(p, u, z, w, SHOWN)
    return scaled_sliding_speed(w) <= rest_speed(p, u)


def take_inputs(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats) -> int:
    """Start afresh from SHOWN where inputs that matter have changed; 1 if so in mid-run.

    A temperature or a film of water that friction does not feel is no change.
    """
    changed = 0
    for i in range(U_SIZE):
        if z[Z_INPUTS + i] != u[i] and is_felt(p, u, i):
            changed = 1
        z[Z_INPUTS + i] = u[i]
    if z[Z_STARTED] == 0.0:
        z[Z_STARTED] = 1.0
        settle_contact(p, u, z, w, e)
        z[SHOWN + SLIPS] = 0.0  # a run that starts in slip has not broken away
        e[E_COUNT] = 0.0
        copy_instant(z, SHOWN, HERE)
        return 0
    if changed == 1:
        if not has_just_begun(p, u, z, w):
            settle_contact(p, u, z, w, e)
        copy_instant(z, SHOWN, HERE)
        z[Z_HAS_NEXT] = 0.0
    return changed


def walk(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats, end: float, stops: bool) -> int:
    """Bring SHOWN to the time ``end``, or only to the next change of mode if it ``stops`` there.

    After a change of inputs the first internal step ends at ``end``: whoever changes the inputs
    at every communication point pays for no step that the next change would discard.
    """
    z[Z_TIME_BEFORE] = z[SHOWN + TIME]
    z[Z_HEAT_BEFORE] = z[SHOWN + HEAT]
    budget = min(STEPS_AT_LEAST + STEPS_PER_SECOND * (end - z[SHOWN + TIME]), STEPS_AT_MOST)
    changed = take_inputs(p, u, z, w, e)
    outcome = DONE
    while outcome == DONE and z[SHOWN + TIME] < end:
        if z[Z_HAS_NEXT] == 0.0:
            cap = 0.0
            if changed == 1:
                cap = end - z[HERE + TIME]
            status = internal_step(p, u, z, w, e, cap)
            budget -= 1.0
            if budget < 0.0:
                status = TOO_STIFF
            z[Z_STATUS] = status
            if status != DONE:
                copy_instant(z, HERE, SHOWN)
                return status
            z[Z_HAS_NEXT] = 1.0
            if z[NEXT + TIME] > end:
                set_interpolant(p, u, z, w)
        gap = end - z[NEXT + TIME]
        same = abs(gap) <= 4e-16 * abs(end)
        if gap >= 0.0 or same:
            if stops and z[NEXT + MODE] != z[HERE + MODE]:
                outcome = MODE_CHANGED
            copy_instant(z, NEXT, HERE)
            copy_instant(z, NEXT, SHOWN)
            z[Z_HAS_NEXT] = 0.0
            if same:
                z[SHOWN + TIME] = end
        else:
            set_surface_phase(p, w, z[HERE + TIME])  # the step may be one of an earlier call
            look_inside(p, u, z, w, end)
    for i in range(INSTANT):
        if not isfinite(z[SHOWN + i]):
            z[Z_STATUS] = NOT_FINITE
            return NOT_FINITE
    z[Z_STATUS] = outcome
    return outcome


def advance(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats, end: float) -> int:
    """Bring SHOWN to the time ``end``; returns DONE or the reason why not."""
    return walk(p, u, z, w, e, end, False)


def advance_to_event(p: Floats, u: Floats, z: Floats, w: Floats, e: Floats, end: float) -> int:
    """As `advance`, but a change of mode on the way ends it there; MODE_CHANGED then.

    Stick and slip are the integrator's own instants, so the motion is the same whether or not
    anybody stops at them. A change that new inputs bring about at once is none on the way.
    """
    return walk(p, u, z, w, e, end, True)
