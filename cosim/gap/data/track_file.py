"""A tracker's file as a track: times that grow, enough samples, without outliers."""

from __future__ import annotations

import io
import math
import re
from pathlib import Path

import numpy as np
import pandas as pd

from cosim.gap.data.columns import Reading, find_columns, is_unit, named_with_unit, places_of
from cosim.gap.data.errors import CampaignError, within
from cosim.gap.data.measured import CHANNELS, MeasuredRun, Track
from cosim.gap.data.noise import without_outliers
from cosim.gap.data.units import velocity_of

#: A first line by which a spreadsheet says what separates its columns.
SEPARATOR = re.compile(r'^"?sep=."?\s*$')
NUMERIC = re.compile(r"(?:[-+\d.eE;,\s]|nan|NaN)+")
#: What trackers write where they lost the mark.
MISSING = ("", "-", "--", "nan", "NaN", "NAN", "NA", "N/A", "n/a", "null", "None", "inf", "-inf")
#: What is larger is no measurement, and its square no number.
BEYOND = 1e30
#: Fewer samples of x than this hold neither a cycle nor its noise.
FEWEST = 20
#: A record is also looked at on an even grid, as long as it takes: so many places for each of its
#: rows, and so many in all where the rows are few in them.
MOST_EMPTY, MOST_PLACES = 100, 5_000_000
#: Remarks on regimes: the block moves with the surface within this part of its speed; of a record,
#: the part above which, or below which, it always or never does.
WITH_SURFACE, ALWAYS, NEVER = 0.1, 0.9, 0.05


def read_track(file: Path, reading: Reading | None = None) -> tuple[Track, list[str], str]:
    """The track, remarks on it, what was converted; CampaignError in one line."""
    with within(file):
        return _track_of(file, reading or Reading())


def _track_of(file: Path, reading: Reading) -> tuple[Track, list[str], str]:
    header, rows = _split_header(_lines(file), reading)
    separator = separator_of(header)
    cells = fields_of(header, separator)
    found = find_columns(cells, reading)
    table, lines = _parse(rows, separator, len(cells)), np.array([number for number, _ in rows])
    columns = {
        channel: column.to_si * _numbers(channel, table[column.number], lines)
        for channel, column in found.items()
    }
    time = columns.pop("t")
    if fault := _fault_of_times(time, lines):
        raise CampaignError(f"line {fault}")
    used = {column.number for column in found.values()}
    unused = [cell for number, cell in enumerate(cells) if cell and number not in used]
    remarks = [f"{file.name}: {_unused(name)}" for name in unused]
    channels: dict[str, np.ndarray] = {}
    for channel, values in columns.items():
        count = int(np.count_nonzero(np.isfinite(values)))
        if count >= FEWEST:
            channels[channel] = without_outliers(time, values)
        elif channel == "x":
            few = f"{count or 'no'} sample{'s' * (count != 1)}"
            raise CampaignError(f"column x: {few}, allowed are at least {FEWEST}")
        else:
            remarks.append(f"{file.name}: column {channel} has {count} samples and is not used")
    track = Track(time=time - time[0], time_offset=float(time[0]), **channels)
    return track, remarks, "; ".join(filter(None, (one.converted for one in found.values())))


def _unused(name: str) -> str:
    """A column that nobody asked for; of one such as `phi_deg` how it would be."""
    said = f"column {name} is not used"
    for channel in CHANNELS:
        if meant := named_with_unit(channel, [name]):
            column, unit = meant
            tables = f'[columns] {channel} = "{column}", [units] {channel} = "{unit}"'
            return f"{said}; {tables} uses it"
    return said


def _fault_of_times(time: np.ndarray, lines: np.ndarray) -> str:
    """A missing time, one that does not grow, or a record that is next to nothing but a hole."""
    missing, steps = np.flatnonzero(np.isnan(time)), np.diff(time)
    if missing.size:
        return f"{lines[missing[0]]}: t is missing, allowed is a time in every row"
    back = np.flatnonzero(steps <= 0.0)
    if back.size:
        row = back[0] + 1
        again = "repeats" if time[row] == time[row - 1] else "falls back from"
        return (
            f"{lines[row]}: t = {time[row]:.12g} s {again} {time[row - 1]:.12g} s, allowed is a "
            f"time that grows from row to row ({back.size} such row{'s' * (back.size > 1)})"
        )
    interval = float(np.median(steps)) if time.size >= FEWEST else math.inf
    most = min(MOST_EMPTY * time.size, max(MOST_PLACES, 2 * time.size))
    if (time[-1] - time[0]) / interval <= most:
        return ""
    row = int(np.argmax(steps)) + 1
    return (
        f"{lines[row]}: t = {time[row]:.12g} s comes {steps[row - 1]:.4g} s after the row before, "
        f"in a record of {time.size} rows that are {interval:.4g} s apart; allowed are holes up "
        f"to {MOST_EMPTY} times as long as what was recorded: check the times, or give each part "
        "its own file and [[run]]"
    )


