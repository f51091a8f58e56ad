"""A tracker's CSV file as numbers: separators, decimal commas, comments and marks as they come."""

from __future__ import annotations

import io
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from cosim.gap.data.errors import CampaignError

from .columns import Reading, find_columns, places_of
from .unit_names import SI, is_unit

#: A first line by which a spreadsheet says what separates its columns.
SEPARATOR = re.compile(r'^"?sep=."?\s*$')
NUMERIC = re.compile(r"(?:[-+\d.eE;,\s]|nan|NaN)+")
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
    header, rows = _split_header(path, _lines(path), reading)
    separator = _separator(header)
    cells = _fields(header, separator)
    found = find_columns(path, cells, reading)
    table = _parse(path, rows, separator, len(cells))
    lines = np.array([number for number, _ in rows])
    values = {
        channel: column.to_si * _numbers(path, channel, table[column.number], lines)
        for channel, column in found.items()
    }
    used = {column.number for column in found.values()}
    unused = tuple(cell for number, cell in enumerate(cells) if cell and number not in used)
    converted = tuple(
        f"{channel} from {column.unit} to {SI[channel]} ({column.by})"
        for channel, column in found.items()
        if column.to_si != 1.0
    )
    return Columns(values, lines, unused, converted)


def _lines(path: Path) -> list[tuple[int, str]]:
    """Numbered lines that are not blank."""
    if not path.exists():
        raise CampaignError(f"{path}: no such file, allowed is a CSV file beside campaign.toml")
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise CampaignError(f"{path}: cannot be read: {error.strerror}") from None
    if raw[:2] in (b"\xff\xfe", b"\xfe\xff") or b"\x00" in raw[:1000]:
        raise CampaignError(f"{path}: is not text in UTF-8 (UTF-16 or binary?), allowed is UTF-8")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:  # what Windows writes for µm or ° in a header
        text = raw.decode("cp1252", errors="replace")
    numbered = [(i, line) for i, line in enumerate(text.splitlines(), 1) if line.strip()]
    return numbered[1:] if numbered and SEPARATOR.match(numbered[0][1]) else numbered


def _split_header(
    path: Path, lines: list[tuple[int, str]], reading: Reading
) -> tuple[str, list[tuple[int, str]]]:
    """Header row and data rows; a header may itself be a comment, as numpy writes it."""
    rows = [(number, line) for number, line in lines if not line.lstrip().startswith("#")]
    if not rows:
        raise CampaignError(f"{path}: no data, allowed is a header row t,x[,y][,phi] and numbers")
    if not NUMERIC.fullmatch(rows[0][1]):
        return rows[0][1], rows[1:]
    comments = [line.lstrip().lstrip("#") for number, line in lines if number < rows[0][0]]
    if comments and places_of("t", _fields(comments[-1], _separator(comments[-1])), reading):
        return comments[-1], rows
    raise CampaignError(
        f"{path}: line {rows[0][0]} holds numbers where the header row is expected, allowed is a "
        "first row t,x[,y][,phi][,force]"
    )


def _separator(header: str) -> str:
    return next((mark for mark in (";", "\t", ",") if mark in header), r"\s+")


def _fields(line: str, separator: str) -> list[str]:
    line = line.strip() if separator == r"\s+" else line.rstrip("\r\n")
    return [field.strip().strip("\"'") for field in re.split(separator, line)]


def _parse(path: Path, rows: list[tuple[int, str]], separator: str, width: int) -> pd.DataFrame:
    if not rows:
        raise CampaignError(f"{path}: a header row without numbers, allowed is at least one row")
    text = [line.strip() if separator == r"\s+" else line for _, line in rows]
    is_comma = "," in (whole := "".join(text)) and "." not in whole
    if separator == "," and is_comma and all(row.count(",") >= 2 * width - 1 for row in text):
        raise CampaignError(
            f"{path}: twice as many fields as columns: decimal commas between commas? allowed is "
            "a decimal point, or decimal commas with semicolons between the columns"
        )
    longest = max(range(len(text)), key=lambda row: text[row].count(separator))
    fields = _fields(text[longest], separator)
    if len(fields) < width or any(fields[width:]):
        many = f"has {len(fields)} fields, the header has {width}; allowed is the same number"
        raise CampaignError(f"{path}: line {rows[longest][0]} {many}")
    return pd.read_csv(
        io.StringIO("\n".join(text)), sep=separator, header=None, names=range(width),
        decimal="," if is_comma and separator != "," else ".", usecols=range(width),
        index_col=False, skipinitialspace=True, na_values=MISSING, skip_blank_lines=False,
    )  # fmt: skip


def _numbers(path: Path, name: str, column: pd.Series, lines: np.ndarray) -> np.ndarray:
    values = pd.to_numeric(column, errors="coerce").to_numpy(dtype=float)
    strange = np.flatnonzero(np.isnan(values) & column.notna().to_numpy())
    if not strange.size:
        return np.where(np.isfinite(values), values, np.nan)
    text = str(column.iloc[strange[0]])
    where = f'{path}: line {lines[strange[0]]}: {name} = "{text[:40]}" is'
    if strange[0] == 0 and is_unit(text):  # a second header row
        unit = text.strip().strip("[]()").strip()
        raise CampaignError(
            f"{where} a unit, not a number; allowed is no row of units: in the header as "
            f'{name} [{unit}], or [units] {name} = "{unit}" in campaign.toml'
        )
    raise CampaignError(f"{where} not a number, allowed is one, or nothing for a missing sample")
