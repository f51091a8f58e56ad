"""Which column of a file is which channel, and in which unit: by header, or by campaign.toml."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from cosim.coupling.conversion import IDENTITY, Affine
from cosim.gap.data.errors import CampaignError
from cosim.names import nearest

from .unit_names import SI, to_si

ALIASES = {"time": "t"}
#: `x`, `x [m]`, `x (m)`, `x/m`
#: `x_mm`, `x mm`, `x.mm`
SUFFIX = re.compile(r"^.*[^\W_][_ .-](?P<unit>[^\W\d_]+|°)$")
HEADER = re.compile(r"^\s*(?P<name>[^\[(/]*?)\s*(?:[\[(/]\s*(?P<unit>[^\])]*?)\s*[\])]?)?\s*$")


@dataclass(frozen=True)
class Reading:
    """What campaign.toml says of a file: channel -> name of its column, channel -> unit."""

    columns: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Column:
    """A channel's column in a file.

    number : its place; unit : that it is in; factor : to SI; by : who says so, for a reader
    """

    number: int
    unit: str
    to_si: Affine = IDENTITY
    by: str = ""


def header_parts(cell: str) -> tuple[str, str]:
    """Name and unit of a header's cell, "" for none.

    >>> header_parts("x [mm]"), header_parts("t/ms"), header_parts("phi (deg)"), header_parts("y")
    (('x', 'mm'), ('t', 'ms'), ('phi', 'deg'), ('y', ''))
    """
    match = HEADER.match(cell)
    return (match["name"], match["unit"] or "") if match else (cell, "")


def unit_in_name(channel: str, name: str) -> str:
    """The unit that a column's name ends in, of those of a channel; "" where it ends in none.

    >>> unit_in_name("x", "x_mm"), unit_in_name("phi", "angle deg"), unit_in_name("x", "x_left")
    ('mm', 'deg', '')
    """
    match = SUFFIX.match(name.strip())
    if match is None:
        return ""
    try:
        to_si(channel, match["unit"])
    except ValueError:
        return ""
    return match["unit"]


def named_with_unit(channel: str, cells: Sequence[str]) -> tuple[str, str] | None:
    """The first cell such as `x_mm`, and its unit."""
    for cell in cells:
        unit = unit_in_name(channel, cell)
        name = cell.strip()[: -len(unit) - 1].lower() if unit else ""
        if unit and ALIASES.get(name, name) == channel:
            return cell.strip(), unit
    return None


def find_columns(path: Path, cells: Sequence[str], reading: Reading) -> dict[str, Column]:
    """channel -> column, of those that a file has; CampaignError in one line."""
    found = {}
    for channel in SI:
        number = _number(path, channel, cells, reading)
        if number is not None:
            found[channel] = _column(path, channel, number, cells[number], reading)
    for channel in ("t", "x"):
        if channel not in found:
            _refuse_missing(path, channel, cells)
    return found


def has_times(cells: Sequence[str], reading: Reading) -> bool:
    """Whether a line of text is a header: it names the times."""
    return bool(_places("t", cells, reading))


def unused(cells: Sequence[str], found: Mapping[str, Column]) -> tuple[str, ...]:
    """Cells of columns that are no channel's."""
    used = {column.number for column in found.values()}
    return tuple(cell for number, cell in enumerate(cells) if cell and number not in used)


def _places(channel: str, cells: Sequence[str], reading: Reading) -> list[int]:
    if channel in reading.columns:
        wanted = reading.columns[channel].strip()
        whole = [number for number, cell in enumerate(cells) if cell == wanted]
        names = [header_parts(cell)[0].lower() for cell in cells]
        return whole or [number for number, name in enumerate(names) if name == wanted.lower()]
    taken = {name.strip().lower() for name in reading.columns.values()}
    return [
        number
        for number, cell in enumerate(cells)
        if ALIASES.get(header_parts(cell)[0].lower(), header_parts(cell)[0].lower()) == channel
        and not {cell.lower(), header_parts(cell)[0].lower()} & taken
    ]


def _number(path: Path, channel: str, cells: Sequence[str], reading: Reading) -> int | None:
    places = _places(channel, cells, reading)
    name = reading.columns.get(channel)
    if len(places) > 1:
        raise CampaignError(f"{path}: column {name or channel}: there twice, allowed is once")
    if name and not places:
        there = [cell for cell in cells if cell]
        near = nearest(name, there)
        hint = f" (nearest: {near})" if near else ""
        raise CampaignError(
            f"{path}: columns.{channel}: {name} is no column of this file, allowed is one of "
            f"{', '.join(there)}{hint}"
        )
    return places[0] if places else None


def _column(path: Path, channel: str, number: int, cell: str, reading: Reading) -> Column:
    """With its unit: what the header says, what campaign.toml says, or SI."""
    stated, said = header_parts(cell)[1], reading.units.get(channel, "")
    if not (stated or said):
        _refuse_unit_in_name(path, channel, cell)
        return Column(number, SI[channel])
    try:
        by_header = to_si(channel, stated) if stated else None
    except ValueError as fault:
        if not said:
            raise CampaignError(f"{path}: column {channel}: unit {fault}") from None
        by_header = None  # a bracket that holds no unit: campaign.toml says which it is
    by_campaign = to_si(channel, said) if said else by_header
    assert by_campaign is not None
    if by_header is not None and by_header != by_campaign:
        raise CampaignError(
            f"{path}: units.{channel}: {said}, but its header says {cell}; allowed is the same "
            "unit, or a header without one"
        )
    unit = said or stated
    return Column(number, unit, by_campaign, "campaign.toml" if said else "its header")


def _refuse_unit_in_name(path: Path, channel: str, cell: str) -> None:
    """A name that ends in a unit other than SI's is no word on it: which it is has to be said."""
    unit = unit_in_name(channel, cell)
    if unit and to_si(channel, unit) != IDENTITY:
        raise CampaignError(
            f"{path}: column {channel}: the name {cell} ends in {unit}, and no unit is stated; "
            f'allowed is [units] {channel} = "{unit}" in campaign.toml, or "{SI[channel]}" where '
            "it is that"
        )


def _refuse_missing(path: Path, channel: str, cells: Sequence[str]) -> None:
    meant = named_with_unit(channel, cells)
    if meant:
        raise CampaignError(
            f"{path}: column {channel}: missing (there: {', '.join(cells)}); is {meant[0]} meant? "
            f'allowed is [columns] {channel} = "{meant[0]}" with [units] {channel} = "{meant[1]}" '
            "in campaign.toml, or a header "
            f"{channel} [{meant[1]}]"
        )
    names = [header_parts(cell)[0].lower() for cell in cells]
    near = nearest(channel, [name for name in names if name and name not in SI])
    hint = f"; is {near} meant?" if near else ""
    raise CampaignError(
        f"{path}: column {channel}: missing (there: {', '.join(cells)}), allowed is "
        f"t,x[,y][,phi][,force]{hint} or the name of its column as columns.{channel} in "
        "campaign.toml"
    )
