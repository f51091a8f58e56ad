"""A campaign of a folder of tracker files: what their names and headers say, to be corrected.

Files of Tracker (Open Source Physics), of DeepLabCut and of Excel are written once more beside
themselves, as ``NAME_track.csv`` with one header row, which is what a campaign names.
"""

from __future__ import annotations

import io
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import tomli_w
from stickslip.units import in_unit

from cosim.files import OutputRefused, write_text
from cosim.gap.data.campaign_file import FILE_NAME
from cosim.gap.data.columns import FACTORS, SI, Reading, channel_of, header_parts, unit_in_name
from cosim.gap.data.errors import CampaignError, ColumnMissing
from cosim.gap.data.track_file import fields_of, read_track, separator_of

TEXTS, EXCEL = (".csv", ".tsv", ".txt", ".dat"), (".xlsx", ".xlsm")
#: Ends of what is written beside a file that no campaign can name.
MADE = "_track.csv"
#: DeepLabCut is less sure of a place than this where it has lost the point.
LEAST_LIKELY = 0.6
#: Runs from which on the last is held out.
ENOUGH = 3
#: Key of a run -> its unit, letters that stand before its number in a name, and units behind it,
#: as they are spelled where no `/` can be.
NUMBER = r"(-?\d+(?:[.,p]\d+)?)"
SETTINGS: dict[str, tuple[str, str, dict[str, str]]] = {
    "mass": ("kg", "m|mass", {"kg": "kg", "g": "g"}),
    "stiffness": ("N/m", "k|stiffness", {r"N(?:_?per_?|[-_ ])?m": "N/m"}),
    "surface_speed": ("m/s", "v|speed", {
        rf"{unit}(?:_?per_?|[-_ p])?s": f"{unit}/s" for unit in ("mm", "cm", "m")
    }),
    "ambient_degC": ("degC", "T|temp", {"degC": "degC", "C": "degC"}),
}  # fmt: skip
#: What a column is called in other words.
OTHER_NAMES = {
    "t": ("time", "seconds", "sec"),
    "x": ("pos", "position", "pos_x", "position_x", "x_pos", "displacement"),
    "y": ("pos_y", "position_y", "y_pos"),
    "phi": ("angle", "rotation", "theta"),
    "force": ("load", "load_cell"),
}


@dataclass(frozen=True)
class Found:
    """A file as a run.

    file : that the campaign names; settings : key -> value that its name says; reading : names of
    columns and units that the header does not say by itself; rows, seconds : of the record
    """

    file: str
    settings: Mapping[str, float]
    reading: Reading
    rows: int
    seconds: float


def campaign_of(
    folder: Path, known: Mapping[str, float] | None = None, *, frames: float | None = None,
    pixel: float | None = None, force: bool = False,
) -> tuple[Path, list[Found]]:  # fmt: skip
    """Write ``campaign.toml`` into a folder of tracker files; its path, and what was found.

    known : settings that all runs have; frames : a second, and pixel : m, of tracks in pixels.
    A ``campaign.toml`` of nothing but [columns] and [units] says what files call them. Raises
    CampaignError in one line for a file that cannot be read, and OutputRefused where there is a
    campaign already, unless ``force``.
    """
    target = folder / FILE_NAME
    said = _said_beforehand(target)
    if target.exists() and said is None and not force:
        raise OutputRefused(f"{target}: is there, allowed is --force to overwrite it")
    found = [_found(file, said or Reading()) for file in _readable(folder, frames, pixel)]
    if not found:
        raise CampaignError(f"{folder}: no tracks, allowed are {', '.join((*TEXTS, *EXCEL))}")
    write_text(_toml(folder.resolve().name, found, known or {}), target)
    return target, found


def _said_beforehand(file: Path) -> Reading | None:
    """Of a campaign's file that names columns and no run yet; None of another."""
    try:
        tables = tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    named = [tables.get(key, {}) for key in ("columns", "units")]
    if set(tables) - {"name", "columns", "units"} or not all(isinstance(n, dict) for n in named):
        return None
    return Reading(*({str(k): str(v) for k, v in one.items()} for one in named))


