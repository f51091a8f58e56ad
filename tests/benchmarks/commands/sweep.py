"""The test plan's 1306 combinations of 30 s, and what handing them out costs.

    taskset -c 0,1 python tests/benchmarks sweep [--json FILE]

prints seconds, and the ratio of the sweep to the plain runs in it shared by the cores.
"""

import tempfile
import time

import joblib
from baseline import Figure, arguments, write
from stickslip import simulate

from cosim import read_scenario
from cosim.studies.sweep import Run, run_grid
from cosim.studies.sweep.combination import with_changes
from cosim.studies.sweep.plan import plan_grid, repeats_grid

SAMPLE = 48  # every so manieth combination is timed alone


def plain_seconds(grid, run: Run) -> float:
    """Seconds of all runs of a grid one after the other, from a sample of them."""
    sample = [with_changes(grid.base, changes) for changes in grid.changes[::SAMPLE]]
    simulate(sample[0], 1.0)  # compiles, or loads the compiled kernel
    start = time.perf_counter()
    for parameters in sample:
        simulate(parameters, *run)
    return (time.perf_counter() - start) * len(grid) / len(sample)


def main() -> None:
    told = arguments(__doc__).parse_args()
    scenario = read_scenario("test_plan")
    run = Run(scenario.run.duration, scenario.run.output_interval)
    grids = plan_grid(scenario), repeats_grid(scenario)
    plain = sum(plain_seconds(grid, run) for grid in grids)
    cores = joblib.cpu_count()
    seconds = []
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(2):
            start = time.perf_counter()
            done = [run_grid(grid, run, folder=folder) for grid in grids]
            seconds.append(time.perf_counter() - start)
    complete = sum(int((each.status == 0).sum()) for each in done)
    print(f"combinations                {sum(map(len, grids)):9d}, {complete} complete")
    print(f"runs alone, on one core     {plain:9.1f} s, {1e3 * plain / complete:.1f} ms each")
    print(f"sweep on {cores:2d} cores           {seconds[0]:9.1f} s")
    print(f"the same sweep again        {seconds[1]:9.1f} s")
    print(f"ratio sweep / shared runs   {seconds[0] / (plain / cores):9.2f}")
    write(
        told.json,
        "sweep",
        {
            "a run alone": Figure(1e3 * plain / complete, "ms"),
            "sweep / shared runs": Figure(seconds[0] / (plain / cores)),
            "the same sweep again": Figure(seconds[1], "s"),
            "combinations complete": Figure(complete, better="more"),
        },
    )


if __name__ == "__main__":
    main()
