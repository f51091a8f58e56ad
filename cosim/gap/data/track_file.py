"""A tracker's file as a track: times that grow, enough samples, without outliers."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from cosim.gap.data.errors import CampaignError
from cosim.gap.data.measured import CHANNELS, MeasuredRun, Track
from cosim.gap.data.outliers import without_outliers
from cosim.gap.data.reading.columns import Reading, named_with_unit
from cosim.gap.data.reading.csv_file import read_columns

#: Fewer samples of x than this hold neither a cycle nor its noise.
FEWEST = 20
#: A record is also looked at on an even grid, as long as it takes: so many places for each of its
#: rows, and so many in all where the rows are few in them.
MOST_EMPTY, MOST_PLACES = 100, 5_000_000
#: Remarks on regimes: the block moves with the surface within this part of its speed, seen over
#: this part of a free vibration; of a record, the part above which, or below which, it always or
#: never does.
WITH_SURFACE, LAG, ALWAYS, NEVER = 0.1, 1.0 / 8.0, 0.9, 0.05


def read_track(file: Path, reading: Reading | None = None) -> tuple[Track, list[str], str]:
    """The track, remarks on it, what was converted; CampaignError in one line."""
    columns = read_columns(file, reading)
    time = columns.values.pop("t")
    if fault := _fault_of_times(time, columns.lines):
        raise CampaignError(f"{file}: line {fault}")
    remarks = [f"{file.name}: {_unused(name)}" for name in columns.ignored]
    channels: dict[str, np.ndarray] = {}
    outliers: dict[str, int] = {}
    for channel in CHANNELS:
        values = columns.values.get(channel)
        count = 0 if values is None else int(np.count_nonzero(np.isfinite(values)))
        if values is not None and count >= FEWEST:
            channels[channel], outliers[channel] = without_outliers(time, values)
        elif channel == "x":
            few = f"{count or 'no'} sample{'s' * (count != 1)}"
            raise CampaignError(f"{file}: column x: {few}, allowed are at least {FEWEST}")
        elif values is not None:
            remarks.append(f"{file.name}: column {channel} has {count} samples and is not used")
    track = Track(time=time - time[0], time_offset=float(time[0]), outliers=outliers, **channels)
    return track, remarks, "; ".join(columns.converted)


def _unused(name: str) -> str:
    """A column that nobody asked for; of one such as `phi_deg` how it would be."""
    said = f"column {name} is not used"
    meant = [(channel, named_with_unit(channel, [name])) for channel in CHANNELS]
    for channel, (column, unit) in ((channel, pair) for channel, pair in meant if pair):
        return f'{said}; [columns] {channel} = "{column}", [units] {channel} = "{unit}" uses it'
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


def regime_remarks(run: MeasuredRun) -> list[str]:
    """Of a run that never slips, or never sticks, where noise lets that be seen."""
    if run.track is None:
        return []
    seen = np.isfinite(run.track.x)
    time, x = run.track.time[seen], run.track.x[seen]
    lag = max(1, round(LAG * 2.0 * math.pi / run.natural_frequency / run.track.interval))
    velocity = (x[lag:] - x[:-lag]) / (time[lag:] - time[:-lag])
    off = np.abs(velocity - run.surface_speed) - WITH_SURFACE * abs(run.surface_speed)
    noise = math.sqrt(2.0) * run.noise["x"] / (lag * run.track.interval)
    share = float(np.mean(off < 3.0 * noise))
    if share > ALWAYS:
        return ["no slip is seen, it says nothing of kinetic friction"]
    if share < NEVER and noise < WITH_SURFACE * abs(run.surface_speed):
        return ["no stick is seen after the start"]
    return []