def _readable(folder: Path, frames: float | None, pixel: float | None) -> Iterator[Path]:
    """The files that a campaign can name, some of them written anew."""
    if not folder.is_dir():
        raise CampaignError(f"{folder}: no such folder, allowed is one of tracker files")
    for file in sorted(folder.iterdir()):
        if file.name.endswith(MADE) or file.suffix.lower() not in (*TEXTS, *EXCEL):
            continue
        if not file.is_file():  # to open a pipe would wait for ever
            raise CampaignError(f"{file}: cannot be read: is not a file")
        is_sheet = file.suffix.lower() in EXCEL
        text = _of_excel(file) if is_sheet else _text(file)
        rewritten = _of_deeplabcut(file, text, frames, pixel) or _of_tracker(text)
        rewritten = rewritten or (text if is_sheet else None)
        made = file.with_name(file.stem + MADE)
        yield file if rewritten is None else write_text(rewritten, made)


def _text(file: Path) -> str:
    return file.read_bytes().decode("utf-8-sig", errors="replace")


def _of_excel(file: Path) -> str:
    """The first sheet as CSV."""
    try:
        return str(pd.read_excel(file, header=None).to_csv(header=False, index=False))
    except ImportError:
        raise CampaignError(f"{file}: needs `pip install openpyxl`, or save it as CSV") from None
    except ValueError as error:
        raise CampaignError(f"{file}: no table that can be read ({error})") from None


def _cells(line: str) -> list[str]:
    return fields_of(line, separator_of(line, ","))


def _of_tracker(text: str) -> str | None:
    """Tracker's table with one header row, of its first point; None for another."""
    lines = [line for line in text.splitlines() if line.strip()]
    if len(lines) < 3 or "t" not in map(channel_of, _cells(lines[1])):
        return None
    points, header = _cells(lines[0]), [channel_of(header_parts(c)[0]) for c in _cells(lines[1])]
    if {"t", "x"} & set(map(channel_of, points)) or any(map(_is_number, points)):
        return None
    again = next((place for place, name in enumerate(header) if place and name == "t"), len(header))
    mark = separator_of(lines[1], ",")
    return "\n".join(mark.join(line.split(mark)[:again]) for line in lines[1:]) + "\n"


def _is_number(cell: str) -> bool:
    return bool(re.fullmatch(r"[-+]?\d+([.,]\d*)?([eE][-+]?\d+)?", cell))


def _of_deeplabcut(file: Path, text: str, frames: float | None, pixel: float | None) -> str | None:
    """DeepLabCut's places in pixels as t, x, y and, of two points and more, phi; None for another.

    The block is where the points are in the mean, turned as the line from the first to the last;
    its y goes up, that of a picture down.
    """
    lines = text.splitlines()
    if [line.partition(",")[0] for line in lines[:3]] != ["scorer", "bodyparts", "coords"]:
        return None
    if frames is None or pixel is None:
        raise CampaignError(
            f"{file}: DeepLabCut's pixels, frame by frame; needed are --frames RATE, pictures a "
            'second, and --pixel LENGTH, as "0.2 mm"'
        )
    read = pd.read_csv(io.StringIO(text), header=[1, 2], index_col=0)
    places = []
    for name in dict.fromkeys(read.columns.get_level_values(0)):
        point = read[name].astype(float)
        if "likelihood" in point:
            point[point["likelihood"] < LEAST_LIKELY] = np.nan
        places.append(point[["x", "y"]].to_numpy())
    centre = np.mean(places, axis=0) * pixel
    table = {"t": read.index.astype(float) / frames, "x": centre[:, 0], "y": -centre[:, 1]}
    if len(places) > 1:
        along = (places[-1] - places[0]) * (1.0, -1.0)
        turned = np.arctan2(along[:, 1], along[:, 0])
        seen = np.isfinite(turned)
        turned[seen] = np.unwrap(turned[seen])
        table["phi"] = turned - turned[seen][:1]
    return str(pd.DataFrame(table).to_csv(index=False, float_format="%.9g"))


def settings_of(name: str) -> dict[str, float]:
    """What the name of a file says of its run.

    >>> settings_of("870g_60mm-s_k38.5_run2")
    {'mass': 0.87, 'stiffness': 38.5, 'surface_speed': 0.06}
    >>> settings_of("m1p4 v0.15 -8degC")
    {'mass': 1.4, 'surface_speed': 0.15, 'ambient_degC': -8.0}
    """
    found = {}
    for key, (own, letters, units) in SETTINGS.items():
        ways = [(rf"(?<![\d.,A-Za-z]){NUMBER}[-_ ]?{word}(?![A-Za-z])", unit)
                for word, unit in units.items()]  # fmt: skip
        ways.append((rf"(?<![A-Za-z])(?:{letters})[=_ ]?{NUMBER}(?![.,]?\d|[-_ ]?[A-Za-z]*/)", own))
        for pattern, unit in ways:
            if match := re.search(pattern, name):
                number = re.sub("[,p]", ".", match[1])
                value = in_unit(f"{number} {unit}", own)
                found[key] = float(number) if value is None else value
                break
    return found


