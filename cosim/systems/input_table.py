"""Inputs of a unit over time, from a CSV file: a column `time` (s) and one for each input."""

from __future__ import annotations

import csv
import math
from pathlib import Path

import numpy as np

from cosim.coupling import Curve
from cosim.systems.system_errors import SystemFault

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
