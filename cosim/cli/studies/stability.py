"""`stickslip stability`: its arguments, what it runs, what it leaves behind."""

import sys
import time
from argparse import Namespace

from cosim.cli import DONE, FAILED
from cosim.cli.bar import Bar
from cosim.cli.numbers import numbers_asked
from cosim.cli.scenarios import given_scenario, note_taken
from cosim.manifest import made_by, own_folder, results_in
from cosim.report.files import json_text
from cosim.studies.stability import NotAMotion, Stability, case_of, stick_slip_range
from cosim.studies.stability.study import PAGE, RESULT, STEPS, printed

#: By which keys RESULT is known.
KEYS = ("name", "stability", "regime_map")


def execute(arguments: Namespace) -> int:
    """Compute, write, print; 0, or 1 when stopped: what there was by then is written."""
    began = time.perf_counter()
    if (grid := arguments.grid) is None:
        grid = 0 if arguments.border else 20
    if grid < 0 or grid == 1:
        raise NotAMotion(f"--grid = {grid}: must be at least 2, or 0 for none")
    scenario = given_scenario(arguments.scenario, arguments.changes)
    asked = numbers_asked(arguments, KEYS)
    folder = own_folder(arguments.output, (RESULT, PAGE), arguments.force)
    found, status = Stability(case_of(scenario)), DONE
    note_taken(scenario)
    try:
        if arguments.border:
            with Bar(total=STEPS, unit="run") as bar:
                found.stick_slip = stick_slip_range(found.case, arguments.border, bar.update)
        if grid:
            with Bar(total=2 * grid**2, unit="cell") as bar:
                found.fill_maps(grid, bar.update)
    except KeyboardInterrupt:
        print(f"error: interrupted; what was computed is in {folder}", file=sys.stderr)
        status = FAILED
    made = made_by(scenario=scenario.to_toml())
    with results_in(folder, made, force=arguments.force) as results:
        found.save(folder)
        results.complete = status == DONE
    if not asked.give(json_text(found.summary())):
        print(printed(found), end="")
        print(f"{time.perf_counter() - began:.1f} s; {folder / PAGE}, {folder / RESULT}")
    return status
