"""A system as a TOML file: [units.NAME], [[connections]], [coupling], [run]."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import Field, create_model
from stickslip.quantity import Table, quantity

from cosim.coupling import Affine
from cosim.names import nearest_key, unknown_name
from cosim.scenario.toml_file import parsed, text_of
from cosim.scenario.validation import ScenarioError
from cosim.systems.input_table import read_input_table
from cosim.systems.settings import NOT_GIVEN, Coupling, Run
from cosim.systems.specification import Hop, Link, Start, SystemSpecification, UnitEntry, Value
from cosim.systems.system_errors import SystemFault, table_of

#: A name of a participant: part of `unit.port`, of the columns of a table and of file names.
NAME = re.compile(r"[^\s.\"'/\\\x00-\x1f][^.\"'/\\\x00-\x1f]*")
TABLES = ("name", "units", "connections", "residuals", "coupling", "run")
#: Tables of values in a unit.
VALUES = ("parameters", "inputs")
#: Whole numbers beyond this are no number of a unit.
LARGEST = 2**1000
#: Of a unit in one macro step, which Ctrl-C waits for.
MOST_SUBSTEPS = 1_000_000


class Unit(Table):
    """A unit of the system, without the values that it starts from."""

    file: str = Field(description="the FMU, from where the file of the system is", min_length=1)
    isolate: bool = Field(False, description="in a process of its own, which may crash or hang")
    time_limit: float = quantity(NOT_GIVEN, "s", "of a call of an isolated unit", gt=0)
    input_file: str = Field(
        "", description="CSV of inputs over time: a column time (s), and one for each input"
    )
    substeps: int = quantity(1, "1", "steps of its own in each macro step", ge=1, le=MOST_SUBSTEPS)
    tolerance: float = quantity(NOT_GIVEN, "1", "told to the unit", gt=0, lt=1)


#: `from` is a word of Python, and a field's name here all the same.
_ENDS: dict[str, Any] = {
    "from": (str, Field(description="unit.port, an output")),
    "to": (str, Field(description="unit.port, an input")),
    "taken": (str, Field("", description="output in J: how much of the energy was taken up")),
    "factor": (float, quantity(1.0, "1", "of the value in the unit of the input")),
    "offset": (float, quantity(0.0, "1", "added then, in the unit of the input")),
    "convert": (bool, Field(True, description="compare the units, and convert the value")),
}
ConnectionTable = create_model(
    "ConnectionTable", __base__=Table, __doc__="What feeds an input.", **_ENDS
)


def read_toml(path: Path, changes: Mapping[str, Any]) -> SystemSpecification:
    """The system in a TOML file; changes: `table.key` -> value, in place of what it has.

    Raises SystemFault in one line: file, key, what is wrong, what is allowed.
    """
    try:
        text = text_of(path)
        tables = parsed(text, path)
    except ScenarioError as fault:
        raise SystemFault(str(fault)) from None
    try:
        return _specified(path, text, _changed(tables, changes))
    except (ScenarioError, SystemFault) as fault:
        raise SystemFault(f"{path}: {fault}") from None


def _changed(tables: dict[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    for key, value in changes.items():
        table, _, entry = key.partition(".")
        place = tables.setdefault(table, {})
        if table not in ("coupling", "run") or not isinstance(place, dict):
            raise SystemFault(f"{key}: cannot be set here, allowed are keys of coupling and run")
        place[entry] = value
    return tables


def _specified(path: Path, text: str, tables: Mapping[str, Any]) -> SystemSpecification:
    for key in tables:
        if key not in TABLES:
            near = nearest_key(key, TABLES)
            known = f"nearest known: {near}" if near else f"known: {', '.join(TABLES)}"
            raise SystemFault(f"{key}: no such key, {known}")
    units = _units(tables.get("units"), path.parent)
    return SystemSpecification(
        name=_name(tables.get("name", path.stem)),
        source=str(path),
        units=units,
        links=_links(tables.get("connections", []), [unit.name for unit in units]),
        coupling=table_of(Coupling, tables.get("coupling", {}), "coupling"),
        run=table_of(Run, tables.get("run", {}), "run"),
        residuals=_residuals(tables.get("residuals", [])),
        text=text,
    )


def _name(name: Any) -> str:
    if not isinstance(name, str) or not name.strip() or len(name) > 100 or not name.isprintable():
        raise SystemFault(
            f"name: not possible ({name!r}), allowed is a text of 1 to 100 characters"
        )
    return name


def _units(entries: Any, folder: Path) -> list[UnitEntry]:
    if not isinstance(entries, Mapping) or not entries:
        raise SystemFault("units: missing, needed is a table [units.NAME] for every unit")
    return [_unit(name, entry, folder) for name, entry in entries.items()]


def _unit(name: str, entry: Any, folder: Path) -> UnitEntry:
    place = f"units.{name}"
    if not NAME.fullmatch(name):
        raise SystemFault(
            f"{place}: not a name, allowed is a text without dots, quotes and slashes"
        )
    if not isinstance(entry, Mapping):
        raise SystemFault(f"{place}: not a table, allowed is a table [{place}]")
    own = {key: value for key, value in entry.items() if key not in VALUES}
    if "file" not in own:
        raise SystemFault(f"{place}.file: missing, needed is the path of an FMU")
    unit = table_of(Unit, own, place)
    if not unit.isolate and "time_limit" in own:
        raise SystemFault(
            f"{place}.time_limit: is for a unit with isolate = true, allowed is to leave it out"
        )
    given: dict[str, Start] = {}
    for values in VALUES:
        given |= _values(entry.get(values, {}), f"{place}.{values}")
    table = folder / unit.input_file if unit.input_file else None
    return UnitEntry(
        name=name,
        file=folder / unit.file,
        isolate=unit.isolate,
        time_limit=unit.time_limit,
        substeps=unit.substeps,
        tolerance=None if unit.tolerance == NOT_GIVEN else unit.tolerance,
        given=given,
        input_file=table,
        driven=read_input_table(table, f"{place}.input_file") if table else {},
    )


def _values(entries: Any, place: str) -> dict[str, Start]:
    """Variable -> what it starts from; `spring.k = 1` and `"spring.k" = 1` are the same."""
    if not isinstance(entries, Mapping):
        raise SystemFault(f"{place}: not a table, allowed is a table of values")
    found: dict[str, Start] = {}
    for key, value in entries.items():
        if isinstance(value, Mapping):
            inner = _values(value, f"{place}.{key}")
            found |= {f"{key}.{name}": start for name, start in inner.items()}
        elif isinstance(value, (bool, int, float, str)) and _is_finite(value):
            found[key] = Start(value)
        else:
            raise SystemFault(
                f"{place}.{key}: not possible ({value}), allowed is a finite number, true, false or"
                " a text"
            )
    return found


def _is_finite(value: Value) -> bool:
    if isinstance(value, int):
        return abs(value) <= LARGEST
    return not isinstance(value, float) or math.isfinite(value)


def _links(entries: Any, units: list[str]) -> list[Link]:
    if not isinstance(entries, list):
        raise SystemFault("connections: not a list of tables, allowed is [[connections]]")
    found = []
    for number, entry in enumerate(entries, 1):
        place = f"connections[{number}]"
        for key in ("from", "to"):
            if isinstance(entry, Mapping) and key not in entry:
                raise SystemFault(f"{place}.{key}: missing, needed is a text as unit.port")
        table = table_of(ConnectionTable, entry, place).model_dump()
        ends = {key: table[key] for key in ("from", "to")}
        for key, end in ends.items():
            _check_end(f"{place}.{key}", end, units)
        transformation = Affine(table["factor"], table["offset"])
        if transformation.factor == 0.0:
            raise SystemFault(f"{place}.factor: 0 would carry nothing, allowed is another number")
        hop = Hop(transformation, table["convert"])
        taken = table["taken"] or None
        found.append(Link(ends["from"], ends["to"], (hop,), taken, place))
    return found


def _check_end(key: str, end: str, units: list[str]) -> None:
    unit, dot, port = end.partition(".")
    if not (unit and dot and port):
        raise SystemFault(f'{key}: not a port ("{end}"), allowed is a text as unit.port')
    if unit not in units:
        raise SystemFault(f"{key}: {unknown_name('unit', unit, units)}")


def _residuals(entries: Any) -> list[str]:
    if not isinstance(entries, list) or not all(isinstance(entry, str) for entry in entries):
        raise SystemFault("residuals: not possible, allowed is a list of texts as unit.port")
    return entries
