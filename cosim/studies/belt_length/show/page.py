"""The page of the study: what was asked, the answer first, its figures, how sure it is, and why."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from markupsafe import Markup, escape

from cosim.report.material import page_of_material
from cosim.report.page import Picture, render

from ..lengths import rounded_up
from ..result import Row, Study
from ..unknowns import unknowns_of
from .headline import headline, tiles
from .verdict import verdict
from .wording import percent, two_digits

_MINUS = re.compile(r"(?<=[ (])-(?=\d)")
#: Sentences that stand open; the rest is folded.
MOST_SENTENCES = 6
FILES = {
    "belt_length.json": "everything on this page and more, numbers in full",
    "belt_length.csv": "a line for each case: length, speed, rises, shortest belts",
    "changes.csv": "what each single change does, for each case",
    "doubt.csv": "what is not known: range, what it does alone, Sobol indices",
}


def _on_page(sentence: str) -> Markup:
    """A sentence of the terminal as a page has it: signs, units, what is typed."""
    text = escape(_MINUS.sub("−", sentence).replace("W/m2K", "W/(m² K)"))
    return Markup(re.sub(r"`([^`]+)`", r"<code>\1</code>", text))


def page(
    study: Study,
    pictures: Sequence[Picture],
    *,
    name: str | None = None,
    scenario: str | None = None,
    command: str = "",
) -> str:
    """HTML of a study with rows; name, scenario (TOML): of an own rig."""
    answers, doubted = study.answers, study.most_doubted
    start, *rest = study.worst.changes
    html = render(
        "belt_length.html.j2",
        "cosim.studies.belt_length.show",
        name=name or "The source study's rig",
        limit=study.options.limit,
        headline=headline(study),
        tiles=tiles(study),
        sentences=[_on_page(sentence) for sentence in verdict(study)],
        most=MOST_SENTENCES,
        answers=answers,
        rows=study.rows,
        layers=study.rows[0].case.thermal().belt.stack,
        changes=[start, *sorted(rest, key=lambda one: abs(one.run))],
        worst=study.worst.case,
        doubts=[] if doubted is None else _doubts(doubted),
        evaluations=max((one.evaluations for one in answers), default=0),
        unexplained=max((max(one.unexplained) for one in answers), default=0.0),
        reasons=list(dict.fromkeys(one.reason for one in answers if one.reason)),
        pictures={one.name: one for one in pictures},
        scenario=scenario,
        command=command,
        files=FILES,
        two_digits=lambda value: two_digits(value).replace("-", "−"),
        percent=percent,
        metres=lambda length: "none" if length is None else rounded_up(length)[0],
    )
    return page_of_material(html, study.material)


def _doubts(row: Row) -> list[dict[str, Any]]:
    """What is not known, the most important first; then what is."""
    table = [] if row.uncertainty is None else row.uncertainty.table()
    ranked = sorted(table, key=lambda one: -float(str(one["total"])))
    return [*ranked, *(vars(one) for one in unknowns_of(row.case) if one.fixed)]
