"""Inputs of a unit over time, from a CSV file: a column `time` (s) and one for each input."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator
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
    try:
        if not path.is_file():
            raise SystemFault(f"{place}: {path}: no such file, allowed is a CSV file")
        if path.stat().st_size > MOST_BYTES:
            raise SystemFault(f"{place}: {path}: is larger than {MOST_BYTES >> 20} MiB, allowed")
        with path.open(encoding="utf-8-sig", newline="") as file:
            rows = list(_rows(csv.reader(file), f"{place}: {path}"))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise SystemFault(f"{place}: {path}: cannot be read as CSV ({error})") from None
    header, numbers = rows[0][1], rows[1:]
    times = np.array([float(row[0]) for _, row in numbers])
    falls = np.flatnonzero(np.diff(times) < 0.0)
    if falls.size:
        line = numbers[int(falls[0]) + 1][0]
        raise SystemFault(
            f"{place}: {path}: line {line}: the time goes back to {times[falls[0] + 1]:g} s, "
            "allowed are times that do not fall"
        )
    return {
        name: Curve(times, np.array([float(row[column]) for _, row in numbers]))
        for column, name in enumerate(header)
        if column > 0
    }


def _rows(lines: Iterator[list[str]], place: str) -> Iterator[tuple[int, list[str]]]:
    """Number of the line, and its cells: the header, then rows of numbers, one at least."""
    header: list[str] = []
    count = 0
    for number, cells in enumerate(lines, 1):
        row = [cell.strip() for cell in cells]
        if not any(row):
            continue
        if not header:
            header = row
            if header[0] != TIME or len(header) < 2 or len({*header}) < len(header):
                raise SystemFault(
                    f"{place}: line {number}: its columns are {', '.join(header)}; allowed are "
                    f"{TIME} and then inputs, each once"
                )
        else:
            _check(row, header, f"{place}: line {number}")
            count += 1
        yield number, row
    if count == 0:
        raise SystemFault(f"{place}: has no rows, needed is a header and a row of numbers")


def _check(row: list[str], header: list[str], place: str) -> None:
    if len(row) != len(header):
        raise SystemFault(f"{place}: has {len(row)} cells, the header has {len(header)}")
    for name, cell in zip(header, row, strict=True):
        try:
            is_finite = math.isfinite(float(cell))
        except ValueError:
            is_finite = False
        if not is_finite:
            raise SystemFault(f"{place}: {name} = {cell!r}, allowed is a finite number")
