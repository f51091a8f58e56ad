"""Judge answers: what was hidden against what was named, by kind and by size in noise units.

A row is a dict with `truth` (the answer file), `found` (verdict, effects, gap; None where the
product failed), `seconds`. A verdict counts as

- exact: `named`, and the effects are just those hidden;
- class: `class`, and the hidden effect is one of its members;
- false positive: anything but `none` where nothing is hidden;
- abstained: `unknown` where a law out of the catalogue is hidden.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import binomtest

SIZES = (0.0, 2.0, 5.0, 10.0, 20.0, 1e9)  # edges of the size classes, noise units
LARGE = 5.0  # noise units from which an effect must be found
SMALL_GAP = 1.5  # noise units that may be left after the right effect is added


@dataclass(frozen=True)
class Share:
    """So many of so many."""

    hits: int
    total: int

    @property
    def value(self) -> float:
        """Between 0 and 1; nan of nothing."""
        return self.hits / self.total if self.total else float("nan")

    @property
    def interval(self) -> tuple[float, float]:
        """95 % interval of the true share (Wilson, 1927)."""
        if not self.total:
            return 0.0, 1.0
        low, high = binomtest(self.hits, self.total).proportion_ci(method="wilson")
        return float(low), float(high)

    def __str__(self) -> str:
        if not self.total:
            return "no campaign"
        low, high = self.interval
        return (
            f"{100 * self.value:.1f} % ({self.hits}/{self.total}; {100 * low:.0f}–{100 * high:.0f})"
        )


def size_of(row: dict) -> float:
    """Size of what is hidden; of two effects that of the smaller, noise units."""
    return min(row["truth"]["size_alone"], default=0.0)


def verdict_of(row: dict) -> str:
    """What the product said; `failed` where it did not."""
    return row["found"]["verdict"] if row["found"] else "failed"


def named(row: dict) -> set[str]:
    """Effects of the verdict, named or as a class."""
    return set(row["found"]["effects"]) if verdict_of(row) in ("named", "class") else set()


def is_exact(row: dict) -> bool:
    """Named, and nothing but what is hidden."""
    return verdict_of(row) == "named" and named(row) == set(row["truth"]["hidden"])


def is_in_class(row: dict) -> bool:
    """A class that holds what is hidden."""
    return verdict_of(row) == "class" and set(row["truth"]["hidden"]) <= named(row)


def is_right(row: dict) -> bool:
    """The effect itself or a class that holds it."""
    return is_exact(row) or is_in_class(row)


def share(rows: Iterable[dict], holds: Callable[[dict], bool]) -> Share:
    """Part of the rows of which something holds."""
    answers = [holds(row) for row in rows]
    return Share(sum(answers), len(answers))


def of_kind(rows: Iterable[dict], kind: str) -> list[dict]:
    """Rows of one kind of campaign."""
    return [row for row in rows if row["truth"]["kind"] == kind]


def large(rows: Iterable[dict]) -> list[dict]:
    """Rows whose every hidden part is large enough that it must be found."""
    return [row for row in rows if size_of(row) >= LARGE]


def by_size(rows: Sequence[dict], holds: Callable[[dict], bool]) -> list[tuple[str, Share]]:
    """Shares by size class, those without a campaign left out."""
    classes = []
    for low, high in zip(SIZES[:-1], SIZES[1:], strict=True):
        inside = [row for row in rows if low <= size_of(row) < high]
        if inside:
            name = f"{low:g}–{high:g}" if high < SIZES[-1] else f"≥ {low:g}"
            classes.append((name, share(inside, holds)))
    return classes


def gap(row: dict, when: str) -> float:
    """Held-out gap before or after, noise units; nan where the product gave none."""
    if not row["found"] or not row["found"].get("gap"):
        return float("nan")
    value = (row["found"]["gap"].get(when) or {}).get("held_out")
    return float("nan") if value is None else float(value)


def closes_gap(row: dict) -> bool:
    """Whether what is left on held-out runs is little."""
    return gap(row, "after") <= SMALL_GAP


def answer_column(row: dict) -> str:
    """Where an answer stands in the confusion matrix."""
    verdict, effects = verdict_of(row), named(row)
    if verdict == "class":
        return "class with it" if is_in_class(row) else "class without it"
    if verdict != "named":
        return verdict
    return next(iter(effects)) if len(effects) == 1 else "several"


def hidden_row(row: dict) -> str:
    """Where a truth stands in the confusion matrix."""
    if row["truth"]["kind"] == "none":
        return "none"
    return row["truth"]["hidden"][0]


def confusion(rows: Sequence[dict]) -> tuple[list[str], list[str], np.ndarray]:
    """Hidden (rows) against answered (columns) of campaigns that hide one thing or none."""
    single = [row for row in rows if row["truth"]["kind"] in ("effects", "none", "unknown")]
    order = {"effects": 0, "none": 1, "unknown": 2}
    hidden = sorted({(order[row["truth"]["kind"]], hidden_row(row)) for row in single})
    labels = [name for _, name in hidden]
    effects = [name for kind, name in hidden if kind == 0]
    answers = [answer_column(row) for row in single]
    rest = ["class with it", "class without it", "several", "none", "unknown", "failed"]
    others = sorted(set(answers) - set(effects) - set(rest))
    columns = effects + others + [name for name in rest if name != "failed" or name in answers]
    counts = np.zeros((len(labels), len(columns)), int)
    for row, column in zip(single, answers, strict=True):
        counts[labels.index(hidden_row(row)), columns.index(column)] += 1
    return labels, columns, counts
