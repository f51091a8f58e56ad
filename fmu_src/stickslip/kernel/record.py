"""A whole run in one call: outputs at given times."""

from math import floor

from .advance import advance
from .events import look_at
from .layout import (
    DONE,
    HERE,
    HOLD_SINCE,
    MODE,
    O_FRICTION_X,
    O_MODE,
    O_SIZE,
    P_MU_S,
    P_NORMAL_FORCE,
    SHOWN,
    STICK,
    TIME,
    U_SPEED,
    Z_HAS_NEXT,
    Z_STARTED,
)
from .outputs import show
from .runge_kutta import follow_surface


def record(
    p: "float[:]",
    u: "float[:]",
    z: "float[:]",
    w: "float[:]",
    e: "float[:]",
    times: "float[:]",
    o: "float[:]",
    first: int,
    count: int,
) -> int:
    """Advance to ``times[first] ... times[first + count - 1]``, outputs row by row to ``o``.

    Returns the number of rows written: fewer than ``count`` where `advance` gave up.
    """
    for i in range(first, first + count):
        if advance(p, u, z, w, e, times[i]) != DONE:
            return i - first
        show(p, u, z, w, o, O_SIZE * i)
    return count


def change_speed(
    p: "float[:]", u: "float[:]", z: "float[:]", w: "float[:]", e: "float[:]", speed: float
) -> int:
    """Another speed of the surface for a block that sticks and goes on sticking."""
    since = z[SHOWN + HOLD_SINCE]
    u[U_SPEED] = speed
    look_at(p, u, z, w, SHOWN)
    follow_surface(p, u, z, w, SHOWN)
    z[Z_STARTED] = 0.0
    z[Z_HAS_NEXT] = 0.0
    status = advance(p, u, z, w, e, z[SHOWN + TIME])
    if z[SHOWN + MODE] == STICK:
        z[SHOWN + HOLD_SINCE] = since
        z[HERE + HOLD_SINCE] = since
    return status


def record_creeping(
    p: "float[:]",
    u: "float[:]",
    z: "float[:]",
    w: "float[:]",
    e: "float[:]",
    times: "float[:]",
    o: "float[:]",
    first: int,
    count: int,
    creep: float,
) -> int:
    """`record`, but in stick the surface leaves the block behind, as fast as its load says.

    creep : that speed along x, m/s, under the load p[P_MU_S] * p[P_NORMAL_FORCE]. The load is that
    of the row before, in twentieths: each change of the speed is a start anew.
    """
    if creep == 0.0:
        return record(p, u, z, w, e, times, o, first, count)
    speed = u[U_SPEED]
    for i in range(first, first + count):
        if record(p, u, z, w, e, times, o, i, 1) == 0:
            return i - first
        if o[O_SIZE * i + O_MODE] == STICK:
            load = o[O_SIZE * i + O_FRICTION_X] / (p[P_MU_S] * p[P_NORMAL_FORCE])
            slower = speed - floor(20.0 * load + 0.5) / 20.0 * creep
            if slower != u[U_SPEED] and change_speed(p, u, z, w, e, slower) != DONE:
                return i + 1 - first
        else:
            u[U_SPEED] = speed
    return count
