"""The page of a system's run."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime
from typing import Any

from cosim.coupling import Affine
from cosim.coupling.conversion import NO_UNIT
from cosim.report.coupling import doubts, step_rows
from cosim.report.page import Picture, number, render
from cosim.report.style import SPELLING

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
    """HTML of a run: the numbers of `summary`, figures by their names, further files to list."""
    own = OWN_FILES | {f"{name}.png": "figure, as above" for name in figures}
    return render(
        "couple.html.j2",
        "cosim.systems.show",
        numbers=numbers,
        created=datetime.fromisoformat(numbers["created"]).strftime("%d %B %Y, %H:%M %Z"),
        overview=overview(numbers),
        doubts=[f"{each}." for each in doubts(numbers["coupling"])],
        connections=[_connection_row(each) for each in numbers["connections"]],
        units=_units(numbers["participants"]),
        steps=step_rows(numbers["coupling"]),
        figures={**dict.fromkeys(("system", "signals", "energy", "steps")), **figures},
        files=own | dict(files or {}),
        example=next(iter(numbers["outputs"]), "time"),
        command=command,
    )


def overview(numbers: Mapping[str, Any]) -> list[tuple[str, str]]:
    """What stands at the top."""
    coupling = numbers["coupling"]
    found = [
        ("simulated", _seconds(numbers["time_reached"])),
        ("units", str(len(numbers["participants"]))),
        ("connections", str(len(numbers["connections"]))),
        ("macro steps", str(coupling["steps"])),
        ("computing time", _seconds(numbers["wall_time"])),
    ]
    if coupling.get("rejected"):
        found.insert(4, ("steps taken back", str(coupling["rejected"])))
    return found


def _seconds(value: float | None) -> str:
    return f"{number(value)} s" if value is not None else number(None)


def _connection_row(each: Mapping[str, Any]) -> tuple[str, str, str, str]:
    units = [SPELLING.get(each[key], each[key]) for key in ("unit", "to_unit")]
    units = ["none" if unit == NO_UNIT else unit for unit in units]
    unit = units[0] if units[0] == units[1] else " to ".join(units)
    return each["from"], each["to"], unit, str(Affine(each["factor"], each["offset"]))


def _units(participants: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    """Head and rows of the table of units; columns that no unit has are left out."""
    columns = {
        "file": "file",
        "inputs": "inputs",
        "outputs": "outputs",
        "set": "values set",
        "substeps": "steps a macro step",
        "steps": "macro steps made",
        "seconds": "in the unit [s]",
        "messages": "messages",
    }
    there = [key for key in columns if any(key in each for each in participants.values())]
    if all(each.get("substeps", 1) == 1 for each in participants.values()):
        there = [key for key in there if key != "substeps"]
    rows = [
        (name, *(_cell(key, each.get(key)) for key in there)) for name, each in participants.items()
    ]
    return {"head": ["unit", *(columns[key] for key in there)], "rows": rows}


def _cell(key: str, value: Any) -> str:
    if key == "set":
        return str(len(value or {}))
    return number(value, 3) if isinstance(value, float) else str(value)
