"""Inputs of model exchange between the times at which a host gives them, and their rates.

A block that sticks follows the surface: what it loads the contact with depends on the surface's
acceleration, and no host of FMI 2.0 can give the rate of an input in model exchange. Some do not
even give the input at each time for which they ask for rates, as fmpy: there it is known at the
ends of steps only. So the last values are remembered with their times, and input and rate are those
of the polynomial through some of them,

    u(t) = u0 + u01 (t - t0) + u012 (t - t0) (t - t1) + ...,

Newton's, from the nearest time on, up to the degree `DEGREES` as long as each term is well below
the one before it: around a kink, or where the times lie far apart, a low one. Around a
break-away, where the host looks for it, the times get dense, and the rate as exact as it has to be.

What jumps in an event has no past: there the memory begins anew. A host that gives inputs at each
time for which it asks for rates and then leaves one as it is, holds it.
"""

from ..layout import *
from .drive import driven_acceleration, driven_speed, input_at, is_mean

# Of the motion's own time: what lies nearer than that says of a rate nothing but its rounding,
# which is of some 1e-16 of the input in this time. A kink is found as near as that.
CLOSE = 1e-6
# Of an input's size: by how much more it jumps than the memory can be off by.
JUMP = 1e-7
LATEST = 1e300  # s: later than any time
# Of the tolerance, relative to sizes that count: by how much a course may be missed.
ASTRAY = 10.0
FINEST = 1e-10  # such a tolerance: below it is the rounding of differences
SHRINKS = 0.1  # a term of the course of a smooth input, at most, relative to the one before it
AT_ITS_END = 0.01  # what an indicator may have left in its event


def move_moment(g: Floats, j: int, to: int) -> None:
    """Put the remembered moment ``j`` into the place ``to``."""
    g[G_MOMENT_TIME + to] = g[G_MOMENT_TIME + j]
    g[G_MOMENT_ASKED + to] = g[G_MOMENT_ASKED + j]
    for i in range(GIVEN_INPUTS):
        at = G_MOMENT_VALUE + i
        g[at + GIVEN_INPUTS * to] = g[at + GIVEN_INPUTS * j]


def forget_later(g: Floats, t: float) -> None:
    """Drop what is known of inputs behind the time t: it was of a step that the host takes back."""
    kept = 0
    for j in range(int(g[G_COUNT])):
        if g[G_MOMENT_TIME + j] <= t:
            move_moment(g, j, kept)
            kept += 1
    g[G_COUNT] = kept


def forget_close(p: Floats, g: Floats, t: float) -> None:
    """Drop what is known of inputs close to the time t of an event, which takes its place.

    The event is decided by the inputs that the host has found it with.
    """
    kept = 0
    for j in range(int(g[G_COUNT])):
        if abs(g[G_MOMENT_TIME + j] - t) >= CLOSE / p[P_RATE]:
            move_moment(g, j, kept)
            kept += 1
    g[G_COUNT] = kept


def counts_for_rates(g: Floats, j: int) -> bool:
    """Is the remembered moment ``j`` one of those by which rates are told?

    A host that looks for a kink asks for the inputs at many times: `course_reserve` needs these all
    the while.
    """
    later = 0
    for k in range(int(g[G_COUNT])):
        if g[G_MOMENT_TIME + j] < g[G_MOMENT_TIME + k] <= g[G_ACCEPTED]:
            later += 1
    return g[G_MOMENT_TIME + j] <= g[G_ACCEPTED] and later < DEGREES + 2


def furthest_moment(g: Floats, t: float) -> int:
    """Number of the remembered moment that says least of the time t, to be given up."""
    furthest = 0
    most = -1.0
    for j in range(int(g[G_COUNT])):
        apart = abs(g[G_MOMENT_TIME + j] - t)
        if apart > most and not counts_for_rates(g, j):
            furthest = j
            most = apart
    return furthest


