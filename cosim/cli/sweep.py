"""`stickslip sweep`: its arguments, what it runs, what it leaves behind."""

from __future__ import annotations

import sys
import time
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from tqdm import tqdm

from cosim.cli import DONE, FAILED
from cosim.cli.arguments import add_force, add_output
from cosim.files import OutputRefused, not_taken, write_bytes
from cosim.manifest import made_by, require_own, results_in

if TYPE_CHECKING:
    import xarray as xr

    from cosim.scenario import Scenario
    from cosim.studies.sweep import Grid

EXAMPLE = "stickslip sweep reference --vary rig.mass=0.67,2.03 --vary surface.speed=0.15,0.37,0.82"
RESULT, FIGURE = "sweep.nc", "sweep.png"
#: Group of the result file that holds the test plan's repeats.
REPEATS = "repeats"


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    parser.add_argument("scenario", help="TOML file, or the name of a packaged scenario")
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument(
        "--vary",
        metavar="KEY=V1,V2,...",
        action="append",
        help="values of a key of the mechanics; given more than once, all combinations are run. "
        "Keys that go together: mu_s and mu_k as friction.mu_s+friction.mu_k=0.28:0.21,0.07:0.05",
    )
    what.add_argument(
        "--test-plan",
        action="store_true",
        help="the 1306 combinations of the published test plan (its belts' friction is assumed)",
    )
    where = parser.add_mutually_exclusive_group()
    where.add_argument(
        "--jobs", metavar="N", type=int, help="processes on this machine (default: all cores)"
    )
    where.add_argument(
        "--dask", metavar="ADDRESS", help="run on the Dask cluster whose scheduler is there"
    )
    add_output(
        parser,
        "folder of the results (default: results/NAME OF THE SCENARIO-sweep); combinations "
        "that are finished there are not run again",
    )
    add_force(parser)


def refused() -> tuple[type[Exception], ...]:
    """What is bad input."""
    import cosim.studies.sweep.figure  # noqa: F401  imported where Ctrl-C waits
    from cosim.scenario import ScenarioError
    from cosim.studies.sweep import SweepError

    return (SweepError, ScenarioError, OutputRefused)


def execute(arguments: Namespace) -> int:
    """Sweep, write, report; 0, or 1 when nothing came out or the sweep was stopped."""
    from cosim.scenario import read_scenario
    from cosim.studies.sweep import Run, SweepStopped, run_grid

    began = time.perf_counter()
    scenario = read_scenario(arguments.scenario)
    grids = _grids(arguments, scenario)
    run = Run(scenario.run.duration, scenario.run.output_interval)
    folder = Path(arguments.output or Path("results") / f"{scenario.name}-sweep")
    not_taken(folder, (RESULT, FIGURE))
    require_own(folder, (RESULT, FIGURE), arguments.force)
    datasets = {}
    try:
        for group, grid in grids.items():
            with _bar(len(grid)) as progress:
                datasets[group] = run_grid(
                    grid,
                    run,
                    jobs=arguments.jobs,
                    dask=arguments.dask,
                    folder=folder,
                    progress=progress,
                )
            datasets[group].attrs["scenario"] = scenario.to_toml()
    except (KeyboardInterrupt, SweepStopped) as stop:
        said = str(stop) or "interrupted"
        print(
            f"error: {said}; what is finished is kept in {folder}, the same command goes on",
            file=sys.stderr,
        )
        return FAILED
    # the finished combinations beside the results are kept from sweep to sweep
    made = made_by(scenario=scenario.to_toml())
    with results_in(folder, made, force=arguments.force) as results:
        _write(datasets, folder)
        results.complete = True
    return _report(datasets, folder, time.perf_counter() - began)


def _grids(arguments: Namespace, scenario: Scenario) -> dict[str, Grid]:
    """Group of the result file -> combinations."""
    from cosim.studies.sweep import product_grid
    from cosim.studies.sweep.axis import parse_vary
    from cosim.studies.sweep.grid import plan_grid, repeats_grid

    if arguments.test_plan:
        return {"": plan_grid(scenario), REPEATS: repeats_grid(scenario)}
    return {"": product_grid(scenario, parse_vary(arguments.vary))}


@contextmanager
def _bar(total: int) -> Iterator[Callable[[int, int], None]]:
    """A bar over combinations on stderr, none when that is no terminal."""
    with tqdm(total=total, disable=None, unit="run", leave=False) as bar:

        def show(done: int, of: int) -> None:
            bar.total = of
            bar.update(done - bar.n)

        yield show


def _write(datasets: dict[str, xr.Dataset], folder: Path) -> None:
    from cosim.report.files import write_netcdf
    from cosim.studies.sweep.figure import draw_sweep

    write_netcdf(datasets, folder / RESULT)
    write_bytes(draw_sweep(datasets[""]).png, folder / FIGURE)


def _report(datasets: dict[str, xr.Dataset], folder: Path, wall_time: float) -> int:
    """Some lines on what came out."""
    from cosim.studies.sweep.combination import COMPLETE

    statuses = [dataset["status"] for dataset in datasets.values()]
    total = sum(status.size for status in statuses)
    complete = sum(int((status == COMPLETE).sum()) for status in statuses)
    print(f"{total} combinations in {wall_time:.1f} s, {complete} of them complete")
    for dataset in datasets.values():
        reasons = [reason for reason in dataset["reason"].values.ravel() if reason]
        if reasons:
            print(f"  failed     {len(reasons)}, the first: {reasons[0]}")
    print(f"  results    {folder / RESULT}, {folder / FIGURE}")
    return DONE if complete else FAILED
