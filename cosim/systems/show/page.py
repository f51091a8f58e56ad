"""The page of a system's run."""

from collections.abc import Mapping
from datetime import datetime
from typing import Any

from cosim.coupling import Affine
from cosim.coupling.conversion import NO_UNIT
from cosim.report.coupling import doubts, step_rows
from cosim.report.page import Picture, number, render, unit_text
from cosim.systems.show.summary import column

#: In the order of the page.
PICTURES = ("signals", "system", "more_signals", "energy", "steps")
#: Part of the energy handed over that may be missing where all of it was taken up.
TAKEN_UP = 1e-9
#: Signals of the headline; change of one that stays, of its size; and by how much of its range one
#: that swings leaves what is between its start and its end.
MOST_SIGNALS, STAYS, SWINGS = 3, 1e-6, 0.01
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
    return render(
        "couple.html.j2",
        "cosim.systems.show",
        numbers=numbers,
        created=datetime.fromisoformat(numbers["created"]).strftime("%d %B %Y, %H:%M %Z"),
        headline=headline(numbers),
        sentence=sentence(numbers),
        tiles=tiles(numbers),
        doubts=[f"{each}." for each in doubts(numbers["coupling"])],
        connections=[_connection_row(each) for each in numbers["connections"]],
        steps=step_rows(numbers["coupling"]),
        figures={**dict.fromkeys(PICTURES), **figures},
        files=files or {},
        example=next(iter(numbers["outputs"]), "time"),
        command=command,
    )


def headline(numbers: Mapping[str, Any]) -> str:
    """What the system did: how the first signals went that are handed over, or any that change."""
    ways = {name: way for name, each in numbers["outputs"].items() if (way := _way(name, each))}
    crossing = dict.fromkeys(column(each["from"]) for each in numbers["connections"])
    told = ([ways[name] for name in crossing if name in ways] or [*ways.values()])[:MOST_SIGNALS]
    went = " and ".join([*filter(None, [", ".join(told[:-1])]), *told[-1:]])
    left = "; ".join(
        f"from {_seconds(each['since'])} on, {each['unit']} moves as no rig does: {each['says']}"
        for each in numbers["beyond_rig"]
    )
    return (
        f"In {_seconds(numbers['time_reached'])} {went or 'no output changes'}"
        f"{f'; but {left}' if left else ''}."
    )


def _way(name: str, output: Mapping[str, Any]) -> str:
    """From where an output went to where, or between what it swung; "" for one that stays."""
    start, end, low, high = (output[key] for key in ("start", "end", "lowest", "highest"))
    if None in (start, end, low, high) or output["rounding"]:
        return ""
    if high - low <= STAYS * max(abs(low), abs(high)):
        return ""
    unit = "" if output["unit"] == NO_UNIT else f" {unit_text(output['unit'])}"
    beyond = max(high - max(start, end), min(start, end) - low)
    if beyond > SWINGS * (high - low):
        return f"{name} is between {number(low)} and {number(high)}{unit}"
    return f"{name} goes from {number(start)} to {number(end)}{unit}"


def sentence(numbers: Mapping[str, Any]) -> str:
    """How the run went, in one sentence."""
    units = len(numbers["participants"])
    steps = numbers["coupling"]["steps"]
    told = (
        f"{units} coupled unit{'s' * (units != 1)} ran for {_seconds(numbers['time_reached'])} in "
        f"{steps} step{'s' * (steps != 1)}"
    )
    ended = "" if numbers["status"] == "complete" else ", then the run ended before its time"
    handed, transits = _energies(numbers)
    if transits and not ended and sum(map(abs, transits)) <= TAKEN_UP * abs(handed):
        ended = f", and all of the {number(handed)} J handed over was taken up"
    return f"{told}{ended}."


def tiles(numbers: Mapping[str, Any]) -> list[tuple[str, str]]:
    """The four figures that stand below the first picture."""
    coupling, (handed, transits) = numbers["coupling"], _energies(numbers)
    rejected = coupling.get("rejected")
    steps = f"macro steps, {rejected} taken back" if rejected else "macro steps"
    third = ("connections", str(len(numbers["connections"])))
    if transits:
        missing = number(sum(transits), 2, largest=handed)
        third = (f"of {number(handed)} J handed over not taken up", f"{missing} J")
    return [
        ("simulated", _seconds(numbers["time_reached"])),
        (steps, str(coupling["steps"])),
        third,
        ("computing time of the units", _seconds(numbers["wall_time"], 2)),
    ]


def _energies(numbers: Mapping[str, Any]) -> tuple[float, list[float]]:
    """J handed over by all connections, and of each how much of it was not taken up."""
    flows = numbers["ledger"]["energies"]
    handed: float = sum(flow["handed"] or 0.0 for flow in flows)
    return handed, [flow["in_transit"] or 0.0 for flow in flows]


def _seconds(value: float | None, digits: int = 4) -> str:
    return number(None) if value is None else f"{number(value, digits)} s"


def _connection_row(each: Mapping[str, Any]) -> tuple[str, str, str, str]:
    units = dict.fromkeys(
        "none" if each[key] == NO_UNIT else unit_text(each[key]) for key in ("unit", "to_unit")
    )
    return each["from"], each["to"], " to ".join(units), str(Affine(each["factor"], each["offset"]))