def note_inputs(p: Floats, g: Floats, t: float, asked: float) -> None:
    """Remember the inputs as given for the time t; ``asked``: 1 where rates are asked for there.

    One that is close to another says nothing new, but where it is of the very same time.
    """
    slot = int(g[G_COUNT])
    for j in range(int(g[G_COUNT])):
        apart = abs(g[G_MOMENT_TIME + j] - t)
        if apart == 0.0:
            slot = j
            asked = max(asked, g[G_MOMENT_ASKED + j])
        elif apart < CLOSE / p[P_RATE]:
            return
    if slot == MOMENTS:
        slot = furthest_moment(g, t)
    g[G_COUNT] = max(g[G_COUNT], slot + 1.0)
    g[G_MOMENT_TIME + slot] = t
    g[G_MOMENT_ASKED + slot] = asked
    for i in range(GIVEN_INPUTS):
        g[G_MOMENT_VALUE + GIVEN_INPUTS * slot + i] = g[G_VALUE + i]


def find_nearest(g: Floats, t: float, until: float) -> int:
    """Numbers of remembered times from the nearest to t on, into ``g[G_NEAR:]``; how many.

    Of those up to ``until``, s.
    """
    found = 0
    last = -1.0
    while found < DEGREES + 2:
        best = -1
        for j in range(int(g[G_COUNT])):
            apart = abs(g[G_MOMENT_TIME + j] - t)
            nearer = best < 0 or apart < abs(g[G_MOMENT_TIME + best] - t)
            if g[G_MOMENT_TIME + j] <= until and apart > last and nearer:
                best = j
        if best < 0:
            return found
        g[G_NEAR + found] = best
        last = abs(g[G_MOMENT_TIME + best] - t)
        found += 1
    return found


def set_divided_differences(g: Floats, i: int, count: int) -> None:
    """Newton's divided differences of input i over the times of `find_nearest`, into
    ``g[G_TABLE:]``."""
    for k in range(count):
        g[G_TABLE + k] = g[G_MOMENT_VALUE + GIVEN_INPUTS * int(g[G_NEAR + k]) + i]
    for level in range(1, count):
        k = count - 1
        while k >= level:
            span = g[G_MOMENT_TIME + int(g[G_NEAR + k])]
            span -= g[G_MOMENT_TIME + int(g[G_NEAR + k - level])]
            g[G_TABLE + k] = (g[G_TABLE + k] - g[G_TABLE + k - 1]) / span
            k -= 1


def best_degree(g: Floats, count: int, t: float) -> int:
    """Degree of the polynomial, at least 1, from which on the terms left out no longer shrink at t.

    Around a kink none shrinks, and one that happens to be small says nothing.
    """
    best = 1
    least = -1.0
    part = 1.0
    for k in range(2, count):
        part *= t - g[G_MOMENT_TIME + int(g[G_NEAR + k - 1])]
        term = abs(g[G_TABLE + k] * part)
        if least >= 0.0 and term > SHRINKS * least:
            return best
        least = term
        best = k - 1
    return best


def set_course(g: Floats, i: int, count: int, t: float) -> None:
    """Input i and its rate at the time t, into ``g[G_COURSE:]``, by ``count`` times of
    `find_nearest`.

    By one alone it goes on with the rate that it begins with.
    """
    set_divided_differences(g, i, count)
    since = t - g[G_MOMENT_TIME + int(g[G_NEAR])]
    value = g[G_TABLE] + g[G_FIRST_RATE + i] * since
    rate = g[G_FIRST_RATE + i]
    if count > 1:
        k = best_degree(g, count, t)
        value = g[G_TABLE + k]
        rate = 0.0
        while k > 0:
            k -= 1
            since = t - g[G_MOMENT_TIME + int(g[G_NEAR + k])]
            rate = rate * since + value
            value = value * since + g[G_TABLE + k]
    g[G_COURSE] = value
    g[G_COURSE + 1] = rate


def follow_memory(g: Floats, t: float, until: float) -> None:
    """Inputs and their rates at the time t by what is remembered up to ``until``, s."""
    count = find_nearest(g, t, until)
    for i in range(GIVEN_INPUTS):
        set_course(g, i, count, t)
        g[G_FOLLOWED + i] = g[G_COURSE]
        g[G_TREND + i] = g[G_COURSE + 1]


