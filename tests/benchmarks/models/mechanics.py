"""Speed of the mechanics alone: 20 s, exact, against the linearised scheme and scipy.

    python tests/benchmarks mechanics [--json FILE]

prints seconds and their ratio, both measured in this run (median of several). The scheme's peer has
friction in the plane. scipy's, along x, is the tests' own model (`one_mass_model`): DOP853 with
events for stick and slip, at the tolerance at which its break-aways are as exact as the kernel's.
"""

import statistics
import time

import numpy as np
from baseline import Figure, arguments, write
from one_mass_model import GRAVITY, OneMass
from stickslip import LateralFriction, Parameters, simulate
from stickslip.reference.interpreted_scheme import interpreted_run
from stickslip.reference.linearised import Scheme
from stickslip.reference.scheme_errors import MENDED


def median_seconds(call, repeats: int) -> float:
    seconds = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - start)
    return statistics.median(seconds)


def against_scipy() -> tuple[float, float, float]:
    """Seconds of scipy's run over the kernel's; by how much the last break-away of each is off."""
    line = Parameters(
        rig={"degrees_of_freedom": ("x",), "spring_length": 1.0, "spring_natural_length": 1.0},
        initial={"vx": 0.15},
    )
    normal = line.rig.mass * GRAVITY
    model = OneMass(
        mass=line.rig.mass,
        pull=lambda x: -4.0 * line.springs.stiffness * x,
        kinetic=lambda sliding, state: line.friction.mu_k * normal,
        static=lambda rest, state: line.friction.mu_s * normal,
        speed=lambda t: 0.15,
    )
    times, tight = np.linspace(0.0, 20.0, 2001), line.solver.model_copy(update={"tolerance": 1e-13})
    exact = simulate(line.model_copy(update={"solver": tight}), 20.0).slip_starts[-1]
    _, events = model.run(times)
    off = (
        abs(simulate(line, 20.0).slip_starts[-1] - exact),
        abs(events[events[:, 1] == 1.0][-1, 0] - exact),
    )
    ratio = median_seconds(lambda: model.run(times), 3)
    return ratio / median_seconds(lambda: simulate(line, 20.0), 9), *off


def main() -> None:
    told = arguments(__doc__).parse_args()
    planar = Parameters(lateral_friction=LateralFriction(ratio=1.0), initial={"vx": 0.15})
    simulate(planar, 1.0)  # compiles, or loads the compiled kernel
    ours = median_seconds(lambda: simulate(planar, 20.0), 9)
    interpreted = median_seconds(lambda: simulate(planar, 20.0, interpreted=True), 1)
    # strip by strip costs the same every second: a tenth of the run stands for all of it
    python_strips = 10.0 * median_seconds(lambda: interpreted_run(2.0, Scheme(scatter=0.0)), 1)
    scheme = Scheme(scatter=0.0, faults=MENDED.only("F6"))
    scheme.run(duration=1.0)
    scheme_compiled = median_seconds(lambda: scheme.run(duration=20.0), 9)
    print(f"20 s of stick-slip, 2001 samples, {len(simulate(planar, 20.0).events)} events")
    print(f"compiled kernel             {1e3 * ours:9.2f} ms")
    print(f"interpreted kernel          {1e3 * interpreted:9.2f} ms")
    print(f"scheme, strips in Python    {1e3 * python_strips:9.2f} ms")
    print(f"scheme, compiled            {1e3 * scheme_compiled:9.2f} ms")
    print(f"ratio Python strips / ours  {python_strips / ours:9.0f}")
    print(f"ratio compiled scheme / ours{scheme_compiled / ours:9.2f}")
    scipy, ours_off, scipy_off = against_scipy()
    print(f"ratio scipy / ours, along x {scipy:9.0f}")
    print(f"last break-away off by      {ours_off:9.1e} s, scipy's by {scipy_off:.1e} s")
    write(
        told.json,
        "mechanics",
        {
            "compiled kernel": Figure(1e3 * ours, "ms"),
            "interpreted kernel": Figure(1e3 * interpreted, "ms"),
            "Python strips / ours": Figure(python_strips / ours, better="more"),
            "compiled scheme / ours": Figure(scheme_compiled / ours, better="more"),
            "scipy / ours": Figure(scipy, better="more"),
        },
    )


if __name__ == "__main__":
    main()
