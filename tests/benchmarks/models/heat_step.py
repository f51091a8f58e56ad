"""Cost of a macro step of belt and ice, and of going to the steady state in one.

    python tests/benchmarks heat_step [--json FILE]

Belts of 1 and 4 m with 1 mm cells, macro steps of 10 ms, median of many on one thread; what four
times the length costs; a loop-after-loop run to the steady state against the direct way, both
timed, with the difference of their temperatures.
"""

import os
import statistics
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from baseline import Figure, arguments, write

from thermal import Belt, BeltIceModel, Contact, Ice, ThermalParameters
from thermal.steady_state import settle

FORCE, MACRO_STEP, REPEATS = 4.03, 0.01, 400
#: Belt and ice that forget the start within 10 000 passes, and a step of whole cells.
SMALL = ThermalParameters(
    belt=Belt(length=0.045, width=0.05, cell_length=1.5e-3, elements=2),
    ice=Ice(height=0.01, air_heat_transfer=60.0, radial_elements=2, axial_elements=2),
    contact=Contact(radius=0.02, strips=4),
)
PASSES, SMALL_STEP = 10_000, (0.02, 0.01, 1.5e-3)


def step_ms(length, speed):
    """Median, ms."""
    model = BeltIceModel(ThermalParameters(belt=Belt(length=length)))
    step = (MACRO_STEP, FORCE * speed * MACRO_STEP, speed * MACRO_STEP)
    model.step(*step)
    seconds = []
    for _ in range(REPEATS):
        began = time.perf_counter()
        model.step(*step)
        seconds.append(time.perf_counter() - began)
    return 1e3 * statistics.median(seconds)


def many_passes():
    """Seconds of 10 000 passes and of the direct way; largest relative difference of the rises."""
    began = time.perf_counter()
    direct = BeltIceModel(SMALL)
    settle(direct, *SMALL_STEP)
    at_once = time.perf_counter() - began
    stepped = BeltIceModel(SMALL)
    in_a_pass = round(SMALL.belt.length / SMALL_STEP[2])
    began = time.perf_counter()
    for _ in range(PASSES * in_a_pass):
        stepped.step(*SMALL_STEP)
    loops = time.perf_counter() - began
    names = [name for name in direct.outputs() if name.endswith("_temperature")]
    ambient = SMALL.ambient.temperature_degC
    differences = [
        abs((stepped.outputs()[name] - ambient) / (direct.outputs()[name] - ambient) - 1.0)
        for name in names
    ]
    return loops, at_once, max(differences)


def main():
    told = arguments(__doc__).parse_args()
    cost, figures = {}, {}
    for speed in (0.15, 0.82):
        for length in (1.0, 4.0):
            cost[length] = step_ms(length, speed)
            print(f"{length:g} m at {speed:4.2f} m/s  {cost[length]:6.3f} ms a macro step")
            figures[f"macro step, {length:g} m at {speed} m/s"] = Figure(cost[length], "ms")
        print(f"four times the length costs {cost[4.0] / cost[1.0]:.2f} times as much")
    loops, at_once, difference = many_passes()
    print(
        f"{PASSES} passes {loops:.1f} s, directly {at_once:.3f} s, rises differ by"
        f" {difference:.1e}; ratio {loops / at_once:.0f}"
    )
    figures["four times the length"] = Figure(cost[4.0] / cost[1.0])
    figures["passes / directly"] = Figure(loops / at_once, better="more")
    figures["passes and directly differ by"] = Figure(difference)
    write(told.json, "heat_step", figures)


if __name__ == "__main__":
    main()
