"""What a run shows at the instant that `advance` has reached, and a whole run in one call."""

from __future__ import annotations

from . import Floats
from .advance import advance
from .layout import *
from .motion import block_energy
from .rig.surface import surface_speed
from .runge_kutta import begin_step


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
    o[at + O_SURFACE_WORK] = z[SHOWN + WORK_SURFACE]
    o[at + O_EXTERNAL_WORK] = z[SHOWN + WORK_EXTERNAL]
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
) -> int:
    """Advance to ``times[first] ... times[first + count - 1]``, outputs row by row to ``o``.

    Returns the number of rows written: fewer than ``count`` where `advance` gave up.
    """
    for i in range(first, first + count):
        if advance(p, u, z, w, e, times[i]) != DONE:
            return i - first
        show(p, u, z, w, o, O_SIZE * i)
    return count


def track(
    p: Floats,
    u: Floats,
    z: Floats,
    w: Floats,
    e: Floats,
    times: Floats,
    o: Floats,
    first: int,
    count: int,
) -> int:
    """As `record`, but only what a tracker sees: x, y and phi, `TRACKED` numbers a row."""
    for i in range(first, first + count):
        if advance(p, u, z, w, e, times[i]) != DONE:
            return i - first
        for j in range(TRACKED):
            o[TRACKED * i + j] = z[SHOWN + X + j]
    return count
