"""What a run shows at the instant that `advance` has reached, and a whole run in one call.

Also one that is set to given states at given moments. Positions and velocities are set; what cannot
be seen of a block - the heat and the age of its contact, the distance slid, the place on the
surface - goes on from the model's own past.
"""

from math import isfinite

from .advance import advance
from .events import look_at
from .layout import *
from .motion import block_energy
from .rig.drive import surface_speed
from .runge_kutta import begin_step, follow_surface


def energy_residual(p: Floats, z: Floats) -> float:
    """Energy gained less energy supplied, J: zero but for the integrator's error.

    (kinetic + elastic) - its start - work of surface and external loads + friction heat + damping.
    """
    gained = block_energy(p, z, SHOWN) - z[Z_ENERGY]
    supplied = z[SHOWN + WORK_SURFACE] + z[SHOWN + WORK_EXTERNAL]
    return gained - supplied + z[SHOWN + HEAT] + z[SHOWN + DAMPED]


def mean_heat_flow(z: Floats) -> float:
    """Friction heat of the last call of `advance` over its duration, W."""
    duration = z[SHOWN + TIME] - z[Z_TIME_BEFORE]
    if duration <= 0.0:
        return 0.0
    return (z[SHOWN + HEAT] - z[Z_HEAT_BEFORE]) / duration


def show(p: Floats, u: Floats, z: Floats, w: Floats, o: Floats, at: int) -> None:
    """Write the outputs (`O_*`) at SHOWN to ``o[at:]``."""
    begin_step(p, u, z, w, SHOWN)
    for i in range(6):
        o[at + O_X + i] = z[SHOWN + X + i]
    for i in range(3):
        o[at + O_FRICTION_X + i] = w[W_FRICTION + i]
    o[at + O_SLIDING_SPEED] = w[W_MEAN_SPEED]
    o[at + O_HEAT_FLOW] = mean_heat_flow(z)
    o[at + O_HEAT] = z[SHOWN + HEAT]
    o[at + O_DISTANCE] = z[SHOWN + DISTANCE]
    o[at + O_MODE] = z[SHOWN + MODE]
    o[at + O_SLIPS] = z[SHOWN + SLIPS]
    o[at + O_ENERGY_RESIDUAL] = energy_residual(p, z)
    o[at + O_TRAVEL] = z[SHOWN + TRAVEL]
    o[at + O_DAMPED] = z[SHOWN + DAMPED]
    o[at + O_WORK_SURFACE] = z[SHOWN + WORK_SURFACE]
    o[at + O_WORK_EXTERNAL] = z[SHOWN + WORK_EXTERNAL]
    o[at + O_SLIP_TIME] = z[SHOWN + SLIP_TIME]
    o[at + O_SURFACE_SPEED] = surface_speed(p, u, w, z[SHOWN + TIME])


def record(
    p: Floats,
    u: Floats,
    z: Floats,
    w: Floats,
    e: Floats,
    times: Floats,
    o: Floats,
    first: int,
    count: int,
    whole: bool,
) -> int:
    """Advance to ``times[first] ... times[first + count - 1]``, outputs row by row to ``o``.

    If not ``whole``, what a tracker sees: x, y and phi, `TRACKED` numbers a row. Returns the number
    of rows written: fewer than ``count`` where `advance` gave up.
    """
    for i in range(first, first + count):
        if advance(p, u, z, w, e, times[i]) != DONE:
            return i - first
        if whole:
            show(p, u, z, w, o, O_SIZE * i)
        else:
            for j in range(TRACKED):
                o[TRACKED * i + j] = z[SHOWN + X + j]
    return count


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
    whole: bool,
) -> None:
    """Outputs at ``times[0] ... times[rows - 1]``, as `record` writes them, with so many restarts.

    Where `advance` gives up, what is in ``o`` stays there up to the next restart.
    """
    for i in range(restarts):
        restart(p, u, z, w, e, times, r, i * R_SIZE)
        first = int(r[i * R_SIZE + R_ROW])
        end = rows
        if i + 1 < restarts:
            end = int(r[(i + 1) * R_SIZE + R_ROW])
        record(p, u, z, w, e, times, o, first, end - first, whole)
