"""`stickslip effects`: the catalogue, printed, and as a page with figures."""

from __future__ import annotations

import json
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import Any

from tqdm import tqdm

from cosim.studies.drawing import OutputRefused, writable
from cosim.studies.effects import UnknownEffect, chosen, described, effect_figure, page

DONE = 0
REFUSED = (UnknownEffect, OutputRefused)
RESULT, PAGE = "effects.json", "effects.html"


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    parser.add_argument("effects", metavar="EFFECT", nargs="*", help="ids (default: all)")
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument(
        "-o", "--output", metavar="DIR", help=f"also write {PAGE}, {RESULT} and the figures there"
    )


def execute(arguments: Namespace) -> int:
    """Print the entries; write page, JSON and figures where asked to."""
    entries = [described(entry) for entry in chosen(arguments.effects)]
    if arguments.output is not None:
        _write(entries, Path(arguments.output))
    if arguments.json:
        print(json.dumps(entries, indent=1))
    else:
        for entry in entries:
            _print(entry)
    return DONE


def _print(entry: dict[str, Any]) -> None:
    print(f"{entry['id']}: {entry['sentence']}")
    print(f"    enters {entry['enters']}; {entry['source']}")
    for parameter in entry["parameters"]:
        typical = parameter["typical"]
        usual = f", typical {typical[0]:g} to {typical[1]:g}" if typical else ""
        print(f"    {parameter['key']} [{parameter['unit']}] = {parameter['default']:g}{usual}")
        print(f"        {parameter['description']}")


def _write(entries: list[dict[str, Any]], folder: Path) -> None:
    writable(folder)
    pictures = {
        entry["id"]: effect_figure(entry["id"])
        for entry in tqdm(entries, disable=None, unit="figure", leave=False)
    }
    for name, picture in pictures.items():
        (folder / f"{name}.png").write_bytes(picture.png)
    (folder / RESULT).write_text(json.dumps(entries, indent=1), encoding="utf-8")
    (folder / PAGE).write_text(page(entries, pictures), encoding="utf-8")
