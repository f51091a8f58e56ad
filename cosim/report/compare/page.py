"""The page of a comparison: what differs in what made them, then numbers, then curves."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from cosim.report.page import Picture, render
from cosim.report.quantities import DIGITS, NONE, ROUNDING, digits, told, worded

from .compare import Comparison, Difference
from .series import Apart

#: What a difference of two values in such a unit is in.
DEGREES = {"degC": "K"}
#: A difference by so many times the value is told as times the value.
MANY = 10.0
#: Titles of the summary's groups.
TITLES = {
    "": "Run",
    "after_run_up": "After the speed ramp",
    "whole_run": "Whole run",
    "ledger": "Ledgers",
    "heat_shares": "Where the heat is at the end",
    "temperatures": "Temperatures",
    "stability": "Stability",
    "regimes": "Regimes",
    "melting": "Melting",
    "outputs": "Outputs",
    "overstretched": "How far springs are stretched",
    "left_belt": "How far the block is off the middle",
}


def page(both: Comparison, pictures: Sequence[Picture], command: str = "") -> str:
    """HTML of a comparison."""
    return render(
        "compare.html.j2",
        "cosim.report.compare",
        a=both.a,
        b=both.b,
        remarks=both.remarks,
        keys=[(key, _key(left), _key(right)) for key, (left, right) in both.keys.items()],
        alike=bool(both.a.scenario) is bool(both.b.scenario),
        systems=not (both.a.scenario or both.b.scenario),
        groups=groups(both.different),
        of_one=[(name, _of_one(both, side)) for name, side in (("A", "a"), ("B", "b"))],
        curves=[curve_cells(one) for one in both.curves],
        same=sum(one.same for one in both.numbers),
        different=len(both.different),
        pictures=pictures,
        command=command,
    )


def _key(value: Any) -> str:
    return "(not there)" if value is None else digits(value) if value != [] else "[]"


def groups(numbers: Iterable[Difference]) -> list[tuple[str, list[tuple[str, ...]]]]:
    """Title -> rows of numbers: name, A, B, difference, relative."""
    found: dict[str, list[tuple[str, ...]]] = {}
    for one in numbers:
        group, _, name = one.name.partition(".") if "." in one.name else ("", "", one.name)
        words = ", ".join(worded(part) for part in name.split("."))
        found.setdefault(TITLES.get(group, worded(group)), []).append((words, *cells(one)))
    return list(found.items())


def _of_one(both: Comparison, side: str) -> list[tuple[str, list[tuple[str, str]]]]:
    """Title -> names and values of what only one of them has."""
    column = 1 if side == "a" else 2
    those = [one for one in both.of_one if getattr(one, side) is not None]
    return [(title, [(row[0], row[column]) for row in rows]) for title, rows in groups(those)]


def curve_cells(one: Apart) -> tuple[str, str, str, str, str]:
    """Name, largest difference, when, root of the mean square, the largest by A's span."""
    unit = DEGREES.get(one.unit, one.unit)
    nothing = ROUNDING.get(unit, 0.0)
    return (
        one.name,
        told(one.largest, unit, count=DIGITS),
        told(one.at, "s", count=DIGITS),
        told(one.rms, unit, count=DIGITS),
        NONE if one.span <= nothing else f"{100.0 * abs(one.largest) / one.span:.3g} %",
    )


def cells(one: Difference) -> tuple[str, str, str, str]:
    """A, B, difference and relative difference as they are read."""
    share = one.name.endswith("share") or one.name.startswith("heat_shares.")
    return (
        told(one.a, one.unit, share, DIGITS),
        told(one.b, one.unit, share, DIGITS),
        told(one.difference, DEGREES.get(one.unit, one.unit), share, DIGITS),
        NONE if one.relative is None else _percent(one.relative),
    )


def _percent(part: float) -> str:
    if part >= MANY:
        return f"{part + 1.0:.3g} times"
    return f"{100.0 * part:+.3g} %".replace("-", "−")
