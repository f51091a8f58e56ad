"""`stickslip plan`: its arguments, what it asks, what it leaves behind."""

import sys
from argparse import Namespace
from pathlib import Path
from typing import Any

from cosim.cli import DONE, Failed
from cosim.cli.argument_types import STDOUT
from cosim.cli.arguments import RESULTS
from cosim.cli.bar import Bar
from cosim.cli.console import note
from cosim.cli.numbers import numbers_asked
from cosim.files import write_text
from cosim.gap import CampaignError
from cosim.gap.example import write_planned_example
from cosim.gap.plan import make_plan, read_plan
from cosim.gap.plan.data import as_data, closing_lines
from cosim.gap.show.model_file import safe_name
from cosim.interrupts import held_interrupts
from cosim.manifest import made_by, own_folder, results_in
from cosim.report.files import json_text

RESULT, PAGE = "plan.json", "report.html"
#: By which keys RESULT is known.
KEYS = ("campaign", "smallest", "next_runs")


def execute(arguments: Namespace) -> int:
    """Read, plan, write, report; 0, or 1 when stopped."""
    if arguments.write_example is not None:
        print(write_planned_example(Path(arguments.write_example), force=arguments.force))
        return DONE
    if arguments.campaign is None:
        raise CampaignError("no campaign given, allowed is a file or folder, or --write-example")
    planned = read_plan(arguments.campaign, arguments.model, Path(RESULTS))
    place = arguments.output or Path(RESULTS) / f"{safe_name(planned.campaign.name)}-plan"
    folder = own_folder(place, (RESULT, PAGE), arguments.force)
    asked = numbers_asked(arguments, KEYS)
    for remark in planned.campaign.remarks:
        note(remark)
    with Bar(unit="step") as bar:
        answer = make_plan(planned, wanted=arguments.power, seed=arguments.seed, progress=bar.reach)
    text = json_text(as_data(answer))
    made = made_by(campaign=str(Path(arguments.campaign).resolve()))
    with results_in(folder, made, force=arguments.force):
        with held_interrupts():
            write_text(text, folder / RESULT)
        asked.give(text)
        _show(answer, closing_lines(answer), folder, arguments)
    return DONE


def _show(answer: Any, lines: list[str], folder: Path, arguments: Namespace) -> None:
    """Figures and page where they are wanted, then the closing lines."""
    try:
        if not arguments.no_page:
            with held_interrupts():
                from cosim.gap.plan import page
            page.write_page(answer, folder, folder / PAGE)
    except KeyboardInterrupt:
        raise Failed(f"interrupted while drawing; {RESULT} is in {folder}") from None
    names = [str(folder / name) for name in (PAGE, RESULT)[arguments.no_page :]]
    lines = [*lines, f"  files: {', '.join(names)}"]
    print("\n".join(lines), file=sys.stderr if arguments.json == STDOUT else sys.stdout)
