"""Cost of one compiled right-hand side.

    python tests/benchmarks right_hand_side [--json FILE]

prints ns for each kind of friction (median of several loops, each inside compiled code, so that no
call from Python is in it). What the quadrature over the contact errs is held to its bounds by
tests/verification/effects/test_effect_local_law.py.
"""

from functools import cache
from types import SimpleNamespace

import numpy as np
from baseline import Figure, arguments, write
from mechanics import median_seconds
from stickslip import Parameters
from stickslip.compiled import library
from stickslip.generation.source import kernel_source
from stickslip.kernel import layout

LOOPS = 200_000
PLANE = {"lateral_friction": {"ratio": 1.0}}
HYPERBOLIC = {"velocity_weakening": {"hyperbolic": 3.0}}
INVERSE_ROOT = {"velocity_weakening": {"inverse_root": 50.0}}
STRIBECK = {"velocity_weakening": {"stribeck": 0.5, "stribeck_speed": 0.05}}
# kind -> (blocks, turning of the block, rad/s)
KINDS = {
    "x only": ({"rig": {"degrees_of_freedom": ("x",)}}, 0.0), "planar, no spin": (PLANE, 0.0),
    "planar, spin outside": (PLANE, 2.0), "planar, spin inside": (PLANE, 10.0),
    "spin, hyperbolic law": (PLANE | HYPERBOLIC, 2.0),
    "spin, inverse root": (PLANE | INVERSE_ROOT, 2.0), "spin, Stribeck": (PLANE | STRIBECK, 2.0),
}  # fmt: skip


#: Sum of what depends on every call, so that none is left out; becomes C with the kernel.
REPEAT = """
def repeat(p: 'float[:]', u: 'float[:]', w: 'float[:]', loops: int) -> float:
    total = 0.0
    for i in range(loops):
        w[W_STATE + X] = 0.02 + 1e-9 * i
        set_slopes(p, u, w, 1.0 * SLIP, W_SLOPES)
        total += w[W_SLOPES + VX - 1]
    return total
"""


@cache
def repeat():
    return library(kernel_source() + REPEAT).repeat


def moving(blocks: dict, turning: float) -> SimpleNamespace:
    """The kernel's arrays with the block sliding at 0.26 m/s against the belt."""
    parameters = Parameters(**blocks)
    u, w = np.zeros(layout.U_SIZE), np.zeros(layout.W_SIZE)
    u[layout.U_SPEED], u[layout.U_TEMPERATURE] = parameters.surface.speed, -8.0
    across = 0.0 if parameters.rig.degrees_of_freedom == ("x",) else 0.01
    start = {
        layout.X: 0.02, layout.Y: across, layout.PHI: across, layout.VX: -0.1,
        layout.VY: 5.0 * across, layout.OMEGA: turning,
    }  # fmt: skip
    for place, value in start.items():
        w[layout.W_STATE + place] = value
    return SimpleNamespace(p=np.array(parameters.pack()), u=u, w=w)


def nanoseconds(kind: str) -> float:
    at = moving(*KINDS[kind])
    call = repeat()
    return 1e9 / LOOPS * median_seconds(lambda: call(at.p, at.u, at.w, LOOPS), 7)


def main() -> None:
    told, figures = arguments(__doc__).parse_args(), {}
    print("one right-hand side, compiled            ns")
    for kind in KINDS:
        figures[kind] = Figure(nanoseconds(kind), "ns")
        print(f"{kind:<34}{figures[kind].value:9.0f}")
    write(told.json, "right_hand_side", figures)


if __name__ == "__main__":
    main()