def input_size(p: Floats, u: Floats, i: int) -> float:
    """A size of input i that counts; 0 for one whose course is not watched."""
    grip = max(p[P_MU_S], p[P_MU_K]) * p[P_NORMAL_FORCE]
    if i == U_SPEED:
        return max(abs(u[U_SPEED]), p[P_SPEED_SCALE])
    if i == U_FORCE_X or i == U_FORCE_Y:
        return grip
    if i == U_MOMENT:
        return grip * p[P_RADIUS]
    return 0.0


def reserve_by(p: Floats, u: Floats, g: Floats, t: float, until: float) -> float:
    """1 where the inputs as given at t keep to their course by what is remembered up to ``until``,
    s; below 0 where one is off by more than `ASTRAY` times the tolerance."""
    if t - until < CLOSE / p[P_RATE]:
        return 1.0
    count = find_nearest(g, t, until)
    allowed = ASTRAY * max(p[P_TOLERANCE], FINEST)
    reserve = 1.0
    for i in range(GIVEN_INPUTS):
        size = input_size(p, u, i)
        if count > 0 and size > 0.0:
            set_course(g, i, count, t)
            off = abs(g[G_VALUE + i] - g[G_COURSE]) / size
            reserve = min(reserve, 1.0 - off / allowed)
    return reserve


def course_reserve(p: Floats, u: Floats, g: Floats, t: float, sticks: bool) -> float:
    """Event indicator: is the input as given at t the one that the last rates were told for?

    It controls the error of their course, and finds kinks. A slip, which does not depend on an
    input's rate, needs that only where the host does not give inputs with every rate.
    """
    if g[G_SET_TIME] != t or t <= g[G_EVENT_TIME]:
        return 1.0
    if g[G_GIVES_ALWAYS] == 1.0 and not sticks:
        return 1.0
    return reserve_by(p, u, g, t, g[G_ACCEPTED])


def has_kink(p: Floats, u: Floats, g: Floats, t: float, sticks: bool) -> bool:
    """Has the event at the time t been found where an input has a kink?

    It has not where the input keeps to its course by what a host has given with the rates that it
    has asked for within the step, as Runge-Kutta methods do: the step was only too long.
    """
    if course_reserve(p, u, g, t, sticks) > AT_ITS_END:
        return False
    latest = g[G_ACCEPTED]
    for j in range(int(g[G_COUNT])):
        then = g[G_MOMENT_TIME + j]
        if g[G_MOMENT_ASKED + j] == 1.0 and t - then >= CLOSE / p[P_RATE]:
            latest = max(latest, then)
    return reserve_by(p, u, g, t, latest) <= AT_ITS_END


def hear_input(g: Floats, t: float, in_event: bool) -> None:
    """The host gives an input at the time t."""
    g[G_SET_TIME] = t
    g[G_IS_NEW] = 1.0
    if in_event:
        g[G_IN_EVENT] = 1.0


def put_followed(g: Floats, u: Floats, t: float) -> None:
    """Inputs and rates at the time t, into ``u``."""
    for i in range(GIVEN_INPUTS):
        u[i] = g[G_FOLLOWED + i] + g[G_ASIDE + i]
        if not is_mean(i):
            u[U_RATE + i] = g[G_TREND + i]
    u[U_FILM] = max(u[U_FILM], 0.0)
    u[U_SINCE] = t
    u[U_SPEED_CURVE] = 0.0


def follow_inputs(
    p: Floats, g: Floats, u: Floats, t: float, for_rates: bool, for_events: bool
) -> None:
    """Inputs at the time t, for which a host asks for something, into ``u``.

    ``for_rates``: it asks for rates. They, and the variables, among which they are too, are told by
    what is known of the steps that the host has accepted: what it may yet take back would make them
    others at each trial. ``for_events``: it looks for events, by all that is known.
    """
    given = g[G_SET_TIME] == t
    until = g[G_ACCEPTED]
    if for_events:
        until = LATEST
    asked = 0.0
    if for_rates:
        forget_later(g, t)
        if given and g[G_IS_NEW] == 1.0 and t != g[G_EVENT_TIME]:
            g[G_GIVES_ALWAYS] = 1.0
        asked = g[G_GIVES_ALWAYS]
    g[G_IS_NEW] = 0.0
    at_event = t == g[G_EVENT_TIME]  # a host may fall back behind a jump
    known = (given or g[G_GIVES_ALWAYS] == 1.0) and not at_event
    if known and g[G_IN_EVENT] == 0.0:
        note_inputs(p, g, t, asked)
    follow_memory(g, t, until)
    if known:
        for i in range(GIVEN_INPUTS):
            g[G_FOLLOWED + i] = g[G_VALUE + i]
    put_followed(g, u, t)


