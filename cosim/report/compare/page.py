"""The page of a comparison: what differs in what made them, then numbers, then curves."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from cosim.report import quantities
from cosim.report.files import write_json
from cosim.report.page import Picture, render, sentences, texts, tiles_of
from cosim.report.quantities import DIGITS, FOUND, NONE, digits, is_share, told, worded

from .compare import SAME, Apart, Comparison, Difference

RESULT, PAGE = "compare.json", "report.html"
#: What a difference of two values in such a unit is in.
DEGREES = {"degC": "K"}
#: A difference by so many times the value is told as times the value.
MANY = 10.0
#: Of two numbers that differ by less than is told of them.
EQUAL = "equal within rounding"
#: Numbers that are on the page only.
OTHER_STARTS = tuple(f"regimes.{start}." for start in ("disturbed", "rest", "riding", "ramp"))
#: Unit -> what no rig tells from nothing: a part of it, or a figure at the top, would say nothing.
UNFELT = {"m": 1e-7, "m/s": 1e-6, "rad": 1e-6, "rad/s": 1e-5, "N": 1e-6, "N.m": 1e-7, "K": 1e-6}
#: Digits that a difference is worth.
OF_DIFFERENCE = 2
#: Titles of the summary's groups.
TITLES = quantities.TABLES["compared"]


def write_numbers(both: Comparison, folder: Path) -> None:
    """All numbers of both."""
    write_json(both.summary(), folder / RESULT)


def pictures(both: Comparison) -> list[Picture]:
    """What moves in both, one over the other, and phase portraits."""
    from .figures import draw_phases, has_phases, moving, overlay

    found = [overlay(both)] if moving(both) else []
    return [*found, draw_phases(both)] if has_phases(both) else found


def page(both: Comparison, command: str = "") -> tuple[str, list[Picture]]:
    """HTML of a comparison, and its pictures."""
    drawn = pictures(both)
    # the template calls what this module knows
    told = {"both": both, "pictures": drawn, "command": command}
    return render("compare.html.j2", __package__ or "", **globals() | told), drawn


def headline(both: Comparison) -> str:
    """Whether the two differ, and by how much, in one sentence."""
    return " ".join(sentences(_text().headline(both, _felt(both))))


def tiles(both: Comparison) -> list[tuple[str, str]]:
    """Up to four figures: what differs in what made them, in the numbers, and how far in curves."""
    return tiles_of(_text().tiles(both, _felt(both)))


def printed(both: Comparison) -> str:
    """What the command prints: what differs in the scenarios, and in the numbers."""
    told = [one for one in both.different if not one.name.startswith(OTHER_STARTS)]
    rows = [("number", "A", "B", "B - A", "relative"), *((one.name, *cells(one)) for one in told)]
    name, *others = (max(map(len, column)) for column in zip(*rows, strict=True))
    shown = [[first.ljust(name), *map(str.rjust, cells_of, others)] for first, *cells_of in rows]
    return str(_text().printed(both, shown if told else ()))


def _text() -> Any:
    """The macros of `compare.txt.j2`, which call what this module knows."""
    return texts("compare.txt.j2", __package__ or "", globals())


def _felt(both: Comparison) -> list[Apart]:
    return [one for one in both.curves if abs(one.largest) > _unfelt(one)]


def _unfelt(one: Apart) -> float:
    unit = DEGREES.get(one.unit, one.unit)
    return max(quantities.ROUNDING.get(unit, 0.0), UNFELT.get(unit, 0.0))


def at_top(one: Apart) -> str:
    """The largest difference of a curve, at the top of the page."""
    return told(abs(one.largest), DEGREES.get(one.unit, one.unit), count=FOUND)


def equal_count(both: Comparison) -> int:
    """Of the numbers, those that are the same."""
    return sum(one.same for one in both.numbers)


def keyed(value: Any) -> str:
    """A key's value on the page, where there is one."""
    return key_text(value) if value != [] else "[]"


def key_text(value: Any) -> str:
    """The same on the terminal."""
    return "(not there)" if value is None else digits(value)


def groups(numbers: Iterable[Difference]) -> list[tuple[str, list[tuple[str, ...]]]]:
    """Title -> rows of numbers: name, A, B, difference, relative."""
    found: dict[str, list[tuple[str, ...]]] = {}
    for one in numbers:
        group, name = one.name.split(".", 1) if "." in one.name else ("", one.name)
        words = ", ".join(worded(part) for part in name.split("."))
        found.setdefault(TITLES.get(group, worded(group)), []).append((words, *cells(one)))
    return list(found.items())


def of_one(both: Comparison, side: str, column: int) -> list[tuple[str, list[tuple[str, str]]]]:
    """Title -> names and values of what only one of them has."""
    those = [one for one in both.of_one if getattr(one, side) is not None]
    return [(title, [(row[0], row[column]) for row in rows]) for title, rows in groups(those)]


def curve_cells(one: Apart) -> tuple[str, str, str, str, str]:
    """Name, largest difference, when, root of the mean square, the largest by A's span."""
    unit = DEGREES.get(one.unit, one.unit)
    nothing = max(_unfelt(one), SAME * abs(one.largest))
    return (
        one.name,
        told(one.largest, unit, count=FOUND),
        told(one.at, "s", count=FOUND),
        told(one.rms, unit, count=OF_DIFFERENCE),
        NONE if one.span <= nothing else _percent(abs(one.largest) / one.span),
    )


def cells(one: Difference) -> tuple[str, str, str, str]:
    """A, B, difference and relative difference as they are read.

    A and B have the digits that a run is worth, or so many more that they are told apart.
    """
    share = is_share(one.name)
    for count in range(FOUND, DIGITS + 1):
        a, b = (told(value, one.unit, share, count) for value in (one.a, one.b))
        if a != b:
            break
    unit = DEGREES.get(one.unit, one.unit)
    difference = told(one.difference, unit, share, count if share else OF_DIFFERENCE)
    if one.in_both and a == b and _is_zero(difference):
        relative = EQUAL
    elif one.relative is None or _is_zero(a):
        relative = NONE  # nobody can check a part of what reads 0
    else:
        relative = _change(one.relative)
    return a, b, difference, relative


def _is_zero(told: str) -> bool:
    """Whether a number reads 0, with whatever digits: "0.00°"."""
    return not any(digit in told.split(" ")[0] for digit in "123456789")


def _change(part: float) -> str:
    if part >= MANY:
        return f"{digits(part + 1.0, OF_DIFFERENCE)} times"
    return f"{'+' if part > 0.0 else ''}{_percent(part)}"


def _percent(part: float) -> str:
    return f"{digits(100.0 * part, OF_DIFFERENCE)} %"
