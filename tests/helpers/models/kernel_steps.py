"""Two kernels from the same memory: how far apart are they after one internal step?"""

from types import SimpleNamespace

import numpy as np
from stickslip import Parameters
from stickslip.kernel import advance, layout
from stickslip.kernel.runge_kutta import state_scale


def memory_of(
    parameters: Parameters, temperature: float = -8.0, film_thickness: float = 0.0
) -> SimpleNamespace:
    """The kernel's arrays as lists, settled at the start of a run."""
    u = [0.0] * layout.U_SIZE
    u[layout.U_SPEED], u[layout.U_TEMPERATURE] = parameters.surface.speed, temperature
    u[layout.U_FILM] = film_thickness
    memory = SimpleNamespace(p=parameters.pack(), u=u, z=[0.0] * layout.Z_SIZE)
    advance.initialise(memory.p, memory.z, 0.0)
    advance.take_inputs(memory.p, u, memory.z, [0.0] * layout.W_SIZE, [0.0] * layout.E_FIRST)
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
        status = advance.internal_step(p, u, z, [0.0] * layout.W_SIZE, [0.0] * layout.E_FIRST, 0.0)
        same = kernel.internal_step(
            other_p, other_u, other, np.zeros(layout.W_SIZE), np.zeros(layout.E_FIRST), 0.0
        )
        if status != same or [z[layout.NEXT + i] for i in (layout.MODE, layout.SLIPS)] != [
            other[layout.NEXT + i] for i in (layout.MODE, layout.SLIPS)
        ]:
            return np.inf
        largest = max(
            largest,
            _difference(p, u, z[layout.NEXT : layout.NEXT + layout.INSTANT], other[layout.NEXT :]),
        )
        if status != layout.DONE:
            break
        advance.copy_instant(z, layout.NEXT, layout.HERE)
    return largest


def _difference(p, u, block, other) -> float:
    unit = [*p]
    unit[layout.P_TOLERANCE] = 1.0  # state_scale is then the state's own scale
    scales = [1.0 / p[layout.P_RATE] + abs(block[layout.TIME])]
    scales += [
        max(state_scale(unit, u, i, block[i]), abs(block[i])) for i in range(1, 1 + layout.STATES)
    ]
    return max(abs(block[i] - other[i]) / scale for i, scale in enumerate(scales))
