"""Cost of one compiled right-hand side, and what the quadrature over the contact errs.

    python tests/benchmarks right_hand_side [--json FILE]

prints ns for each kind of friction (median of several loops, each inside compiled code, so that no
call from Python is in it), then the quadrature's error against adaptive integration, relative to
mu_k, the larger of force and moment.
"""

from functools import cache
from types import SimpleNamespace

import numpy as np
from baseline import Figure, arguments, write
from disc_integral import law_over_disc
from mechanics import median_seconds
from stickslip import Parameters
from stickslip.compiled import library
from stickslip.generation.source import kernel_source
from stickslip.kernel import layout
from stickslip.kernel.friction.force import friction_in_slip

LOOPS = 200_000
MU, RADIUS, NORMAL, TOP = 0.2, 0.04, 0.67 * 9.81, 0.3
PLANE = {"lateral_friction": {"ratio": 1.0}}
HYPERBOLIC = {"velocity_weakening": {"hyperbolic": 3.0}}
INVERSE_ROOT = {"velocity_weakening": {"inverse_root": 50.0}}
STRIBECK = {"velocity_weakening": {"stribeck": 0.5, "stribeck_speed": 0.05}}
# kind -> (blocks, turning of the block, rad/s)
KINDS = {
    "x only": ({"rig": {"degrees_of_freedom": ("x",)}}, 0.0),
    "planar, no spin": (PLANE, 0.0),
    "planar, spin outside": (PLANE, 2.0),
    "planar, spin inside": (PLANE, 10.0),
    "spin, hyperbolic law": (PLANE | HYPERBOLIC, 2.0),
    "spin, inverse root": (PLANE | INVERSE_ROOT, 2.0),
    "spin, Stribeck": (PLANE | STRIBECK, 2.0),
}
LAWS = {
    "hyperbolic 3 s/m": (HYPERBOLIC, lambda u: MU / (1.0 + 3.0 * u)),
    "inverse root 50 s/m": (INVERSE_ROOT, lambda u: MU / np.sqrt(1.0 + 50.0 * u)),
    "Stribeck 0.5, 0.05 m/s": (STRIBECK, lambda u: MU * (1.0 + 0.5 * np.exp(-u / 0.05))),
    "root of the speed 0.5 N": (
        {"film_drag": {"root_coefficient": 0.5}},
        lambda u: MU + 0.5 / NORMAL * np.sqrt(u),
    ),
}
RATIOS = (0.1, 0.5, 0.9, 1.0, 1.1, 2.0, 10.0)  # rim speed over sliding speed
ACCURACY = 1e-10  # of the adaptive integration; no error below it is shown


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
        layout.X: 0.02,
        layout.Y: across,
        layout.PHI: across,
        layout.VX: -0.1,
        layout.VY: 5.0 * across,
        layout.OMEGA: turning,
    }
    for place, value in start.items():
        w[layout.W_STATE + place] = value
    return SimpleNamespace(p=np.array(parameters.pack()), u=u, w=w)


def nanoseconds(kind: str) -> float:
    at = moving(*KINDS[kind])
    call = repeat()
    return 1e9 / LOOPS * median_seconds(lambda: call(at.p, at.u, at.w, LOOPS), 7)


def quadrature_error(law: str, ratio: float) -> float:
    """Of the kernel's force and moment; the faster of sliding and rim speed is TOP."""
    blocks, exact = LAWS[law]
    sliding, spinning = TOP * min(1.0, 1.0 / ratio), TOP * min(1.0, ratio)
    p = Parameters(friction={"mu_k": MU}, **(PLANE | blocks)).pack()
    u, w = [0.0] * layout.U_SIZE, [0.0] * layout.W_SIZE
    u[layout.U_TEMPERATURE] = -8.0
    friction_in_slip(p, u, w, sliding, 0.0, spinning)
    force, moment = law_over_disc(exact, sliding, spinning, ACCURACY)
    errors = (
        -w[layout.W_FRICTION] / NORMAL - force,
        -w[layout.W_FRICTION + 2] / (NORMAL * RADIUS) - moment,
    )
    return max(*map(abs, errors), ACCURACY) / MU


def main() -> None:
    told, figures = arguments(__doc__).parse_args(), {}
    print("one right-hand side, compiled            ns")
    for kind in KINDS:
        figures[kind] = Figure(nanoseconds(kind), "ns")
        print(f"{kind:<34}{figures[kind].value:9.0f}")
    points = f"{layout.RAYS} x {layout.DEPTHS} points ({ACCURACY / MU:.0e} or less)"
    print(f"\nerror of {points}; spinning / sliding:")
    print(f"{'':<26}" + "".join(f"{ratio:>10g}" for ratio in RATIOS))
    for law in LAWS:
        errors = [quadrature_error(law, ratio) for ratio in RATIOS]
        figures[f"largest error, {law}"] = Figure(max(errors))
        print(f"{law:<26}" + "".join(f"{error:10.1e}" for error in errors))
    write(told.json, "right_hand_side", figures)


if __name__ == "__main__":
    main()
