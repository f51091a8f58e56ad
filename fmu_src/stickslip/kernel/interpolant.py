"""The moments inside an internal step: DOP853's interpolant of order 7.

Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, 2nd ed., section II.6: a
polynomial of degree 7 in the part t of the step gone by, with the values and slopes of both ends
and four further coefficients from three more stages,

    y = y_0 + t (F_0 + (1 - t) (F_1 + t (F_2 + (1 - t) (F_3 + t (F_4 + (1 - t) (F_5 + t F_6)))))).

It is made once for a step, when an instant inside it is asked for, and then tells how well it obeys
the equations of motion. Where it does not, in the first instants of a slip that turns at once, such
an instant is reached by steps of the integrator that leave its own grid alone.
"""

from math import isfinite

from .bristles.law import has_bristles
from .layout import *
from .runge_kutta import add_stage, begin_step, finish_stick, load_instant, state_scale, take_step


def copy_instant(z: Floats, source: int, target: int) -> None:
    """Copy one instant in ``z`` over another."""
    for i in range(INSTANT):
        z[target + i] = z[source + i]


def set_interpolant(p: Floats, u: Floats, z: Floats, w: Floats) -> None:
    """Interpolant over the step from HERE whose stages ``w`` still holds, into ``z[Z_DENSE:]``.

    It counts as smooth up to an error of 10 in the unit of the error test; 3 is usual. Its defect
    (see `defect`) is 8 times its error where the motion is smooth, and no less than 3 times else:
    found over 17 000 steps of random rigs with every effect.
    """
    h = w[W_SPAN]
    z[Z_SPAN] = h
    load_instant(p, z, w, HERE)  # surface phase and direction of the step
    for stage in range(STAGES, ALL_STAGES):
        add_stage(p, u, z, w, HERE, stage)
    for i in range(STATES):
        change = STAGE_WEIGHTS[END_OF_STEP] * w[W_SLOPES + i]
        for stage in range(LATE, STAGES):
            change += STAGE_WEIGHTS[END_OF_STEP + stage] * w[W_SLOPES + stage * STATES + i]
        first = w[W_SLOPES + i]
        last = w[W_SLOPES + STAGES * STATES + i]
        z[Z_DENSE + i] = h * change
        z[Z_DENSE + STATES + i] = h * (first - change)
        z[Z_DENSE + 2 * STATES + i] = h * (2.0 * change - first - last)
    for power in range(EXTRA_POWERS):
        row = power * ALL_STAGES
        for i in range(STATES):
            total = INTERPOLANT_WEIGHTS[row] * w[W_SLOPES + i]
            for stage in range(LATE, ALL_STAGES):
                total += INTERPOLANT_WEIGHTS[row + stage] * w[W_SLOPES + stage * STATES + i]
            z[Z_DENSE + (POWERS - EXTRA_POWERS + power) * STATES + i] = h * total
    z[Z_SMOOTH] = 0.0
    if defect(p, u, z, w, 0.7) < 80.0:
        z[Z_SMOOTH] = 1.0


def interpolate(p: Floats, u: Floats, z: Floats, w: Floats, target: int, time: float) -> None:
    """The instant ``time`` of the step from HERE by the interpolant, into instant ``target``."""
    t = (time - z[HERE + TIME]) / z[Z_SPAN]
    r = 1.0 - t
    copy_instant(z, HERE, target)
    z[target + TIME] = time
    if z[target + MODE] == SLIP:
        z[target + SLIP_TIME] += time - z[HERE + TIME]
    for i in range(STATES):
        at = Z_DENSE + i
        y = (z[at + 5 * STATES] + t * z[at + 6 * STATES]) * r
        y = ((y + z[at + 4 * STATES]) * t + z[at + 3 * STATES]) * r
        y = ((y + z[at + 2 * STATES]) * t + z[at + STATES]) * r
        z[target + 1 + i] += (y + z[at]) * t
    if z[target + MODE] == STICK and not has_bristles(p):
        finish_stick(p, u, z, w, HERE, target)


def interpolated_change(z: Floats, i: int, t: float) -> float:
    """Derivative of the interpolant of state i with respect to the part t of the step."""
    r = 1.0 - t
    y = 0.0
    change = 0.0
    for power in range(POWERS - 1, -1, -1):
        y += z[Z_DENSE + power * STATES + i]
        if power % 2 == 0:
            change = change * t + y
            y *= t
        else:
            change = change * r - y
            y *= r
    return change


def defect(p: Floats, u: Floats, z: Floats, w: Floats, t: float) -> float:
    """How far the interpolant is from obeying the equations of motion at a part t of the step.

    The largest difference between its derivative and the slope there, times the step, in the unit
    of the error test.
    """
    interpolate(p, u, z, w, BETWEEN, z[HERE + TIME] + t * z[Z_SPAN])
    begin_step(p, u, z, w, BETWEEN)
    largest = 0.0
    for i in range(STATES):
        off = interpolated_change(z, i, t) - z[Z_SPAN] * w[W_SLOPES + i]
        scale = state_scale(p, u, i + 1, z[BETWEEN + 1 + i])
        largest = max(largest, abs(off) / scale)
    return largest


def approach(p: Floats, u: Floats, z: Floats, w: Floats, time: float) -> None:
    """The instant ``time`` of the step from HERE by steps that pass the error test, into SHOWN.

    They become no finer than 2^-12 of the integrator's own, which has passed that test as a whole.
    """
    copy_instant(z, HERE, SHOWN)
    finest = z[Z_SPAN] / 4096.0
    h = time - z[SHOWN + TIME]
    while z[SHOWN + TIME] < time:
        begin_step(p, u, z, w, SHOWN)
        left = time - z[SHOWN + TIME]
        h = min(h, left)
        error = take_step(p, u, z, w, SHOWN, BETWEEN, h)
        if not isfinite(error):
            error = 1e8
        if error <= 1.0 or h <= finest:
            copy_instant(z, BETWEEN, SHOWN)
            if h == left:
                z[SHOWN + TIME] = time
        h *= min(8.0, max(0.1, 0.9 * max(error, 1e-12) ** (-0.125)))
        h = max(h, finest)


def look_inside(p: Floats, u: Floats, z: Floats, w: Floats, time: float) -> None:
    """The instant ``time`` of the step from HERE to NEXT, into SHOWN.

    What only grows stays between its ends: where friction dies away within the step, either way of
    getting there errs by more than the step's last joules.
    """
    if z[Z_SMOOTH] == 1.0:
        interpolate(p, u, z, w, SHOWN, time)
    else:
        approach(p, u, z, w, time)
    if not has_bristles(p):  # of which some heat may be booked at the step's end
        z[SHOWN + HEAT] = min(max(z[SHOWN + HEAT], z[HERE + HEAT]), z[NEXT + HEAT])
    z[SHOWN + DISTANCE] = min(max(z[SHOWN + DISTANCE], z[HERE + DISTANCE]), z[NEXT + DISTANCE])
