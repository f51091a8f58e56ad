"""The page of a system's run."""

import math
from collections.abc import Mapping, Sequence
from datetime import datetime
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cosim.coupling import Affine
from cosim.coupling.conversion import NO_UNIT
from cosim.report.coupling import doubts as doubts
from cosim.report.coupling import step_rows as step_rows
from cosim.report.files import results_line
from cosim.report.page import Picture, number, render, sentences, texts, tiles_of, unit_text
from cosim.report.palette import Scaled, readable
from cosim.systems.show.summary import column

#: Remarks that the terminal shows.
MOST_NOTES = 4
#: In the order of the page.
PICTURES = ("signals", "system", "more_signals", "energy", "steps")
#: Part of the energy handed over that may be missing where all of it was taken up.
TAKEN_UP = 1e-9
#: Signals of the headline; change of one that stays, of its size; and by how much of its range one
#: that swings leaves what is between its start and its end; digits of that range.
MOST_SIGNALS, STAYS, SWINGS, DIGITS = 3, 1e-6, 0.01, 3
#: Units that a prefix is put before.
PREFIXED = ("m", "s", "N", "J", "W", "Pa", "A", "V", "rad", "m/s", "m/s2", "rad/s", "N.m", "J/kg")
OWN_FILES = {
    "result.nc": "everything, with units: netCDF 4, for xarray, ParaView, Matlab",
    "result.csv": "all time series as a table with a header, digits in full",
    "summary.json": "the numbers of this page",
}


def page(
    numbers: Mapping[str, Any],
    figures: Mapping[str, Picture],
    *,
    command: str = "",
    files: Mapping[str, str] | None = None,
) -> str:
    """HTML of a run: the numbers of `summary`, figures by their names, the files beside it."""
    told: dict[str, Any] = {"numbers": numbers, "files": files or {}, "command": command}
    told["figures"] = {**dict.fromkeys(PICTURES), **figures}
    told["created"] = datetime.fromisoformat(numbers["created"])
    # the template calls what this module knows
    return render("couple.html.j2", __package__ or "", **globals() | told)


@cache
def _texts() -> Any:
    """The macros of `couple.txt.j2`."""
    return texts("couple.txt.j2", __package__ or "", globals())


def headline(numbers: Mapping[str, Any]) -> str:
    """What the system did, in one sentence."""
    return " ".join(sentences(_texts().headline(numbers)))


def sentence(numbers: Mapping[str, Any]) -> str:
    """How the run went, in one sentence."""
    return " ".join(sentences(_texts().sentence(numbers)))


def tiles(numbers: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Words and figures, four of them."""
    return tiles_of(_texts().tiles(numbers))


def closing_lines(numbers: Mapping[str, Any], folder: Path, wall_time: float) -> list[str]:
    """What whoever waited for the run is told."""
    return [*_texts().closing(numbers, wall_time).strip("\n").split("\n"), results_line(folder)]


def in_few_lines(said: Sequence[str]) -> list[str]:
    """The first of them, and how many more there are."""
    more = len(said) - MOST_NOTES
    return [*said[:MOST_NOTES], *([f"{more} more on the page"] if more > 0 else [])]


def ways(numbers: Mapping[str, Any]) -> list[str]:
    """How the first signals went that are handed over, or any that change."""
    went = {name: way for name, each in numbers["outputs"].items() if (way := _way(name, each))}
    crossing = dict.fromkeys(column(each["from"]) for each in numbers["connections"])
    return ([went[name] for name in crossing if name in went] or [*went.values()])[:MOST_SIGNALS]


def _way(name: str, output: Mapping[str, Any]) -> str:
    """From where an output went to where, or between what it swung; "" for one that stays."""
    start, end, low, high = (output[key] for key in ("start", "end", "lowest", "highest"))
    if None in (start, end, low, high) or output["rounding"]:
        return ""
    if high - low <= STAYS * max(abs(low), abs(high)):
        return ""
    scaled = scale(np.array([low, high]), output["unit"])
    unit = "" if output["unit"] == NO_UNIT else f" {unit_text(scaled.unit)}"
    decimals = DIGITS - 1 - math.floor(math.log10(scaled.factor * (high - low)))

    def told(value: float) -> str:
        return number(round(scaled.factor * value, decimals), 2 * DIGITS)

    beyond = max(high - max(start, end), min(start, end) - low)
    if beyond > SWINGS * (high - low):
        return f"{name} is between {told(low)} and {told(high)}{unit}"
    return f"{name} goes from {told(start)} to {told(end)}{unit}"


def scale(values: NDArray[np.float64], unit: str) -> Scaled:
    """The readable unit of a signal that has one."""
    return readable(values, unit) if unit in PREFIXED else Scaled(1.0, unit)


def energies(numbers: Mapping[str, Any]) -> tuple[float, list[float]]:
    """J handed over by all connections, and of each how much of it was not taken up."""
    flows = numbers["ledger"]["energies"]
    handed: float = sum(flow["handed"] or 0.0 for flow in flows)
    return handed, [flow["in_transit"] or 0.0 for flow in flows]


def seconds(value: float | None, digits: int = 4) -> str:
    return number(None) if value is None else f"{number(value, digits)} s"


def connection_row(each: Mapping[str, Any]) -> tuple[str, str, str, str]:
    """Its ends, units, and what it does to a value."""
    units = dict.fromkeys(
        "none" if each[key] == NO_UNIT else unit_text(each[key]) for key in ("unit", "to_unit")
    )
    return each["from"], each["to"], " to ".join(units), str(Affine(each["factor"], each["offset"]))
