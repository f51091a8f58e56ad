"""A system as a TOML file: [units.NAME], [[connections]], [coupling], [run].

Inputs of a unit over time come from a CSV file: a column `time` (s) and one for each input.
"""

import csv
import math
import re
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import Field, create_model, field_validator
from stickslip.quantity import Table, quantity

from cosim.coupling import Affine, Curve
from cosim.names import unknown_name
from cosim.scenario.toml_file import changed_tables, parsed, text_of
from cosim.scenario.validation import checked
from cosim.systems.specification import (
    NOT_GIVEN,
    Coupling,
    Hop,
    Link,
    Run,
    Start,
    SystemFault,
    SystemSpecification,
    UnitEntry,
    naming,
)

#: Bytes; more is no table that somebody has made for a drive.
MOST_BYTES = 64 << 20
TIME = "time"


def read_input_table(path: Path, place: str) -> dict[str, Curve]:
    """Input -> its curve. place: key of the file in the system's.

    Raises SystemFault in one line: key, file, line, what is wrong, what is allowed.
    """
    where = f"{place}: {path}"
    try:
        if not path.is_file():
            raise SystemFault(f"{where}: no such file, allowed is a CSV file")
        if path.stat().st_size > MOST_BYTES:
            raise SystemFault(f"{where}: is larger than {MOST_BYTES >> 20} MiB, allowed")
        with path.open(encoding="utf-8-sig", newline="") as file:
            cells = [[cell.strip() for cell in row] for row in csv.reader(file)]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise SystemFault(f"{where}: cannot be read as CSV ({error})") from None
    rows = {f"{where}: line {line}": row for line, row in enumerate(cells, 1) if any(row)}
    header = next(iter(rows.values()), [])
    if header and (header[0] != TIME or len(header) < 2 or len({*header}) < len(header)):
        raise SystemFault(
            f"{next(iter(rows))}: its columns are {', '.join(header)}; allowed are {TIME} and then "
            "inputs, each once"
        )
    if len(rows) < 2:
        raise SystemFault(f"{where}: has no rows, needed is a header and a row of numbers")
    lines = [*rows][1:]
    times, *columns = np.array([_numbers(rows[line], header, line) for line in lines]).T
    for fall in np.flatnonzero(np.diff(times) < 0.0) + 1:
        raise SystemFault(
            f"{lines[fall]}: the time goes back to {times[fall]:g} s, allowed are times that do "
            "not fall"
        )
    return dict(zip(header[1:], (Curve(times, values) for values in columns), strict=True))


def _numbers(row: list[str], header: list[str], line: str) -> list[float]:
    if len(row) != len(header):
        raise SystemFault(f"{line}: has {len(row)} cells, the header has {len(header)}")
    found = []
    for name, cell in zip(header, row, strict=True):
        try:
            found.append(float(cell))
        except ValueError:
            found.append(math.nan)
        if not math.isfinite(found[-1]):
            raise SystemFault(f"{line}: {name} = {cell!r}, allowed is a finite number")
    return found


#: A name of a participant: part of `unit.port`, of the columns of a table and of file names.
NAME = re.compile(r"[^\s.\"'/\\\x00-\x1f][^.\"'/\\\x00-\x1f]*")
#: Whole numbers beyond this are no number of a unit.
LARGEST = 2**1000
#: Of a unit in one macro step, which Ctrl-C waits for.
MOST_SUBSTEPS = 1_000_000


class Unit(Table):
    """A unit of the system.

    isolate : in a process of its own, which may crash or hang
    time_limit : of a call of an isolated unit
    input_file : CSV of inputs over time: a column time (s), and one for each input
    substeps : steps of its own in each macro step
    tolerance : told to the unit
    parameters : variable of the unit -> value
    inputs : variable of the unit -> value
    """

    file: str = Field(description="the FMU, from where the file of the system is", min_length=1)
    isolate: bool = quantity(False, None)
    time_limit: float = quantity(NOT_GIVEN, "s", gt=0)
    input_file: str = quantity("", None)
    substeps: int = quantity(1, "1", ge=1, le=MOST_SUBSTEPS)
    tolerance: float = quantity(NOT_GIVEN, "1", gt=0, lt=1)
    parameters: dict[str, Any] = quantity({}, None)
    inputs: dict[str, Any] = quantity({}, None)


