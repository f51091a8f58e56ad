"""Which column of a file is which channel, and in which unit: by header, or by campaign.toml."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from cosim.gap.data.errors import CampaignError
from cosim.names import nearest

from .unit_names import SI, to_si

#: `x`, `x [m]`, `x (m)`, `x/m`
HEADER = re.compile(r"^\s*(?P<name>[^\[(/]*?)\s*(?:[\[(/]\s*(?P<unit>[^\])]*?)\s*[\])]?)?\s*$")
#: `x_mm`, `x mm`, `x.mm`
SUFFIX = re.compile(r"^(?P<name>.*[^\W_])[_ .-](?P<unit>[^\W\d_]+|°)$")


@dataclass(frozen=True)
class Reading:
    """What campaign.toml says of a file: channel -> name of its column, channel -> unit."""

    columns: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Column:
    """A channel's column in a file.

    number : its place; unit : that it is in; to_si : factor; by : who says so, for a reader
    """

    number: int
    unit: str
    to_si: float = 1.0
    by: str = ""


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


def find_columns(path: Path, cells: Sequence[str], reading: Reading) -> dict[str, Column]:
    """channel -> column, of those that a file has; CampaignError in one line."""
    found = {}
    for channel in SI:
        number = _number(path, channel, cells, reading)
        if number is not None:
            found[channel] = _column(path, channel, number, cells[number], reading)
        elif channel in ("t", "x"):
            raise CampaignError(f"{path}: {_missing(channel, cells)}")
    return found


def places_of(channel: str, cells: Sequence[str], reading: Reading) -> list[int]:
    """Where a channel's name stands among the cells of a header."""
    names = [header_parts(cell)[0].lower() for cell in cells]
    if channel in reading.columns:
        wanted = reading.columns[channel].strip()
        whole = [number for number, cell in enumerate(cells) if cell == wanted]
        return whole or [number for number, name in enumerate(names) if name == wanted.lower()]
    taken = {name.strip().lower() for name in reading.columns.values()}
    return [
        number
        for number, (cell, name) in enumerate(zip(cells, names, strict=True))
        if channel_of(name) == channel and not {cell.lower(), name} & taken
    ]


def _number(path: Path, channel: str, cells: Sequence[str], reading: Reading) -> int | None:
    places = places_of(channel, cells, reading)
    name = reading.columns.get(channel)
    if len(places) > 1:
        raise CampaignError(f"{path}: column {name or channel}: there twice, allowed is once")
    if name and not places:
        there, near = [cell for cell in cells if cell], nearest(name, cells)
        one = f"{', '.join(there)}{f' (nearest: {near})' if near else ''}"
        none = f"columns.{channel}: {name} is no column of this file"
        raise CampaignError(f"{path}: {none}, allowed is one of {one}")
    return places[0] if places else None


def _column(path: Path, channel: str, number: int, cell: str, reading: Reading) -> Column:
    """With its unit: what campaign.toml says, what the header says, or SI."""
    stated, said = header_parts(cell)[1], reading.units.get(channel, "")
    if not (stated or said):
        unit = unit_in_name(channel, cell)
        if unit and to_si(channel, unit) != 1.0:  # a name is no word on it
            raise CampaignError(
                f"{path}: column {channel}: the name {cell} ends in {unit}, and no unit is stated; "
                f'allowed is [units] {channel} = "{unit}" in campaign.toml, or "{SI[channel]}" '
                "where it is that"
            )
        return Column(number, SI[channel])
    factor = to_si(channel, said) if said else None
    try:
        by_header = to_si(channel, stated) if stated else factor
    except ValueError as fault:  # a bracket may hold no unit: campaign.toml then says which it is
        if factor is None:
            raise CampaignError(f"{path}: column {channel}: unit {fault}") from None
        by_header = factor
    if factor is not None and by_header != factor:
        differs = f"units.{channel}: {said}, but its header says {cell}"
        raise CampaignError(f"{path}: {differs}; allowed is the same, or a header without one")
    assert by_header is not None
    return Column(number, said or stated, by_header, "campaign.toml" if said else "its header")


def _missing(channel: str, cells: Sequence[str]) -> str:
    line = f"column {channel}: missing (there: {', '.join(cells)})"
    meant = named_with_unit(channel, cells)
    if meant:
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
