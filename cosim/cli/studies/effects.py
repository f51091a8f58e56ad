"""`stickslip effects`: the catalogue, printed, and as a page with figures."""

from argparse import Namespace
from pathlib import Path
from typing import Any

from cosim.cli import DONE, Failed
from cosim.cli.bar import Bar
from cosim.cli.numbers import numbers_asked
from cosim.files import writable, write_bytes, write_text
from cosim.interrupts import held_interrupts
from cosim.manifest import made_by, results_in
from cosim.report.files import json_text, write_json
from cosim.report.page import Picture
from cosim.studies.effects import Entry, chosen, described, written

RESULT, PAGE = "effects.json", "effects.html"


def execute(arguments: Namespace) -> int:
    """Print the entries; write page, JSON and figures where asked to."""
    told = chosen(arguments.effects)
    entries = [described(each.effect) for each in told]
    asked = numbers_asked(arguments, ("id", "sentence", "parameters"))
    if arguments.output is not None:
        folder = Path(arguments.output)
        names = (RESULT, PAGE, *(f"{entry['id']}.png" for entry in entries))
        writable(folder, names)
        with results_in(folder, made_by(), names, arguments.force):
            _write(entries, told, folder)
    if not asked.give(json_text(entries)):
        print(written().printed(entries), end="")
    return DONE


def _write(entries: list[dict[str, Any]], told: list[Entry], folder: Path) -> None:
    """Figures, then the page of all of them."""
    with held_interrupts():
        from cosim.studies.effects.page import effect_figure, page

    pictures: dict[str, Picture] = {}
    try:
        for entry in Bar(told, unit="figure"):
            name = entry.effect.id
            with held_interrupts():
                pictures[name] = effect_figure(entry)
                write_bytes(pictures[name].png, folder / f"{name}.png")
        write_json(entries, folder / RESULT)
        write_text(page(told, pictures), folder / PAGE)
    except KeyboardInterrupt:
        raise Failed(
            f"interrupted; {len(pictures)} of {len(entries)} figures are in {folder}"
        ) from None
