"""Which column of a file is which channel, and in which unit: by header, or by campaign.toml."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from cosim.gap.data.errors import CampaignError, ColumnMissing
from cosim.names import nearest

#: Channel -> what it is in inside.
SI = {"t": "s", "x": "m", "y": "m", "phi": "rad", "force": "N"}
_WHAT = {"s": "time", "m": "length", "rad": "angle", "N": "force"}
_SPELLED = {"n": "nano", "u": "micro", "m": "milli", "c": "centi", "k": "kilo"}
#: SI unit -> name of a unit that somebody measures in -> factor.
FACTORS = {
    "s": {"s": 1.0, "ns": 1e-9, "us": 1e-6, "ms": 1e-3, "min": 60.0},
    "m": {"m": 1.0, "nm": 1e-9, "um": 1e-6, "mm": 1e-3, "cm": 1e-2, "km": 1e3},
    "rad": {"rad": 1.0, "urad": 1e-6, "mrad": 1e-3, "deg": math.pi / 180.0},
    "N": {"N": 1.0, "uN": 1e-6, "mN": 1e-3, "kN": 1e3},
}
#: Other words -> the unit.
_WORDS = {
    "°": "deg", "degree": "deg", "degrees": "deg", "sec": "s", "second": "s", "seconds": "s",
    "metre": "m", "metres": "m", "meter": "m", "meters": "m", "radian": "rad", "radians": "rad",
    "newton": "N", "newtons": "N",
}  # fmt: skip


def to_si(channel: str, unit: str) -> float:
    """Factor from a unit to that of a channel; ValueError: what is wrong and what is allowed.

    >>> to_si("x", "mm"), to_si("y", "µm"), round(180.0 * to_si("phi", "°"), 4)
    (0.001, 1e-06, 3.1416)
    """
    units = FACTORS[SI[channel]]
    if (name := _name(unit)) in units:
        return units[name]
    near = nearest(unit.lower(), words := _words(SI[channel]))
    fault = "is of another kind" if is_unit(unit) else "is no unit that is known"
    hint = f" (nearest: {words[near]})" if near and not is_unit(unit) else ""
    raise ValueError(f"{unit} {fault}, allowed is a {_WHAT[SI[channel]]}: {', '.join(units)}{hint}")


def is_unit(text: str) -> bool:
    """Whether a text is a unit of any channel, in brackets or not.

    >>> is_unit("mm"), is_unit("[ms]"), is_unit("lost")
    (True, True, False)
    """
    return any(_name(text.strip().strip("[]()").strip()) in units for units in FACTORS.values())


def _name(unit: str) -> str:
    """As it is listed: there are two signs for micro."""
    return _WORDS.get(unit, unit.replace("µ", "u").replace("μ", "u"))


def _words(wanted: str) -> dict[str, str]:
    """What a word may be meant for: `MM` for mm, `msec` and `millimetre` too."""
    words = [wanted, *(word for word, name in _WORDS.items() if name == wanted)]
    return {name.lower(): name for name in FACTORS[wanted]} | {
        begin + word: prefix + wanted
        for prefix, whole in _SPELLED.items()
        if prefix + wanted in FACTORS[wanted]
        for begin in (prefix, whole)
        for word in words
    }


#: `x`, `x [m]`, `x (m)`, `x/m`
HEADER = re.compile(r"^\s*(?P<name>[^\[(/]*?)\s*(?:[\[(/]\s*(?P<unit>[^\])]*?)\s*[\])]?)?\s*$")
#: `x_mm`, `x mm`, `x.mm`
SUFFIX = re.compile(r"^(?P<name>.*[^\W_])[_ .-](?P<unit>[^\W\d_]+|°)$")


class Reading(NamedTuple):
    """What campaign.toml says of a file: channel -> name of its column, channel -> unit."""

    columns: Mapping[str, str] = {}
    units: Mapping[str, str] = {}


class Column(NamedTuple):
    """A channel's column in a file.

    number : its place; to_si : factor; converted : from what, and who says so, for a reader
    """

    number: int
    to_si: float = 1.0
    converted: str = ""


def header_parts(cell: str) -> tuple[str, str]:
    """Name and unit of a header's cell, "" for none.

    >>> header_parts("x [mm]"), header_parts("t/ms"), header_parts("phi (deg)"), header_parts("y")
    (('x', 'mm'), ('t', 'ms'), ('phi', 'deg'), ('y', ''))
    """
    match = HEADER.match(cell)
    return (match["name"], match["unit"] or "") if match else (cell, "")


def channel_of(name: str) -> str:
    """The channel that a name is by itself."""
    return "t" if name.strip().lower() == "time" else name.strip().lower()


def unit_in_name(channel: str, name: str) -> str:
    """The unit that a column's name ends in, of those of a channel; "" where it ends in none.

    >>> unit_in_name("x", "x_mm"), unit_in_name("phi", "angle deg"), unit_in_name("x", "x_left")
    ('mm', 'deg', '')
    """
    match = SUFFIX.match(name.strip())
    try:
        return match["unit"] if match and to_si(channel, match["unit"]) else ""
    except ValueError:
        return ""


def named_with_unit(channel: str, cells: Sequence[str]) -> tuple[str, str] | None:
    """The first cell such as `x_mm`, and its unit."""
    for cell in map(str.strip, cells):
        unit = unit_in_name(channel, cell)
        if unit and channel_of(cell[: -len(unit) - 1]) == channel:
            return cell, unit
    return None


def find_columns(cells: Sequence[str], reading: Reading) -> dict[str, Column]:
    """channel -> column, of those that a file has; CampaignError without the file's name."""
    found = {}
    for channel in SI:
        places, name = places_of(channel, cells, reading), reading.columns.get(channel)
        if len(places) > 1:
            raise CampaignError(f"column {name or channel}: there twice, allowed is once")
        if places:
            cell = cells[places[0]]
            found[channel] = _column(channel, places[0], cell, reading.units.get(channel, ""))
        elif name:
            hint = f" (nearest: {near})" if (near := nearest(name, cells)) else ""
            there = ", ".join(filter(None, cells))
            none = f"columns.{channel}: {name} is no column of this file"
            raise CampaignError(f"{none}, allowed is one of {there}{hint}")
        elif channel in ("t", "x"):
            raise ColumnMissing(_missing(channel, cells))
    return found