def _found(file: Path, said: Reading) -> Found:
    """A file with what its name and its header say; CampaignError where no column is x.

    said : columns and units that are known
    """
    header = next((line for line in _text(file).splitlines() if line.strip()), "")
    columns, units = dict(said.columns), dict(said.units)
    cells = _cells(header)
    for channel in (channel for channel in SI if channel not in columns):
        cell = next((cell for cell in cells if _is_called(channel, cell)), None)
        cell = cell or _only_of_its_kind(channel, cells)
        if cell is None:
            continue
        name, unit = header_parts(cell)
        ending = unit_in_name(channel, name)
        if ending or channel_of(name) != channel:
            columns[channel] = name if unit else cell.strip()
        if ending and not unit:
            units[channel] = ending
    reading = Reading(columns, units)
    try:
        track, _, _ = read_track(file, reading)
    except ColumnMissing as error:
        first = "which is then written first, with nothing but [columns] and [units]"
        raise CampaignError(f"{error}, {first}") from None
    stem = file.name.removesuffix(MADE).removesuffix(file.suffix)
    return Found(file.name, settings_of(stem), reading, track.time.size, float(track.time[-1]))


def _is_called(channel: str, cell: str) -> bool:
    """Whether a header's cell names a channel, by its own name or another."""
    name, _ = header_parts(cell)
    ending = unit_in_name(channel, name)
    bare = name[: -len(ending) - 1] if ending else name
    return channel_of(bare) == channel or bare.strip().lower() in OTHER_NAMES[channel]


def _only_of_its_kind(channel: str, cells: Sequence[str]) -> str | None:
    """Time or place under a name in another language: the only column with a unit of that kind."""
    if channel not in ("t", "x"):
        return None
    units = FACTORS[SI[channel]]
    there = [cell for cell in cells if header_parts(cell)[1] in units
             and not any(_is_called(other, cell) for other in SI)]  # fmt: skip
    return there[0] if len(there) == 1 else None


def _toml(name: str, found: Sequence[Found], known: Mapping[str, float]) -> str:
    """The campaign, of which every guess says where it is from."""
    shared = all(each.reading == found[0].reading for each in found)
    tables: dict[str, Any] = {"name": name}
    if shared:
        tables |= {key: names for key, names in found[0].reading._asdict().items() if names}
    parts = [
        "# What the names and headers of the files say. Correct it, then: stickslip gap",
        tomli_w.dumps(tables),
        "[rig]\n# what is known of the rig, see `stickslip keys rig`, as\n"
        "# spring_natural_length = 0.17  # m\n",
    ]
    for number, each in enumerate(found, 1):
        reading, last = Reading() if shared else each.reading, number == len(found) >= ENOUGH
        parts.append("\n".join(_run(each, known, reading, last)))
    return "\n".join(parts)


def _run(found: Found, known: Mapping[str, float], reading: Reading, last: bool) -> Iterator[str]:
    yield f"[[run]]  # {found.rows} rows, {found.seconds:.3g} s"
    yield tomli_w.dumps({"file": found.file}).rstrip()
    for key, (unit, _, _) in SETTINGS.items():
        if key in found.settings:
            yield f"{key} = {found.settings[key]:g}  # {unit}, by the file's name"
        elif key in known:
            yield f"{key} = {known[key]:g}  # {unit}, as given"
        elif key != "ambient_degC":
            yield f"# {key} =   # {unit}: must be given, the file's name does not say it"
    if last:
        yield "hold_out = true  # predicted, never fitted"
    for table, names in reading._asdict().items():
        if names:
            inline = ", ".join(f'{key} = "{value}"' for key, value in names.items())
            yield f"{table} = {{ {inline} }}"
    yield ""


def shown(found: Sequence[Found], known: Mapping[str, float]) -> list[str]:
    """A line for each run: file, length, settings, what the columns were taken for.

    known : settings of every run whose file's name does not say them
    """
    columns = [f"{key} [{unit}]" for key, (unit, _, _) in SETTINGS.items()]
    rows = [("file", "rows", "time [s]", *columns, "columns")]
    for each in found:
        settings = {**known, **each.settings}
        told = [f"{settings[key]:g}" if key in settings else "?" for key in SETTINGS]
        named = ", ".join(f"{key} = {name}" for key, name in each.reading.columns.items())
        record = each.file, str(each.rows), f"{each.seconds:.3g}"
        rows.append((*record, *told, named or "as named"))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    ]
