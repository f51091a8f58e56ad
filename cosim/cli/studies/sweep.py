"""`stickslip sweep`: its arguments, what it runs, what it leaves behind."""

import sys
import time
from argparse import Namespace
from pathlib import Path

from cosim.cli import DONE, FAILED
from cosim.cli.arguments import RESULTS
from cosim.cli.bar import Bar
from cosim.cli.numbers import numbers_asked
from cosim.cli.scenarios import given_scenario, note_taken
from cosim.files import OutputError, not_taken
from cosim.fmu.build import own_fmu
from cosim.manifest import made_by, require_own, results_in
from cosim.report.files import json_text
from cosim.scenario import Scenario
from cosim.studies.sweep import Grid, SweepError, SweepStopped, product_grid, run_grid
from cosim.studies.sweep.axis import parse_vary
from cosim.studies.sweep.combination import COMPLETE
from cosim.studies.sweep.grid import plan_grid, repeats_grid
from cosim.studies.sweep.result import (
    FIGURE,
    PAGE,
    RESULT,
    TABLE,
    Sweep,
    check_shown,
    summary,
    write,
)

OWN = (RESULT, FIGURE, TABLE, PAGE)
#: Group of the result file that holds the test plan's repeats.
REPEATS = "repeats"


def execute(arguments: Namespace) -> int:
    """Sweep, write, report; 0, or 1 when nothing came out or the sweep was stopped."""
    began = time.perf_counter()
    numbers = numbers_asked(arguments, ("runs",))
    scenario = given_scenario(arguments.scenario, arguments.changes)
    grids = _grids(arguments, scenario)
    check_shown(arguments.show, grids[""].run.features)
    folder = Path(arguments.output or Path(RESULTS) / f"{scenario.name}-sweep")
    not_taken(folder, OWN)
    require_own(folder, OWN, arguments.force)
    if isinstance(grids[""].base, Scenario) and arguments.dask is None:
        own_fmu(scenario.catalogue)  # once, and before anything is written: it may lack a compiler
    note_taken(scenario)
    datasets = {}
    try:
        for group, grid in grids.items():
            with Bar(total=len(grid), unit="run") as bar:
                where = {"jobs": arguments.jobs, "dask": arguments.dask, "folder": folder}
                datasets[group] = run_grid(grid, **where, progress=bar.reach)
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
    try:
        with results_in(folder, made, force=arguments.force):
            write(datasets, folder, arguments.show, made["command"])
    except OutputError as error:
        raise OutputError(f"{error}; all runs are kept, the same command goes on") from error
    if not numbers.give(json_text(summary(datasets))):
        _report(datasets, folder, time.perf_counter() - began)
    some = any((each["status"] == COMPLETE).any() for each in datasets.values())
    return DONE if some else FAILED


def _grids(arguments: Namespace, scenario: Scenario) -> dict[str, Grid]:
    """Group of the result file -> combinations."""
    if arguments.test_plan:
        if arguments.others or arguments.coupled:
            raise SweepError("--test-plan: is of one scenario, and of the mechanics alone")
        return {"": plan_grid(scenario), REPEATS: repeats_grid(scenario)}
    scenarios = [
        scenario,
        *(given_scenario(source, arguments.changes) for source in arguments.others),
    ]
    if not arguments.vary and len(scenarios) == 1:
        raise SweepError(
            "nothing is varied, allowed is --vary KEY=V1,V2,..., more than one scenario, or"
            " --test-plan"
        )
    varied = parse_vary(arguments.vary or ())
    for change in arguments.changes:
        key = change.partition("=")[0].strip()
        if any(key in keys for keys in varied):
            raise SweepError(f"--set {change}: {key} is varied, allowed is a key that is not")
    return {"": product_grid(scenarios, varied, arguments.coupled)}


def _report(datasets: dict[str, Sweep], folder: Path, wall_time: float) -> None:
    """Some lines on what came out."""
    statuses = [dataset["status"] for dataset in datasets.values()]
    total = sum(status.size for status in statuses)
    complete = sum(int((status == COMPLETE).sum()) for status in statuses)
    print(f"{total} combinations in {wall_time:.1f} s, {complete} of them complete")
    for dataset in datasets.values():
        reasons = [reason for reason in dataset["reason"].values.ravel() if reason]
        if reasons:
            print(f"  failed     {len(reasons)}, the first: {reasons[0]}")
    print(f"  results    {folder / PAGE}, {folder / RESULT}")
