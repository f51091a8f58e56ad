"""Two kernels from the same memory: how far apart are they after one internal step?"""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
from stickslip import Parameters
from stickslip.kernel import advance
from stickslip.kernel.layout import (
    DONE,
    E_FIRST,
    HERE,
    INSTANT,
    MODE,
    NEXT,
    P_RATE,
    P_TOLERANCE,
    SLIPS,
    STATES,
    TIME,
    U_FILM,
    U_SIZE,
    U_SPEED,
    U_TEMPERATURE,
    W_SIZE,
    Z_SIZE,
)
from stickslip.kernel.runge_kutta import state_scale


def memory_of(
    parameters: Parameters, temperature: float = -8.0, film_thickness: float = 0.0
) -> SimpleNamespace:
    """The kernel's arrays as lists, settled at the start of a run."""
    u = [0.0] * U_SIZE
    u[U_SPEED], u[U_TEMPERATURE] = parameters.surface.speed, temperature
    u[U_FILM] = film_thickness
    memory = SimpleNamespace(p=parameters.pack(), u=u, z=[0.0] * Z_SIZE)
    advance.initialise(memory.p, memory.z, 0.0)
    advance.take_inputs(memory.p, u, memory.z, [0.0] * W_SIZE, [0.0] * E_FIRST)
    return memory


def largest_step_difference(
    kernel, memory: SimpleNamespace, steps: int, other_p: list[float] | None = None
) -> float:
    """Largest difference of any state after one internal step, relative to the state's scale.

    Before each step ``kernel`` (numpy arrays) gets a copy of the interpreted kernel's memory, so
    that nothing accumulates. The scale of a state is its value or what it comes to in a run of this
    rig, whichever is larger. A different mode, count of slips or ending counts as infinite.
    """
    p, u, z = memory.p, memory.u, list(memory.z)
    other_p, other_u = np.array(p if other_p is None else other_p), np.array(u)
    largest = 0.0
    for _ in range(steps):
        other = np.array(z)
        status = advance.internal_step(p, u, z, [0.0] * W_SIZE, [0.0] * E_FIRST, 0.0)
        same = kernel.internal_step(
            other_p, other_u, other, np.zeros(W_SIZE), np.zeros(E_FIRST), 0.0
        )
        if status != same or [z[NEXT + i] for i in (MODE, SLIPS)] != [
            other[NEXT + i] for i in (MODE, SLIPS)
        ]:
            return np.inf
        largest = max(largest, _difference(p, u, z[NEXT : NEXT + INSTANT], other[NEXT:]))
        if status != DONE:
            break
        advance.copy_instant(z, NEXT, HERE)
    return largest


def _difference(p, u, block, other) -> float:
    unit = [*p]
    unit[P_TOLERANCE] = 1.0  # state_scale is then the state's own scale
    scales = [1.0 / p[P_RATE] + abs(block[TIME])]
    scales += [max(state_scale(unit, u, i, block[i]), abs(block[i])) for i in range(1, 1 + STATES)]
    return max(abs(block[i] - other[i]) / scale for i, scale in enumerate(scales))
