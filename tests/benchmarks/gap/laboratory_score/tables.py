"""The scores as Markdown: kinds of answers, effects, parameters, times."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np

from .answers import Row
from .outcome import Outcome, is_right, outcome
from .parameters import WANTED, Compared, compared
from .shares import share

SIZES = (0.0, 2.0, 5.0, 10.0, 20.0)  # where the size classes begin, noise units


def table(head: Sequence[str], lines: Iterable[Sequence[object]]) -> str:
    """A Markdown table."""
    rows = [head, ["---"] * len(head), *lines]
    return "\n".join("| " + " | ".join(str(cell) for cell in row) + " |" for row in rows) + "\n"


def by_suite(rows: Sequence[Row]) -> Iterator[tuple[str, list[Row]]]:
    """Suites in the order in which they are met first."""
    for suite in dict.fromkeys(row.suite for row in rows):
        yield suite, [row for row in rows if row.suite == suite]


def by(head: str, key: Callable[[Row], str | None], rows: Sequence[Row]) -> str:
    """Right answers, and how many of each kind, of all rows that are alike; None: not counted."""
    groups: dict[str, list[Row]] = {}
    for row in rows:
        if (name := key(row)) is not None:
            groups.setdefault(name, []).append(row)
    lines = []
    for name, some in groups.items():
        counts = Counter(map(outcome, some))
        lines.append((name, share(some, is_right), *(counts[kind] or "" for kind in Outcome)))
    return table((head, "right", *Outcome), lines)


def what_is_hidden(row: Row) -> str:
    """Name of the hidden effect, effects or kind."""
    names = sorted(row.truth.effects or row.truth.members) or [row.truth.kind or "nothing"]
    return " + ".join(names)


def size_class(row: Row) -> str | None:
    """Of the smallest hidden thing, in units of the noise."""
    size = row.truth.size
    return None if size is None else f"from {max(edge for edge in SIZES if edge <= size):g}"


def parameter_table(found: Sequence[Compared]) -> str:
    """Coverage of 90 % intervals by parameter, in right answers, and the estimates' distances."""
    lines = []
    for key in [*sorted({each.key for each in found}), ""]:
        some = [each for each in found if key in ("", each.key)]
        covered = share(some, Compared.covers)
        away = np.median([each.distance for each in some]) if some else float("nan")
        lines.append((key or "all", covered, f"{away:.2f}"))
    head = ("parameter", f"{WANTED:.0%} interval holds the truth", "median distance / sd")
    return table(head, lines)


def times(rows: Sequence[Row]) -> str:
    """Seconds of an answer."""
    lines = []
    for suite, of_suite in [*by_suite(rows), ("all", list(rows))]:
        wall = [row.seconds for row in of_suite if row.found is not None]
        cpu = [row.cpu for row in of_suite if row.found is not None]
        if wall:
            figures = [*np.percentile(wall, (50, 95)), *np.percentile(cpu, (50, 95))]
            lines.append((suite, len(wall), *(f"{figure:.1f}" for figure in figures)))
    head = ("suite", "answers", "wall, median / s", "wall, 95 % / s", "processor, median / s")
    return table((*head, "processor, 95 % / s"), lines)


def markdown(rows: Sequence[Row], title: str) -> str:
    """All tables on a page."""
    found = [each for row in rows for each in compared(row)]
    parts = {
        "Kinds of answers": by("suite", lambda row: row.suite, rows),
        "By what is hidden": by("hidden", what_is_hidden, sorted(rows, key=what_is_hidden)),
        "By size": by("size / noise", size_class, sorted(rows, key=lambda r: r.truth.size or 0.0)),
        "By contact": by("contact", lambda row: row.truth.contact.get("form"), rows),
        "Parameters of right answers": parameter_table(found),
        "Time of an answer, each on one core": times(rows),
    }
    return f"# {title}\n\n" + "\n".join(f"## {head}\n{text}" for head, text in parts.items())
