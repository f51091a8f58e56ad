"""The scores as Markdown: kinds of answers, effects, parameters, times."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

import numpy as np

from .answers import Row
from .outcome import Outcome, is_right, outcome
from .parameters import WANTED, Compared, compared
from .shares import share

SIZES = (0.0, 2.0, 5.0, 10.0, 20.0, 1e9)  # edges of the size classes, noise units


def table(head: Sequence[str], lines: Iterable[Sequence[object]]) -> str:
    """A Markdown table."""
    rows = [head, ["---"] * len(head), *lines]
    return "\n".join("| " + " | ".join(str(cell) for cell in row) + " |" for row in rows) + "\n"


def by_suite(rows: Sequence[Row]) -> Iterator[tuple[str, list[Row]]]:
    """Suites in the order in which they are met first."""
    for suite in dict.fromkeys(row.suite for row in rows):
        yield suite, [row for row in rows if row.suite == suite]


def kinds_table(rows: Sequence[Row]) -> str:
    """How many answers of each kind, and how many right ones."""
    lines = []
    for suite, of_suite in by_suite(rows):
        counts = Counter(outcome(row) for row in of_suite)
        right = sum(map(is_right, of_suite))
        lines.append((suite, len(of_suite), right, *(counts[kind] or "" for kind in Outcome)))
    return table(("suite", "campaigns", "right", *Outcome), lines)


def what_is_hidden(row: Row) -> str:
    """Name of the hidden effect, effects or kind."""
    names = sorted(row.truth.effects or row.truth.members) or [row.truth.kind or "nothing"]
    return " + ".join(names)


def hidden_table(rows: Sequence[Row]) -> str:
    """Right answers by what is hidden."""
    lines = []
    for name in sorted({what_is_hidden(row) for row in rows}):
        of_name = [row for row in rows if what_is_hidden(row) == name]
        counts = Counter(outcome(row) for row in of_name)
        lines.append((name, share(of_name, is_right), *(counts[kind] or "" for kind in Outcome)))
    return table(("hidden", "right", *Outcome), lines)


def size_table(rows: Sequence[Row]) -> str:
    """Right answers by the size of the smallest hidden thing."""
    sized = [(row.truth.size, row) for row in rows if row.truth.size is not None]
    lines = []
    for low, high in pairwise(SIZES):
        some = [row for size, row in sized if low <= size < high]
        if some:
            counts = Counter(outcome(row) for row in some)
            name = f"{low:g} to {high:g}" if high < SIZES[-1] else f"from {low:g}"
            lines.append((name, share(some, is_right), *(counts[kind] or "" for kind in Outcome)))
    return table(("size / noise", "right", *Outcome), lines)


def contact_table(rows: Sequence[Row]) -> str:
    """Right answers by the form of the contact, where it is told."""
    forms = sorted({str(row.truth.contact["form"]) for row in rows if row.truth.contact})
    lines = [
        (form, share([r for r in rows if r.truth.contact.get("form") == form], is_right))
        for form in forms
    ]
    return table(("contact", "right"), lines)


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
        "Kinds of answers": kinds_table(rows),
        "By what is hidden": hidden_table(rows),
        "By size": size_table(rows),
        "By contact": contact_table(rows),
        "Parameters of right answers": parameter_table(found),
        "Time of an answer, each on one core": times(rows),
    }
    return f"# {title}\n\n" + "\n".join(f"## {head}\n{text}" for head, text in parts.items())