#: `from` is a word of Python, and a field's name here all the same.
_ENDS: dict[str, Any] = {
    "from": (str, Field(description="unit.port, an output")),
    "to": (str, Field(description="unit.port, an input")),
    "taken": (str, Field("", description="output in J: how much of the energy was taken up")),
    "factor": (float, quantity(1.0, "1", "of the value in the unit of the input")),
    "offset": (float, quantity(0.0, "1", "added then, in the unit of the input")),
    "convert": (bool, Field(True, description="compare the units, and convert the value")),
}
ConnectionTable: Any = create_model(
    "ConnectionTable", __base__=Table, __doc__="What feeds an input.", **_ENDS
)


class System(Table):
    """All that the file may say.

    name : of the system
    residuals : unit.port that should stay 0
    """

    name: str = quantity("", None, max_length=100)
    units: dict[str, Unit] = Field(description="a table [units.NAME] for every unit", min_length=1)
    connections: tuple[ConnectionTable, ...] = ()
    residuals: tuple[str, ...] = quantity((), None)
    coupling: Coupling = Coupling()
    run: Run = Run()

    @field_validator("name")
    @classmethod
    def _can_be_read(cls, name: str) -> str:
        if not name.strip() or not name.isprintable():
            raise ValueError(f"not possible ({name!r}), allowed is a text of 1 to 100 characters")
        return name


def read_toml(path: Path, changes: Mapping[str, Any]) -> SystemSpecification:
    """The system in a TOML file; changes: `table.key` -> value, in place of what it has.

    Raises SystemFault in one line: file, key, what is wrong, what is allowed.
    """
    with naming(str(path)):
        text = text_of(path)
        tables = changed_tables(parsed(text, path), changes)
        found = checked(System, {"name": path.stem, **tables})
        return SystemSpecification(
            name=found.name,
            source=str(path),
            units=[_unit(name, unit, path.parent) for name, unit in found.units.items()],
            links=[
                _link(f"connections[{number}]", each.model_dump(), found.units)
                for number, each in enumerate(found.connections, 1)
            ],
            coupling=found.coupling,
            run=found.run,
            residuals=found.residuals,
            text=text,
        )


def _unit(name: str, unit: Unit, folder: Path) -> UnitEntry:
    place = f"units.{name}"
    if not NAME.fullmatch(name):
        raise SystemFault(
            f"{place}: not a name, allowed is a text without dots, quotes and slashes"
        )
    if not unit.isolate and "time_limit" in unit.model_fields_set:
        raise SystemFault(
            f"{place}.time_limit: is for a unit with isolate = true, allowed is to leave it out"
        )
    table = folder / unit.input_file if unit.input_file else None
    return UnitEntry(
        name=name,
        file=folder / unit.file,
        isolate=unit.isolate,
        time_limit=unit.time_limit,
        substeps=unit.substeps,
        tolerance=None if unit.tolerance == NOT_GIVEN else unit.tolerance,
        given=_values(unit.parameters, f"{place}.parameters")
        | _values(unit.inputs, f"{place}.inputs"),
        input_file=table,
        driven=read_input_table(table, f"{place}.input_file") if table else {},
    )


def _values(entries: Mapping[str, Any], place: str) -> dict[str, Start]:
    """Variable -> what it starts from; `spring.k = 1` and `"spring.k" = 1` are the same."""
    found: dict[str, Start] = {}
    for key, value in entries.items():
        if isinstance(value, Mapping):
            inner = _values(value, f"{place}.{key}")
            found |= {f"{key}.{name}": start for name, start in inner.items()}
        elif (
            isinstance(value, str)
            or (isinstance(value, int) and abs(value) <= LARGEST)
            or (isinstance(value, float) and math.isfinite(value))
        ):
            found[key] = Start(value)
        else:
            raise SystemFault(
                f"{place}.{key}: not possible ({value}), allowed is a finite number, true, false or"
                " a text"
            )
    return found


def _link(place: str, table: Mapping[str, Any], units: Collection[str]) -> Link:
    for key in ("from", "to"):
        unit, _, port = table[key].partition(".")
        if not (unit and port):
            raise SystemFault(
                f'{place}.{key}: not a port ("{table[key]}"), allowed is a text as unit.port'
            )
        if unit not in units:
            raise SystemFault(f"{place}.{key}: {unknown_name('unit', unit, units)}")
    transformation = Affine(table["factor"], table["offset"])
    if transformation.factor == 0.0:
        raise SystemFault(f"{place}.factor: 0 would carry nothing, allowed is another number")
    hop = Hop(transformation, table["convert"])
    return Link(table["from"], table["to"], (hop,), table["taken"] or None, place)
