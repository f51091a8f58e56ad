"""The page of a comparison: what differs in what made them, then numbers, then curves."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from cosim.report.page import Picture, render
from cosim.report.quantities import digits, told, worded

from .compare import Comparison, Difference

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
        has_scenarios=bool(both.a.scenario and both.b.scenario),
        groups=groups(both),
        same=len(both.numbers) - len(both.different),
        different=len(both.different),
        pictures=pictures,
        command=command,
    )


def _key(value: Any) -> str:
    return "(not there)" if value is None else digits(value) if value != [] else "[]"


def groups(both: Comparison) -> list[tuple[str, list[tuple[str, ...]]]]:
    """Title -> rows of the numbers that differ: name, A, B, difference, relative."""
    found: dict[str, list[tuple[str, ...]]] = {}
    for one in both.different:
        group, _, name = one.name.partition(".") if "." in one.name else ("", "", one.name)
        words = ", ".join(worded(part) for part in name.split("."))
        found.setdefault(TITLES.get(group, worded(group)), []).append((words, *cells(one)))
    return list(found.items())


def cells(one: Difference) -> tuple[str, str, str, str]:
    """A, B, difference and relative difference as they are read."""
    share = one.name.endswith("share") or one.name.startswith("heat_shares.")
    return (
        told(one.a, one.unit, share),
        told(one.b, one.unit, share),
        told(one.difference, one.unit, share),
        "–" if one.relative is None else _percent(one.relative),
    )


def _percent(part: float) -> str:
    if abs(part) >= 10.0:
        return f"{part + 1.0:.3g} times".replace("-", "−")
    return f"{100.0 * part:+.3g} %".replace("-", "−")
