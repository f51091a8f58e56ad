"""A run that is set to given states at given moments, in one call.

Positions and velocities are set; what cannot be seen of a block - the heat and the age of its
contact, the distance slid, the place on the surface - goes on from the model's own past.
"""

from __future__ import annotations

from math import isfinite

from . import Floats
from .advance import advance
from .layout import *
from .outputs import record, track
from .rest import look_at
from .runge_kutta import follow_surface


def restart(
    p: Floats, u: Floats, z: Floats, w: Floats, e: Floats, times: Floats, r: Floats, at: int
) -> None:
    """Reach the time of restart ``r[at:]`` by the model's own motion, then be as that says."""
    time = times[int(r[at + R_ROW])]
    past = z[Z_STARTED]
    if past == 1.0:
        advance(p, u, z, w, e, time)
    p[P_MU_S] = r[at + R_MU_S]
    p[P_MU_K] = r[at + R_MU_K]
    p[P_MU_SCALE] = r[at + R_MU_SCALE]
    z[SHOWN + TIME] = time
    given = 0
    for i in range(6):
        if isfinite(r[at + R_STATE + i]):
            z[SHOWN + X + i] = r[at + R_STATE + i]
            given = 1
    if given == 1:  # the shear of the contact belongs to what it was set to
        z[SHOWN + BRISTLES] = UNKNOWN
    if isfinite(r[at + R_HOLD_SINCE]):
        # a stick's velocity is the surface's; it preslides from there
        z[SHOWN + MODE] = STICK
        z[SHOWN + HOLD_SINCE] = r[at + R_HOLD_SINCE]
        z[SHOWN + BRISTLES] = HELD
        look_at(p, u, z, w, SHOWN)
        follow_surface(p, u, z, w, SHOWN, 0.0)
    elif past == 1.0 and isfinite(r[at + R_STATE + VX - X]):
        z[SHOWN + MODE] = SLIP  # how the model moved before must not decide
    z[Z_STARTED] = 0.0
    z[Z_HAS_NEXT] = 0.0
    advance(p, u, z, w, e, time)


def end_row(r: Floats, number: int, restarts: int, rows: int) -> int:
    """Row before which the motion from a restart ends: the next one's, or the number of rows."""
    if number + 1 < restarts:
        return int(r[(number + 1) * R_SIZE + R_ROW])
    return rows


def record_restarted(
    p: Floats,
    u: Floats,
    z: Floats,
    w: Floats,
    e: Floats,
    times: Floats,
    o: Floats,
    rows: int,
    r: Floats,
    restarts: int,
) -> None:
    """Outputs at ``times[0] ... times[rows - 1]``, as `record` writes them, with so many restarts.

    Where `advance` gives up, what is in ``o`` stays there up to the next restart.
    """
    for i in range(restarts):
        restart(p, u, z, w, e, times, r, i * R_SIZE)
        first = int(r[i * R_SIZE + R_ROW])
        record(p, u, z, w, e, times, o, first, end_row(r, i, restarts, rows) - first)


def track_restarted(
    p: Floats,
    u: Floats,
    z: Floats,
    w: Floats,
    e: Floats,
    times: Floats,
    o: Floats,
    rows: int,
    r: Floats,
    restarts: int,
) -> None:
    """As `record_restarted`, but only what a tracker sees, as `track` writes it."""
    for i in range(restarts):
        restart(p, u, z, w, e, times, r, i * R_SIZE)
        first = int(r[i * R_SIZE + R_ROW])
        track(p, u, z, w, e, times, o, first, end_row(r, i, restarts, rows) - first)
