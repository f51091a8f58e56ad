"""What `stickslip belt-length` leaves of a study: numbers, tables, figures and the page."""

from __future__ import annotations

import json
import tomllib
from functools import partial
from pathlib import Path

from cosim.files import write_atomically, write_bytes, write_text
from cosim.report.page import Picture

from ..result import Study
from .figures import draw_doubt, draw_drift, draw_map
from .page import page

RESULT, TABLE, PAGE = "belt_length.json", "belt_length.csv", "report.html"
CHANGES, DOUBT = "changes.csv", "doubt.csv"


def write_numbers(study: Study, folder: Path) -> None:
    """What there is, be it complete or not."""
    write_text(json.dumps(study.summary(), indent=1), folder / RESULT)
    for name, table in ((TABLE, study.table()), (CHANGES, study.changes()), (DOUBT, study.doubt())):
        if name == TABLE or not table.empty:
            write_atomically(folder / name, partial(table.to_csv, index=False))


def write_page(study: Study, folder: Path, command: str = "") -> None:
    """Of a study with rows."""
    pictures = drawn(study)
    for one in pictures:
        write_bytes(one.png, folder / f"{one.name}.png")
    write_text(page_text(study, pictures, command), folder / PAGE)


def page_text(study: Study, pictures: list[Picture], command: str = "") -> str:
    """The page, with the name of the scenario that was asked about."""
    scenario = study.scenario or None
    name = None if scenario is None else str(tomllib.loads(scenario)["name"])
    return page(study, pictures, name=name, scenario=scenario, command=command)


def drawn(study: Study) -> list[Picture]:
    """Drift over length, the most doubted case's unknowns, and the map."""
    pictures: list[Picture] = [draw_drift(study)]
    if (row := study.most_doubted) is not None and row.uncertainty is not None:
        pictures.append(draw_doubt(row, row.uncertainty))
    if study.grid is not None:
        pictures.append(draw_map(study.grid, study.rows[0].case, study.options.limit))
    return pictures
