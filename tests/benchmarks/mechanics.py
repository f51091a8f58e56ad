"""Speed of the mechanics alone: 20 s, exact geometry, planar friction, against its peer.

    python tests/benchmarks/mechanics.py

prints seconds and their ratio, both measured in this run (median of several).
"""

import statistics
import time

from linearised_scheme import linearised_run
from stickslip import LateralFriction, Parameters, simulate


def median_seconds(call, repeats: int) -> float:
    seconds = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - start)
    return statistics.median(seconds)


def main() -> float:
    planar = Parameters(lateral_friction=LateralFriction(ratio=1.0), initial={"vx": 0.15})
    simulate(planar, 1.0)  # compiles, or loads the compiled kernel
    ours = median_seconds(lambda: simulate(planar, 20.0), 9)
    interpreted = median_seconds(lambda: simulate(planar, 20.0, interpreted=True), 1)
    peer = median_seconds(linearised_run, 3)
    print(f"20 s of stick-slip, 2001 samples, {len(simulate(planar, 20.0).events)} events")
    print(f"compiled kernel             {1e3 * ours:9.2f} ms")
    print(f"interpreted kernel          {1e3 * interpreted:9.2f} ms")
    print(f"linearised scheme (lsim)    {1e3 * peer:9.2f} ms")
    print(f"ratio linearised / compiled {peer / ours:9.0f}")
    return peer / ours


if __name__ == "__main__":
    main()