def has_jumped(g: Floats, i: int) -> bool:
    """Is input i, as given, another than the memory makes it in ``g[G_FOLLOWED:]``?"""
    size = abs(g[G_VALUE + i])
    for j in range(int(g[G_COUNT])):
        size = max(size, abs(g[G_MOMENT_VALUE + GIVEN_INPUTS * j + i]))
    return abs(g[G_VALUE + i] - g[G_FOLLOWED + i]) > JUMP * size


def moment_beside(p: Floats, g: Floats, t: float, ahead: float) -> int:
    """Number of the remembered moment next to the time t, but not close: ahead of it (1.0) or
    before it (-1.0); -1 for none."""
    found = -1
    least = LATEST
    for j in range(int(g[G_COUNT])):
        apart = ahead * (g[G_MOMENT_TIME + j] - t)
        if 0.5 * CLOSE / p[P_RATE] < apart < least:
            found = j
            least = apart
    return found


def begin_course(p: Floats, g: Floats, t: float) -> None:
    """Forget what was before the time t, where an input has a kink: its rate is that behind it.

    Where the host has not looked behind it, that from the last time on: it is right a moment after
    a kink, and where it is not the next event comes a moment later.
    """
    beside = moment_beside(p, g, t, 1.0)
    if beside < 0:
        beside = moment_beside(p, g, t, -1.0)
    for i in range(GIVEN_INPUTS):
        g[G_FIRST_RATE + i] = 0.0
        if beside >= 0:
            change = g[G_MOMENT_VALUE + GIVEN_INPUTS * beside + i] - g[G_VALUE + i]
            g[G_FIRST_RATE + i] = change / (g[G_MOMENT_TIME + beside] - t)
    g[G_COUNT] = 0.0
    note_inputs(p, g, t, 0.0)


def take_given(p: Floats, g: Floats, u: Floats, t: float, sticks: bool) -> bool:
    """Inputs in an event at the time t, into ``u``; has one jumped there?

    One that has, has no past and no known rate.
    """
    jumped = False
    follow_memory(g, t, LATEST)
    if g[G_IN_EVENT] == 1.0:
        for i in range(GIVEN_INPUTS):
            g[G_FIRST_RATE + i] = g[G_TREND + i]
            if has_jumped(g, i):
                jumped = True
                g[G_FIRST_RATE + i] = 0.0
    if jumped:
        g[G_COUNT] = 0.0
        note_inputs(p, g, t, 0.0)
    elif has_kink(p, u, g, t, sticks):
        begin_course(p, g, t)
    elif g[G_SET_TIME] == t:
        forget_close(p, g, t)
        note_inputs(p, g, t, 0.0)
    follow_memory(g, t, LATEST)  # as the host has found the event: by what lies behind it, too
    forget_later(g, t)
    g[G_IN_EVENT] = 0.0
    g[G_EVENT_TIME] = t
    g[G_ACCEPTED] = t
    put_followed(g, u, t)
    return jumped


def begin_memory(g: Floats, u: Floats, t: float) -> None:
    """Remember the inputs in ``u`` at the time t, and nothing before."""
    g[G_COUNT] = 1.0
    g[G_MOMENT_TIME] = t
    g[G_EVENT_TIME] = t
    g[G_ACCEPTED] = t
    for i in range(GIVEN_INPUTS):
        g[G_MOMENT_VALUE + i] = input_at(u, i, t)
        g[G_FIRST_RATE + i] = u[U_RATE + i]
    g[G_MOMENT_VALUE + U_SPEED] = driven_speed(u, t)
    g[G_FIRST_RATE + U_SPEED] = driven_acceleration(u, t)