def _lines(path: Path) -> list[tuple[int, str]]:
    """Numbered lines that are not blank."""
    if not path.exists():
        raise CampaignError("no such file, allowed is a CSV file beside campaign.toml")
    try:
        raw = path.read_bytes()
    except OSError as error:
        raise CampaignError(f"cannot be read: {error.strerror}") from None
    if raw[:2] in (b"\xff\xfe", b"\xfe\xff") or b"\x00" in raw[:1000]:
        raise CampaignError("is not text in UTF-8 (UTF-16 or binary?), allowed is UTF-8")
    try:
        text = raw.decode("utf-8-sig")
    except UnicodeDecodeError:  # what Windows writes for µm or ° in a header
        text = raw.decode("cp1252", errors="replace")
    numbered = [(i, line) for i, line in enumerate(text.splitlines(), 1) if line.strip()]
    return numbered[1:] if numbered and SEPARATOR.match(numbered[0][1]) else numbered


def _split_header(
    lines: list[tuple[int, str]], reading: Reading
) -> tuple[str, list[tuple[int, str]]]:
    """Header row and data rows; a header may itself be a comment, as numpy writes it."""
    rows = [(number, line) for number, line in lines if not line.lstrip().startswith("#")]
    if not rows:
        raise CampaignError("no data, allowed is a header row t,x[,y][,phi] and numbers")
    first, header = rows[0]
    if not NUMERIC.fullmatch(header):
        rows = rows[1:]
    else:
        comments = [line.lstrip().lstrip("#") for number, line in lines if number < first]
        header = comments[-1] if comments else ""
        if not places_of("t", fields_of(header, separator_of(header)), reading):
            row = "a first row t,x[,y][,phi][,force]"
            holds = f"line {first} holds numbers where the header row is expected"
            raise CampaignError(f"{holds}, allowed is {row}")
    if not rows:
        raise CampaignError("a header row without numbers, allowed is at least one row")
    return header, rows


def separator_of(header: str, without: str = r"\s+") -> str:
    """What stands between the columns; without: where none of the usual marks does."""
    return next((mark for mark in (";", "\t", ",") if mark in header), without)


def fields_of(line: str, separator: str) -> list[str]:
    """Cells of a line, without the quotes around them."""
    line = line.strip() if separator == r"\s+" else line.rstrip("\r\n")
    return [field.strip().strip("\"'") for field in re.split(separator, line)]


def _parse(rows: list[tuple[int, str]], separator: str, width: int) -> pd.DataFrame:
    text = [line.strip() if separator == r"\s+" else line for _, line in rows]
    is_comma = "," in (whole := "".join(text)) and "." not in whole
    if separator == "," and is_comma and all(row.count(",") >= 2 * width - 1 for row in text):
        raise CampaignError(
            "twice as many fields as columns: decimal commas between commas? allowed is a decimal "
            "point, or decimal commas with semicolons between the columns"
        )
    longest = max(range(len(text)), key=lambda row: text[row].count(separator))
    fields = fields_of(text[longest], separator)
    if len(fields) < width or any(fields[width:]):
        many = f"has {len(fields)} fields, the header has {width}; allowed is the same number"
        raise CampaignError(f"line {rows[longest][0]} {many}")
    table = "\n".join(text)
    if is_comma and separator != ",":
        table = table.replace(",", ".")
    return pd.read_csv(
        io.StringIO(table), sep=separator, header=None, names=range(width), usecols=range(width),
        index_col=False, skipinitialspace=True, na_values=MISSING, skip_blank_lines=False,
    )  # fmt: skip


def _numbers(name: str, column: pd.Series, lines: np.ndarray) -> np.ndarray:
    values = pd.to_numeric(column, errors="coerce").to_numpy(dtype=float)
    strange = np.flatnonzero(np.isnan(values) & column.notna().to_numpy())
    if not strange.size:
        return np.where(np.abs(values) < BEYOND, values, np.nan)
    text = str(column.iloc[strange[0]])
    where = f'line {lines[strange[0]]}: {name} = "{text[:40]}" is'
    if strange[0] == 0 and is_unit(text):  # a second header row
        unit = text.strip().strip("[]()").strip()
        raise CampaignError(
            f"{where} a unit, not a number; allowed is no row of units: in the header as "
            f'{name} [{unit}], or [units] {name} = "{unit}" in campaign.toml'
        )
    raise CampaignError(f"{where} not a number, allowed is one, or nothing for a missing sample")


def regime_remarks(run: MeasuredRun) -> list[str]:
    """Of a run that never slips, or never sticks, where noise lets that be seen."""
    if run.track is None:
        return []
    velocity, lag = velocity_of(run)
    band, noise = WITH_SURFACE * abs(run.surface_speed), math.sqrt(2.0) * run.noise["x"] / lag
    share = float(np.mean(np.abs(velocity - run.surface_speed) < band + 3.0 * noise))
    if share > ALWAYS:
        return ["no slip is seen, it says nothing of kinetic friction"]
    return ["no stick is seen after the start"] if share < NEVER and noise < band else []
