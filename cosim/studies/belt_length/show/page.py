"""What `stickslip belt-length` leaves of a study: numbers, tables, figures and the page.

The page has what was asked, the answer first, its figures, how sure it is, and why.
"""

import json
import re
import tomllib
from functools import partial
from html import escape
from pathlib import Path

from cosim.files import write_atomically, write_text
from cosim.report.material import page_of_material
from cosim.report.page import Picture, render

from ..result import Study
from ..unknowns import unknowns_of
from . import text
from .figures import curves_of, draw_doubt, draw_drift, draw_interface, draw_map
from .text import headline as headline
from .text import tiles as tiles

RESULT, TABLE, PAGE = "belt_length.json", "belt_length.csv", "report.html"
CHANGES, DOUBT = "changes.csv", "doubt.csv"
#: Sentences that stand open; the rest is folded.
MOST_SENTENCES = 6
_MINUS = re.compile(r"(?<=[ (])-(?=\d)")


def write_numbers(study: Study, folder: Path) -> None:
    """What there is, be it complete or not."""
    write_text(json.dumps(study.summary(), indent=1), folder / RESULT)
    for name, table in ((TABLE, study.table()), (CHANGES, study.changes()), (DOUBT, study.doubt())):
        if name == TABLE or not table.empty:
            write_atomically(folder / name, partial(table.to_csv, index=False))


def page(study: Study, command: str = "") -> tuple[str, list[Picture]]:
    """HTML of a study with rows; its pictures."""
    doubted = study.most_doubted
    curves = curves_of(study)
    pictures = [draw_drift(study, curves), draw_interface(study, curves)]
    if doubted is not None and doubted.uncertainty is not None:
        pictures.append(draw_doubt(doubted, doubted.uncertainty))
    if study.grid is not None:
        pictures.append(draw_map(study.grid, study.rows[0].case, study.options.limit))
    start, *rest = study.worst.changes
    html = render(
        "belt_length.html.j2",
        "cosim.studies.belt_length.show",
        **vars(text),
        study=study,
        name=tomllib.loads(study.scenario).get("name", "The source study's rig"),
        on_page=_on_page,
        most=MOST_SENTENCES,
        changes=[start, *sorted(rest, key=lambda one: abs(one.run))],
        unknowns_of=unknowns_of,
        pictures={one.name: one for one in pictures},
        command=command,
    )
    return page_of_material(html, study.material), pictures


def _on_page(sentence: str) -> str:
    """A sentence of the terminal, escaped, as HTML: signs, units, what is typed."""
    text = escape(_MINUS.sub("−", sentence).replace("W/m2K", "W/(m² K)"), quote=False)
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", text)
