"""`stickslip friction-map`: its arguments, what it runs, what it leaves behind."""

import sys
import time
from argparse import Namespace

from cosim.cli import DONE
from cosim.cli.bar import Bar
from cosim.cli.numbers import numbers_asked
from cosim.cli.scenarios import given_scenario, note_taken
from cosim.fmu.build import own_fmu
from cosim.manifest import made_by, own_folder, results_in
from cosim.report.files import json_text
from cosim.studies.friction_map import friction_map
from cosim.studies.friction_map.page import printed

RESULT, PAGE = "friction_map.json", "report.html"
TABLE, FIGURE = "friction_map.csv", "friction_map.png"
#: By which keys RESULT is known.
KEYS = ("scenario", "regimes", "points")


def execute(arguments: Namespace) -> int:
    """Run, write, print a line a temperature; 0."""
    began = time.perf_counter()
    scenario = given_scenario(arguments.scenario, arguments.changes)
    asked = numbers_asked(arguments, KEYS)
    own_fmu(scenario.catalogue)  # once, and before anything is written: it may lack a compiler
    folder = own_folder(arguments.output, (RESULT, TABLE, FIGURE, PAGE), arguments.force)
    note_taken(scenario)
    total = len(set(arguments.speed)) * len(set(arguments.ambient))
    with Bar(total=total, unit="run") as bar:
        found = friction_map(
            scenario, arguments.speed, arguments.ambient, arguments.duration, bar.update
        )
    made = made_by(scenario=scenario.to_toml())
    with results_in(folder, made, force=arguments.force):
        found.save(folder, made["command"])
    if asked.give(json_text(found.summary())):
        return DONE
    print(printed(found), end="")
    for reason in found.failed:
        print(f"warning: left out: {reason}", file=sys.stderr)
    wall_time = time.perf_counter() - began
    print(f"{total} coupled runs in {wall_time:.1f} s; {folder / PAGE}, {folder / RESULT}")
    return DONE
