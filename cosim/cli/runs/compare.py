"""`stickslip compare`: two results, or two scenarios that are run for it."""

import os
import sys
from argparse import Namespace
from pathlib import Path

from cosim.cli import DONE
from cosim.cli.arguments import RESULTS
from cosim.cli.numbers import numbers_asked
from cosim.cli.runs.run_io import progress_over
from cosim.cli.runs.running import scenario_to_run
from cosim.manifest import made_by, own_folder, results_in
from cosim.report.compare import Comparison, OneResult, compare, read_result
from cosim.report.compare.page import cells, curve_cells
from cosim.report.files import json_text
from cosim.report.quantities import NONE, digits
from cosim.report.scenario_run import ScenarioRun
from cosim.scenario import Scenario
from cosim.simulated import SimulatedRun, simulated

#: Numbers that are on the page only.
OTHER_STARTS = tuple(f"regimes.{start}." for start in ("disturbed", "rest", "riding", "ramp"))
#: Curves that the terminal tells of; all are on the page.
MOST_CURVES = 8
RESULT, PAGE = "compare.json", "report.html"


def execute(arguments: Namespace) -> int:
    """Read or run both, compare, write, print."""
    numbers = numbers_asked(arguments, ("a", "b", "numbers"))
    both = compare(*_results(arguments))
    place = arguments.output or Path(RESULTS) / _named(both)
    folder = own_folder(place, (RESULT, PAGE), arguments.force)
    made = made_by(a=both.a.place, b=both.b.place)
    with results_in(folder, made, force=arguments.force):
        both.save(folder, made["command"])
    for remark in both.remarks:
        print(f"warning: {remark}", file=sys.stderr)
    if not numbers.give(json_text(both.summary())):
        print(_table(both, folder))
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
    numbers = done.summary()
    failed = numbers["status"] != "complete"
    remarks = (f"{source}: its run is not complete ({numbers['reason']})",) * failed
    return OneResult(scenario.name, source, done.to_xarray(), numbers, scenario.to_toml(), remarks)


def _table(both: Comparison, folder: Path) -> str:
    """Lines: what differs in the scenarios, and in the numbers."""
    lines = [f"A: {both.a.label} ({both.a.place})", f"B: {both.b.label} ({both.b.place})"]
    for key, values in both.keys.items():
        left, right = ("(not there)" if one is None else digits(one) for one in values)
        lines.append(f"  {key:<44} {left:>16} {right:>16}")
    rows = [("number", "A", "B", "B - A", "relative")]
    # other starts than the run's own are on the page
    told = [one for one in both.different if not one.name.startswith(OTHER_STARTS)]
    rows += [(one.name, *cells(one)) for one in told]
    if told:
        name, *widths = (max(len(row[i]) for row in rows) for i in range(5))
        for first, *rest in rows:
            shown = "  ".join(f"{cell:>{width}}" for cell, width in zip(rest, widths, strict=True))
            lines.append(f"{first:<{name}}  {shown}")
    if both.curves:
        most = [(one[0], one[1], one[2], one[4]) for one in map(curve_cells, both.curves)]
        lines.append("curves, how far they are apart at most:")
        lines += [
            f"  {name:<44} {apart:>14} at {at}" + (f", {part} of its span" if part != NONE else "")
            for name, apart, at, part in most[:MOST_CURVES]
        ]
    same = sum(one.same for one in both.numbers)
    lines.append(f"{len(both.different)} numbers differ, {same} are the same{_left_out(both)}")
    lines.append(str(folder / PAGE))
    return "\n".join(lines)


def _left_out(both: Comparison) -> str:
    """How many numbers only one of them has."""
    sides = {"A": sum(one.b is None for one in both.of_one)}
    sides["B"] = len(both.of_one) - sides["A"]
    return "".join(f", {count} are of {name} alone" for name, count in sides.items() if count)
