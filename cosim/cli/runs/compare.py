"""`stickslip compare`: two results, or two scenarios that are run for it."""

import os
import sys
from argparse import Namespace
from pathlib import Path

from cosim.cli import DONE
from cosim.cli.arguments import RESULTS
from cosim.cli.bar import Bar
from cosim.cli.numbers import numbers_asked
from cosim.cli.runs.run_io import progress_over
from cosim.cli.runs.running import scenario_to_run
from cosim.manifest import made_by, own_folder, results_in
from cosim.report.compare import Comparison, OneResult, compare, read_result
from cosim.report.compare.one_result import as_result
from cosim.report.compare.page import PAGE, RESULT, printed
from cosim.report.files import json_text
from cosim.report.scenario_run import ScenarioRun
from cosim.scenario import Scenario
from cosim.simulated import SimulatedRun, simulated


def execute(arguments: Namespace) -> int:
    """Read or run both, compare, write, print."""
    numbers = numbers_asked(arguments, ("a", "b", "numbers"))
    both = compare(*_results(arguments))
    place = arguments.output or Path(RESULTS) / _named(both)
    folder = own_folder(place, (RESULT, PAGE), arguments.force)
    made = made_by(a=both.a.place, b=both.b.place)
    with results_in(folder, made, force=arguments.force), Bar(total=1, unit="page"):
        both.save(folder, made["command"])
    for remark in both.remarks:
        print(f"warning: {remark}", file=sys.stderr)
    if not numbers.give(json_text(both.summary())):
        print(f"{printed(both)}{folder / PAGE}")
    return DONE


def _named(both: Comparison) -> str:
    names = (Path(both.a.place).stem, Path(both.b.place).stem)
    return f"{names[0]}-and-{names[1]}"


def _results(arguments: Namespace) -> list[OneResult]:
    """Both results; what is wrong with either is found before anything is run."""
    sources = (arguments.a, arguments.b)
    found = [
        read_result(Path(one))
        if os.path.isdir(one)
        else scenario_to_run(one, coupled=arguments.coupled)
        for one in sources
    ]
    return [
        _run(source, one, arguments.coupled) if isinstance(one, Scenario) else one
        for source, one in zip(sources, found, strict=True)
    ]


def _run(source: str, scenario: Scenario, coupled: bool) -> OneResult:
    """A scenario's run, which is kept nowhere."""
    _ = scenario.catalogue.compiled
    done: ScenarioRun
    with progress_over(scenario.run.duration) as show:
        if coupled:
            from cosim.coupling.case import run_scenario

            done = run_scenario(scenario, progress=show)
        else:
            done = SimulatedRun(scenario, simulated(scenario, show))
    return as_result(done, source)
