"""What is said of a study, and what `stickslip belt-length` leaves of it.

`sentences.txt.j2` has the words, with the figures in words that it asks for; the page has what was
asked, the answer first, its figures, how sure it is, and why; beside it numbers and tables.
"""

import math
import re
import tomllib
from collections.abc import Iterable, Iterator
from functools import cache
from html import escape
from operator import attrgetter
from pathlib import Path
from typing import Any

from cosim.report.files import write_json, write_table
from cosim.report.material import of_material, page_of_material
from cosim.report.page import Picture, render, sentences, texts, tiles_of

from .drift import CAMERA as CAMERA
from .drift import NO_HELP
from .lengths import LONGEST as LONGEST
from .lengths import length_text as length_text
from .lengths import metres as metres
from .lengths import rounded_up as rounded_up
from .required_length import NOT_ASKED as NOT_ASKED
from .required_length import Answer
from .result import PRINTED, Row, Study
from .uncertainty import Uncertainty
from .unknowns import unknowns_of as unknowns_of

RESULT, TABLE, PAGE = "belt_length.json", "belt_length.csv", "report.html"
CHANGES, DOUBT = "changes.csv", "doubt.csv"
#: Sentences that stand open; the rest is folded.
MOST_SENTENCES = 6
_MINUS = re.compile(r"(?<=[ (])-(?=\d)")
#: K, s or m: less is not told from nothing.
_NOTHING = 1e-4
#: End of an interval of lengths that goes on beyond the belts looked at.
OPEN = math.inf
#: A change helps that leaves less than this part of a rise.
_HELPS = 0.95


def verdict(study: Study) -> list[str]:
    """Some sentences; what is said holds for the cases that were computed."""
    return [of_material(one, study.material) for one in sentences(macros().verdict(study))]


def answered(answer: Answer) -> list[str]:
    """The answer for one drive of an own rig, in the words of ice."""
    return sentences(macros().answered(answer))


def headline(study: Study) -> str:
    """How long the belt must be: of an own rig, or whether the asked ones of the study's do."""
    return " ".join(sentences(macros().headline(study)))


def tiles(study: Study) -> list[tuple[str, str]]:
    """The first answer's lengths, or the shortest belts of the study's rig by speed."""
    return tiles_of(macros().tiles(study))


def printed(study: Study) -> str:
    """What the command prints of it."""
    # what is asked for is printed as it is, what is found with as much as it is worth
    exact = {name: "{:g}".format for name in ("length [m]", "speed [m/s]")}
    style: Any = {"index": False, "formatters": exact, "float_format": two_digits}
    # no columns of an uncertainty that was not asked for
    asked = study.table()[PRINTED].dropna(axis=1, how="all") if study.rows else None
    table = "" if asked is None else asked.to_string(**style)
    return str(macros().printed(study, verdict(study), table))


@cache
def macros() -> Any:
    """The macros of `sentences.txt.j2`."""
    return texts("sentences.txt.j2", __package__, globals())


def two_digits(value: float) -> str:
    """A figure whose doubt is a factor of 0.75 to 2; below 0.1 mK a rise is nothing."""
    return "0" if abs(value) < _NOTHING else f"{float(f'{value:.2g}'):g}"


def span(values: Iterable[float]) -> str:
    """The smallest and the largest of some figures, one where they are the same."""
    values = sorted(values)
    return " to ".join(dict.fromkeys(map(two_digits, (values[0], values[-1]))))


def listed(values: Iterable[float]) -> str:
    """Different figures, growing, the last behind an "and"."""
    *others, last = (f"{value:g}" for value in sorted(set(values)))
    return f"{', '.join(others)} and {last}" if others else last


def percent(share: float) -> str:
    """A share, as a whole number."""
    return f"{100.0 * share:.0f} %"


def outermost(rows: Iterable[Row], low: str, high: str) -> tuple[float, float] | None:
    """Ends of what the doubts of some rows reach over; None where there are none."""
    doubts = [row.uncertainty for row in rows if row.uncertainty is not None]
    if not doubts:
        return None
    return min(map(attrgetter(low), doubts)), max(map(attrgetter(high), doubts))


def helps(row: Row) -> Iterator[tuple[str, float, list[str]]]:
    """Of entry and interface what the rise does, how much, and how much with changes that help."""
    start, *rest = (one for one in row.changes if one.what not in NO_HELP)
    for name, what in (
        ("run", "the belt enters %.2g K warm"),
        ("interface_drift", "the interface warms by %.2g K at constant speed"),
    ):
        rise = getattr(start, name)
        left = sorted((abs(getattr(one, name)), one.what) for one in rest)
        helping = [f"{kelvin:.2g} K with {one}" for kelvin, one in left if kelvin < _HELPS * rise]
        yield what, rise, helping


def too_small(rows: Iterable[Row]) -> list[float]:
    """How many times the study's single pass is too small."""
    return [row.drift.run / row.drift.study for row in rows]


def shares(doubt: Uncertainty) -> list[str]:
    """Unknowns with their shares of the variance, the largest first."""
    words = {one["key"]: one["says"] for one in doubt.single_changes}
    return [f"{words[one['key']]} {one['total']:.0%}" for one in doubt.influences]


def write_numbers(study: Study, folder: Path) -> None:
    """What there is, be it complete or not."""
    write_json(study.summary(), folder / RESULT)
    for name, table in ((TABLE, study.table()), (CHANGES, study.changes()), (DOUBT, study.doubt())):
        if name == TABLE or not table.empty:
            write_table(table, folder / name, index=False)


def page(study: Study, command: str = "") -> tuple[str, list[Picture]]:
    """HTML of a study with rows; its pictures."""
    from .figures import curves_of, draw_doubt, draw_drift, draw_interface, draw_map

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
        __package__ or "",
        **globals(),
        study=study,
        name=tomllib.loads(study.scenario).get("name", "The source study's rig"),
        changes=[start, *sorted(rest, key=lambda one: abs(one.run))],
        pictures={one.name: one for one in pictures},
        command=command,
    )
    return page_of_material(html, study.material), pictures


def on_page(sentence: str) -> str:
    """A sentence of the terminal, escaped, as HTML: signs, units, what is typed."""
    text = escape(_MINUS.sub("−", sentence).replace("W/m2K", "W/(m² K)"), quote=False)
    return re.sub(r"`([^`]+)`", r"<code>\1</code>", text)
