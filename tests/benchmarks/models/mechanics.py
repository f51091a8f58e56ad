"""Speed of the mechanics alone: 20 s, exact, planar friction, against the linearised scheme.

    python tests/benchmarks mechanics [--json FILE]

prints seconds and their ratio, both measured in this run (median of several).
"""

import statistics
import time

from baseline import Figure, arguments, write
from stickslip import LateralFriction, Parameters, simulate
from stickslip.reference.interpreted_scheme import interpreted_run
from stickslip.reference.linearised import Scheme
from stickslip.reference.scheme_options import MENDED


def median_seconds(call, repeats: int) -> float:
    seconds = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - start)
    return statistics.median(seconds)


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
    write(
        told.json, "mechanics",
        {"compiled kernel": Figure(1e3 * ours, "ms"),
         "interpreted kernel": Figure(1e3 * interpreted, "ms"),
         "Python strips / ours": Figure(python_strips / ours, better="more"),
         "compiled scheme / ours": Figure(scheme_compiled / ours, better="more")},
    )  # fmt: skip


if __name__ == "__main__":
    main()
