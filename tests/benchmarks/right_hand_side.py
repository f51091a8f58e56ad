"""Cost of the kernel's right-hand side, and the error that its quadrature over the contact leaves.

    python tests/benchmarks/right_hand_side.py

Where mu_k does not depend on the sliding speed, friction in the plane is a closed form: no points.
Where it does, 8 strips or rays of 4 points each take up what its variation over the contact
changes; the error is against adaptive quadrature, the largest of force and moment (per radius) over
motions from pure sliding to pure spinning, relative to mu_k N.
"""

import statistics
import sys
import time
from pathlib import Path

import numba
import numpy as np
from stickslip import Parameters
from stickslip.compiled import compiled_kernel
from stickslip.kernel.layout import (
    DEPTHS,
    OMEGA,
    RAYS,
    SLIP,
    U_SIZE,
    U_SPEED,
    U_TEMPERATURE,
    VX,
    VY,
    W_SIZE,
    W_SLOPES,
    W_STATE,
    X,
)

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "verification"))

from test_effect_local_law import LAWS, MOTIONS, MU, kernel_law, law_over_disc  # noqa: E402

CALLS, REPEATS = 100_000, 9
PLANAR = {"lateral_friction": {"ratio": 1.0}, "rig": {"spring_natural_length": 0.17}}
WEAKENING = {"velocity_weakening": {"hyperbolic": 3.0}}
SCATTER = {"surface_scatter": {"deviation": 0.1}}
SLIDING, SPINNING = (-0.1, 0.02, 1.0), (0.149, 0.001, -5.0)  # vx, vy, omega
# what is on, how the block moves, points over the contact
CASES = {
    "along x": ({}, SLIDING, 0),
    "planar, mostly sliding": (PLANAR, SLIDING, 0),
    "planar, mostly spinning": (PLANAR, SPINNING, 0),
    "planar, weakening, sliding": (PLANAR | WEAKENING, SLIDING, RAYS * DEPTHS),
    "planar, weakening, spinning": (PLANAR | WEAKENING, SPINNING, RAYS * DEPTHS),
    "planar, random field": (PLANAR | SCATTER, SLIDING, 0),
}


def right_hand_side(blocks: dict, velocity: tuple[float, float, float]) -> float:
    """Seconds for all slopes of a slip, compiled; the median of some loops of many calls."""
    set_slopes = compiled_kernel().set_slopes

    @numba.njit
    def loop(p, u, w, calls):
        for i in range(calls):
            w[W_STATE + X] = 0.01 + 1e-9 * i  # no call is the one before
            set_slopes(p, u, w, float(SLIP), W_SLOPES)

    p, u, w = np.array(Parameters(**blocks).pack()), np.zeros(U_SIZE), np.zeros(W_SIZE)
    u[U_SPEED], u[U_TEMPERATURE] = 0.15, -8.0
    for slot, value in zip((VX, VY, OMEGA), velocity, strict=True):
        w[W_STATE + slot] = value
    loop(p, u, w, 1)
    seconds = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        loop(p, u, w, CALLS)
        seconds.append((time.perf_counter() - start) / CALLS)
    return statistics.median(seconds)


def quadrature_error(name: str) -> tuple[float, tuple[float, float]]:
    """Largest error relative to mu_k, and the motion (sliding, spinning) where it is."""
    parameters, law, bound = LAWS[name]
    errors = {
        motion: np.max(np.abs(np.subtract(
            kernel_law(parameters, *motion), law_over_disc(law, *motion, 0.01 * bound * MU)
        ))) / MU
        for motion in MOTIONS
    }
    worst = max(errors, key=errors.get)
    return errors[worst], worst


def main() -> None:
    print(f"{'right-hand side':30s} {'points':>6s} {'ns':>7s}")
    for name, (blocks, velocity, points) in CASES.items():
        print(f"{name:30s} {points:6d} {1e9 * right_hand_side(blocks, velocity):7.0f}")
    print(f"\n{'law of the local speed':30s} {'error / mu_k':>12s}   worst at sliding, rim speed")
    for name in LAWS:
        error, (sliding, spinning) = quadrature_error(name)
        print(f"{name:30s} {error:12.1e}   {sliding:g}, {spinning:g} m/s")


if __name__ == "__main__":
    main()
