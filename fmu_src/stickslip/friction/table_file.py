"""A table of friction as a CSV file, and as the numbers that the FMU has of it."""

import csv
import io
import math
import re
from collections.abc import Mapping
from itertools import pairwise, product
from pathlib import Path

from ..kernel.layout import CURVE_LIMIT, TABLE_LIMIT, TEMPERATURE_LIMIT
from ..text_file import read_text

#: Of a file; the rows of a table take a hundredth of it.
MOST_BYTES = 2**20

#: Columns of a file: sliding speed, m/s, and coefficient; and of one over the temperature, too.
COLUMNS = ("v", "mu")
TEMPERATURE = "T_degC"
ABSOLUTE_ZERO = -273.15  # degC
#: What each column may be: least, most, and the unit. More is a slip of the unit (mm/s, kelvin).
RANGES = {
    "v": (0.0, 1000.0, "m/s"),
    "mu": (0.0, 100.0, ""),
    TEMPERATURE: (ABSOLUTE_ZERO, 100.0, "degC"),
}
#: Columns that would be the temperature, were they called so; others are comments.
_ALIKE = re.compile(r"t\b.*|t_.*|temp.*", re.IGNORECASE)
#: Speeds, temperatures, and coefficients: at all speeds of the first temperature, and so on.
FrictionTable = tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]


def table_of(values: Mapping[str, float]) -> dict[str, tuple[float, ...]]:
    """The table's keys in a scenario from the FMU's names, `friction.table_speed[1]` and so on.

    Speeds, and temperatures, end before the first place that is not there or does not grow.

    >>> table_of({f"friction.table_{of}[{i}]": 0.1 * i for of in ("speed", "mu") for i in (1, 2)})
    {'table_speed': (0.1, 0.2), 'table_mu': (0.1, 0.2)}
    """
    speed = _grown(values, "friction.table_speed", CURVE_LIMIT)
    if not speed:  # the places of a table that there is not
        return {"table_speed": (), "table_mu": ()}
    temperature = _grown(values, "friction.table_temperature_degC", TEMPERATURE_LIMIT)
    places = range(1, len(speed) * max(1, len(temperature)) + 1)
    mu = tuple(values[f"friction.table_mu[{i}]"] for i in places)
    found = {"table_speed": speed, "table_mu": mu}
    return found | ({"table_temperature_degC": temperature} if temperature else {})


def _grown(values: Mapping[str, float], name: str, limit: int) -> tuple[float, ...]:
    """Growing numbers, at least two, or none."""
    found: list[float] = []
    for i in range(1, limit + 1):
        at = values.get(f"{name}[{i}]")
        if at is None or (found and at <= found[-1]):
            break
        found.append(at)
    return tuple(found) if len(found) > 1 else ()


def read_table(file: Path) -> FrictionTable:
    """Sliding speeds (m/s), temperatures (degC) and coefficients of a CSV file with a header row.

    Without the column T_degC there are no temperatures. With it, there is a row for every speed at
    every temperature, in any order. ValueError in one line for a file that is none, a column that
    is missing, what is no number, a row that is missing or given twice, and more points than a
    table takes, a column given twice, a row with more fields than the header, what is out of range,
    and, without temperatures, speeds that do not grow.
    """
    rows = _rows(file)
    over_temperature = TEMPERATURE in rows[0]
    wanted = (*COLUMNS, *([TEMPERATURE] if over_temperature else []))
    numbers = [
        [_number(file, line, column, row[column]) for column in wanted]
        for line, row in enumerate(rows, 2)
    ]
    if over_temperature:
        return _on_grid(file, numbers)
    if not 2 <= len(rows) <= CURVE_LIMIT:
        raise ValueError(f'table = "{file}": {len(rows)} points, allowed are 2 to {CURVE_LIMIT}')
    speed, mu = zip(*numbers, strict=True)
    for line, (before, now) in enumerate(pairwise(speed), 3):
        if now <= before:
            raise ValueError(
                f'table = "{file}": line {line}: v = {now:g} after {before:g}; allowed is a speed '
                "that grows from row to row"
            )
    return speed, (), mu


def _rows(file: Path) -> list[dict[str, str]]:
    try:
        lines = io.StringIO(read_text(file, MOST_BYTES), newline="")
        reader = csv.DictReader(lines, skipinitialspace=True)
        rows = list(reader)
        _check_columns(file, list(reader.fieldnames or ()))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        why = getattr(error, "strerror", None) or "no CSV in UTF-8"
        raise ValueError(f'table = "{file}": cannot be read: {why}') from None
    if not 2 <= len(rows) <= TABLE_LIMIT:
        limit = TABLE_LIMIT if rows and TEMPERATURE in rows[0] else CURVE_LIMIT
        raise ValueError(f'table = "{file}": {len(rows)} points, allowed are 2 to {limit}')
    for line, row in enumerate(rows, 2):
        if None in row:
            raise ValueError(
                f'table = "{file}": line {line} has more fields than the header; allowed is the '
                "same number, commas between columns and a decimal point in numbers"
            )
    return rows


def _check_columns(file: Path, there: list[str]) -> None:
    """That the header has what is wanted, once, and no temperature by another name."""
    named = f"(there are {', '.join(there)})"
    for column in (*COLUMNS, TEMPERATURE):
        if there.count(column) > 1:
            raise ValueError(f'table = "{file}": column {column} is there twice {named}')
        if column in COLUMNS and there and column not in there:
            raise ValueError(
                f'table = "{file}": no column {column} {named}; allowed is a header row v,mu or '
                f"v,{TEMPERATURE},mu with commas"
            )
    alike = [] if TEMPERATURE in there else [name for name in there if _ALIKE.fullmatch(name)]
    if alike:
        raise ValueError(
            f'table = "{file}": column {alike[0]} is not read {named}; allowed is {TEMPERATURE}, '
            "in degC, or none of the temperature"
        )


def _on_grid(file: Path, numbers: list[list[float]]) -> FrictionTable:
    """Rows of v, mu, T_degC, one for each pair, as a table."""
    found: dict[tuple[float, float], float] = {}
    for line, (v, mu, temperature) in enumerate(numbers, 2):
        if (temperature, v) in found:
            raise ValueError(
                f'table = "{file}": line {line}: v = {v:g} at T_degC = {temperature:g} is there '
                "already; allowed is one mu for each pair"
            )
        found[temperature, v] = mu
    temperatures = tuple(sorted({temperature for temperature, _ in found}))
    speeds = tuple(sorted({v for _, v in found}))
    for what, values, most in (
        ("speeds", speeds, CURVE_LIMIT),
        ("temperatures", temperatures, TEMPERATURE_LIMIT),
    ):
        if not 2 <= len(values) <= most:
            raise ValueError(f'table = "{file}": {len(values)} {what}, allowed are 2 to {most}')
    for temperature, v in product(temperatures, speeds):
        if (temperature, v) not in found:
            raise ValueError(
                f'table = "{file}": no mu at v = {v:g}, T_degC = {temperature:g}; needed is one '
                f"for each of {len(speeds)} speeds at each of {len(temperatures)} temperatures"
            )
    return speeds, temperatures, tuple(found[pair] for pair in product(temperatures, speeds))


def _number(file: Path, line: int, column: str, text: str | None) -> float:
    try:
        value = float(text or "")
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise ValueError(f'table = "{file}": line {line}, {column} = "{text}": not a finite number')
    least, most, unit = RANGES[column]
    if not least <= value <= most:
        raise ValueError(
            f'table = "{file}": line {line}, {column} = {value:g}: allowed is {least:g} to {most:g}'
            + (f" {unit}" if unit else "")
        )
    return value