def places_of(channel: str, cells: Sequence[str], reading: Reading) -> list[int]:
    """Where a channel's name stands among the cells of a header."""
    names = [header_parts(cell)[0].lower() for cell in cells]
    if channel in reading.columns:
        wanted = reading.columns[channel].strip()
        whole = [number for number, cell in enumerate(cells) if cell == wanted]
        return whole or [number for number, name in enumerate(names) if name == wanted.lower()]
    taken = {name.strip().lower() for name in reading.columns.values()}
    free = [not {cell.lower(), name} & taken for cell, name in zip(cells, names, strict=True)]
    return [i for i, name in enumerate(names) if free[i] and channel_of(name) == channel]


def _column(channel: str, number: int, cell: str, said: str) -> Column:
    """With its unit: what campaign.toml says, what the header says, or SI."""
    stated = header_parts(cell)[1]
    if not (stated or said):
        unit = unit_in_name(channel, cell)
        if unit and to_si(channel, unit) != 1.0:  # a name is no word on it
            raise CampaignError(
                f"column {channel}: the name {cell} ends in {unit}, and no unit is stated; "
                f'allowed is [units] {channel} = "{unit}" in campaign.toml, or "{SI[channel]}" '
                "where it is that"
            )
        return Column(number)
    try:
        factor = to_si(channel, stated) if stated else None
    except ValueError as fault:  # a bracket may hold no unit: campaign.toml then says which it is
        if not said:
            raise CampaignError(f"column {channel}: unit {fault}") from None
        factor = None
    wanted = to_si(channel, said or stated)
    if factor not in (None, wanted):
        differs = f"units.{channel}: {said}, but its header says {cell}"
        raise CampaignError(f"{differs}; allowed is the same, or a header without one")
    who = "campaign.toml" if said else "its header"
    converted = f"{channel} from {said or stated} to {SI[channel]} ({who})"
    return Column(number, wanted, converted if wanted != 1.0 else "")


def _missing(channel: str, cells: Sequence[str]) -> str:
    line = f"column {channel}: missing (there: {', '.join(cells)})"
    if meant := named_with_unit(channel, cells):
        name, unit = meant
        return (
            f'{line}; is {name} meant? allowed is [columns] {channel} = "{name}" with [units] '
            f'{channel} = "{unit}" in campaign.toml, or a header {channel} [{unit}]'
        )
    near = nearest(channel, [header_parts(cell)[0].lower() for cell in cells if cell not in SI])
    return (
        f"{line}, allowed is t,x[,y][,phi][,force]{f'; is {near} meant?' if near else ''} or the "
        f"name of its column as columns.{channel} in campaign.toml"
    )
