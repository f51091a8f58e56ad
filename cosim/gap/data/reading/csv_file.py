"""A tracker's CSV file as numbers: separators, decimal commas, comments and marks as they come."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from cosim.gap.data.errors import CampaignError

from .columns import Column, Reading, find_columns, has_times, unused
from .unit_names import SI, is_unit

#: A first line by which a spreadsheet says what separates its columns.
SEPARATOR = re.compile(r'^"?sep=."?\s*$')
#: What trackers write where they lost the mark.
MISSING = ("", "-", "--", "nan", "NaN", "NAN", "NA", "N/A", "n/a", "null", "None", "inf", "-inf")


@dataclass(frozen=True)
class Columns:
    """Numbers of a file in SI units: channel -> (n,) array, `t` among them.

    ``lines`` are theirs in the file, ``ignored`` columns that nothing is known of, ``converted``
    what was in another unit, "x from mm (its header)".
    """

    values: dict[str, np.ndarray]
    lines: np.ndarray
    ignored: tuple[str, ...]
    converted: tuple[str, ...] = ()


def read_columns(path: Path, reading: Reading | None = None) -> Columns:
    """Columns t, x [, y] [, phi] [, force] of a file in SI units; CampaignError in one line.

    reading : names and units of columns, where they are not those of the header
    """
    reading = reading or Reading()
    lines = _lines(path)
    header, rows = _split_header(path, lines, reading)
    separator = _separator(header)
    cells = _fields(header, separator)
    found = find_columns(path, cells, reading)
    decimal = _decimal(path, separator, len(cells), [text for _, text in rows])
    table = _parse(path, rows, separator, decimal, len(cells))
    numbers = np.array([number for number, _ in rows])
    values = {
        channel: _in_si(column, _numbers(path, channel, table[column.number], numbers))
        for channel, column in found.items()
    }
    return Columns(values, numbers, unused(cells, found), _converted(found))


def _in_si(column: Column, values: np.ndarray) -> np.ndarray:
    if column.to_si.is_identity:
        return values
    return column.to_si.factor * values + column.to_si.offset


def _converted(found: Mapping[str, Column]) -> tuple[str, ...]:
    return tuple(
        f"{channel} from {column.unit} to {SI[channel]} ({column.by})"
        for channel, column in found.items()
        if not column.to_si.is_identity
    )


def _lines(path: Path) -> list[tuple[int, str]]:
    """Numbered lines that are not blank."""
    try:
        raw = path.read_bytes()
    except FileNotFoundError:
        raise CampaignError(
            f"{path}: no such file, allowed is a CSV file beside campaign.toml"
        ) from None
    except OSError as error:
        raise CampaignError(f"{path}: cannot be read: {error.strerror}") from None
    if raw[:2] in (b"\xff\xfe", b"\xfe\xff") or b"\x00" in raw[:1000]:
        raise CampaignError(f"{path}: is not text in UTF-8 (UTF-16 or binary?), allowed is UTF-8")
    numbered = enumerate(_decoded(raw).splitlines(), 1)
    return [
        (i, line) for i, line in numbered if line.strip() and not (i == 1 and SEPARATOR.match(line))
    ]


def _decoded(raw: bytes) -> str:
    """UTF-8, or what Windows writes: there a unit in the header, µm or °, is no UTF-8."""
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError:
        return raw.decode("cp1252", errors="replace")


def _split_header(
    path: Path, lines: list[tuple[int, str]], reading: Reading
) -> tuple[str, list[tuple[int, str]]]:
    """Header row and data rows; a header may itself be a comment, as numpy writes it."""
    rows = [(number, line) for number, line in lines if not line.lstrip().startswith("#")]
    if not rows:
        raise CampaignError(f"{path}: no data, allowed is a header row t,x[,y][,phi] and numbers")
    if not _is_numeric(rows[0][1]):
        return rows[0][1], rows[1:]
    comments = [line.lstrip().lstrip("#") for number, line in lines if number < rows[0][0]]
    if comments and has_times(_fields(comments[-1], _separator(comments[-1])), reading):
        return comments[-1], rows
    raise CampaignError(
        f"{path}: line {rows[0][0]} holds numbers where the header row is expected, allowed is a "
        "first row t,x[,y][,phi][,force]"
    )


def _is_numeric(line: str) -> bool:
    fields = [field for field in re.split(r"[;,\s]+", line) if field]
    return all(re.fullmatch(r"[-+\d.eE]+|nan|NaN", field) for field in fields)


def _separator(header: str) -> str:
    return next((mark for mark in (";", "\t", ",") if mark in header), r"\s+")


def _fields(line: str, separator: str) -> list[str]:
    line = line.strip() if separator == r"\s+" else line.rstrip("\r\n")
    return [field.strip().strip("\"'") for field in re.split(separator, line)]


def _decimal(path: Path, separator: str, width: int, rows: list[str]) -> str:
    """The decimal mark; a comma that also separates columns cannot be told and is refused."""
    if separator != ",":
        text = "".join(rows)
        return "," if "," in text and "." not in text else "."
    if rows and all(len(row.split(",")) >= 2 * width for row in rows) and "." not in "".join(rows):
        raise CampaignError(
            f"{path}: twice as many fields as columns: decimal commas between commas? allowed is "
            "a decimal point, or decimal commas with semicolons between the columns"
        )
    return "."


def _parse(
    path: Path, rows: list[tuple[int, str]], separator: str, decimal: str, width: int
) -> pd.DataFrame:
    if not rows:
        raise CampaignError(f"{path}: a header row without numbers, allowed is at least one row")
    text = [line.strip() if separator == r"\s+" else line for _, line in rows]
    longest = max(range(len(text)), key=lambda row: text[row].count(separator))
    fields = _fields(text[longest], separator)
    if len(fields) < width or any(fields[width:]):
        raise CampaignError(
            f"{path}: line {rows[longest][0]} has {len(fields)} fields, the header has {width}; "
            "allowed is the same number"
        )
    return pd.read_csv(
        io.StringIO("\n".join(text)), sep=separator, decimal=decimal, header=None,
        names=range(width), usecols=range(width), index_col=False, skipinitialspace=True,
        na_values=MISSING, skip_blank_lines=False,
    )  # fmt: skip


def _numbers(path: Path, name: str, column: pd.Series, lines: np.ndarray) -> np.ndarray:
    values = pd.to_numeric(column, errors="coerce").to_numpy(dtype=float)
    strange = np.flatnonzero(np.isnan(values) & column.notna().to_numpy())
    if strange.size:
        row = strange[0]
        _refuse_units(path, name, str(column.iloc[row]), row, lines)
        raise CampaignError(
            f'{path}: line {lines[row]}: {name} = "{str(column.iloc[row])[:40]}" is not a number, '
            "allowed is a number, or nothing for a missing sample"
        )
    return np.where(np.isfinite(values), values, np.nan)


def _refuse_units(path: Path, name: str, text: str, row: int, lines: np.ndarray) -> None:
    """A second header row of units is told from a sample that is no number."""
    if row > 0 or not is_unit(text):
        return
    unit = text.strip().strip("[]()").strip()
    raise CampaignError(
        f'{path}: line {lines[row]}: {name} = "{text[:40]}" is a unit, not a number; allowed is no '
        f'row of units: in the header as {name} [{unit}], or [units] {name} = "{unit}" in '
        "campaign.toml"
    )
