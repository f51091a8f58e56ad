"""A campaign file and its CSV files as a checked campaign."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
from pydantic import ValidationError
from stickslip import Parameters

from cosim.gap.data.campaign_file import FILE_NAME, CampaignTable, RunTable, read_tables
from cosim.gap.data.errors import CampaignError
from cosim.gap.data.friction_table import read_friction_table
from cosim.gap.data.hold_out import choose_hold_outs, without_duplicates
from cosim.gap.data.measured import CHANNELS, Campaign, MeasuredRun, Track
from cosim.gap.data.noise import agree, difference_noise
from cosim.gap.data.outliers import without_outliers
from cosim.gap.data.reading.columns import Reading, named_with_unit
from cosim.gap.data.reading.csv_file import Columns, read_columns
from cosim.gap.data.stick_remarks import stick_remarks
from cosim.gap.data.sticks import find_sticks
from cosim.gap.data.units import check_units
from cosim.scenario.faults import describe_faults

#: Fewer samples of x than this hold neither a cycle nor its noise.
FEWEST = 20
#: A record is also looked at on an even grid, as long as it takes: so many places for each of its
#: rows, and so many in all where the rows are few in them.
MOST_EMPTY, MOST_PLACES = 100, 5_000_000


def read_campaign(path: str | Path) -> Campaign:
    """The campaign in a TOML file, or in a folder's campaign.toml; CSV files lie beside it.

    Columns are t (s), x (m, along the surface's motion) and, where measured, y (m), phi (rad),
    force (N, what the springs pull the block back with along x, positive where x is).
    ``[columns]`` names them otherwise, ``[units]`` or the header (`x [mm]`, `t/ms`, `phi (deg)`)
    states other units; both tables may stand in a ``[[run]]`` too, and hold there. What was
    converted is among the remarks, and so is what is odd, yet can be used.

    Raises CampaignError in one line: file, key or column, what is wrong, what is allowed.
    """
    path = Path(path)
    path = path / FILE_NAME if path.is_dir() else path
    table, run_tables = read_tables(path)
    campaign = Campaign(
        table.name, path.parent, table.rig, table.model.scheme, table.noise.given, (), (),
        friction=table.friction.given, errors=table.errors,
        friction_table=read_friction_table(path, table, [one.surface_speed for one in run_tables]),
    )  # fmt: skip
    runs, remarks = [], []
    if campaign.friction_table is not None:
        _check_tracks(path, run_tables)
        remarks.append(campaign.friction_table.text)
    converted: dict[str, list[str]] = {}
    for number, run_table in enumerate(run_tables, 1):
        reading = _reading(path, table, run_table, number)
        run, notes, units = _read_run(path, campaign, run_table, number, reading)
        runs.append(run)
        remarks += notes
        if units:
            converted.setdefault("; ".join(units), []).append(run_table.file)
    remarks += [f"{', '.join(who)}: converted: {what}" for what, who in converted.items()]
    kept, notes = without_duplicates(_unique_names(runs), str(path))
    remarks += notes
    kept, notes = _with_hold_outs(kept, path)
    remarks += notes
    kept, noise, estimated, notes = _with_noise(kept, table.noise.given)
    remarks += notes
    kept, notes = _with_sticks(kept)
    remarks += notes
    return replace(
        campaign, noise=noise, noise_estimated=estimated, runs=kept, remarks=tuple(remarks)
    )


def _check_tracks(path: Path, runs: list[RunTable]) -> None:
    if not any(run.file for run in runs):
        raise CampaignError(
            f"{path}: friction.table: of runs of which only figures are known the law is mu_s and "
            "mu_k; allowed with a file in a [[run]]"
        )


def _reading(path: Path, table: CampaignTable, run: RunTable, number: int) -> Reading:
    """Columns and units of a run's file: its own, else those of the campaign."""
    columns = {**table.columns.given, **run.columns.given}
    channels = list(columns)
    for place, channel in enumerate(channels):
        for other in channels[:place]:
            if columns[channel] == columns[other]:
                raise CampaignError(
                    f"{path}: run {number}: columns.{channel}: {columns[channel]} is "
                    f"columns.{other} too, allowed is a column for each"
                )
    return Reading(columns, {**table.units.given, **run.units.given})


def _read_run(
    path: Path, campaign: Campaign, table: RunTable, number: int, reading: Reading
) -> tuple[MeasuredRun, list[str], tuple[str, ...]]:
    """A run, remarks on it, and which of its columns were in other units."""
    run = MeasuredRun(
        name=Path(table.file).stem if table.file else f"run {number}",
        file=path.parent / table.file if table.file else None,
        mass=table.mass, stiffness=table.stiffness, surface_speed=table.surface_speed,
        ambient_degC=table.ambient_degC, hold_out=table.hold_out,
        summary=table.summary.given or None, reading=reading,
    )  # fmt: skip
    _check_rig(f"{path}: run {number}", campaign, run)
    if run.file is None:
        return run, [], ()
    columns = read_columns(run.file, reading)
    track, remarks = _track(run.file, columns)
    remarks += check_units(run.file, run, track, campaign.rig)
    return replace(run, track=track), remarks, columns.converted


def _check_rig(where: str, campaign: Campaign, run: MeasuredRun) -> None:
    """What only rig and block together can show."""
    try:
        with warnings.catch_warnings(action="ignore"):  # the fit decides on the friction
            Parameters.model_validate(campaign.parameters(run), strict=True)
    except ValidationError as report:
        raise CampaignError(f"{where}: {describe_faults(report, Parameters)}") from None


def read_track(file: Path) -> tuple[Track, list[str]]:
    """A tracker's file, outliers taken out, and remarks on it; CampaignError in one line."""
    return _track(file, read_columns(file))


def _track(file: Path, columns: Columns) -> tuple[Track, list[str]]:
    time = columns.values.pop("t")
    _check_time(file, time, columns.lines)
    _check_holes(file, time, columns.lines)
    remarks = [f"{file.name}: {_unused(name)}" for name in columns.ignored]
    channels: dict[str, np.ndarray] = {}
    outliers: dict[str, int] = {}
    for channel in CHANNELS:
        values = columns.values.get(channel)
        if values is None:
            continue
        count = int(np.count_nonzero(np.isfinite(values)))
        if count < FEWEST and channel == "x":
            raise CampaignError(
                f"{file}: column x: {count or 'no'} sample{'s' * (count != 1)}, allowed are at "
                f"least {FEWEST}"
            )
        if count < FEWEST:
            remarks.append(f"{file.name}: column {channel} has {count} samples and is not used")
            continue
        channels[channel], outliers[channel] = without_outliers(time, values)
    track = Track(time=time - time[0], time_offset=float(time[0]), outliers=outliers, **channels)
    return track, remarks


def _unused(name: str) -> str:
    """A column that nobody asked for; of one such as `phi_deg` how it would be."""
    said = f"column {name} is not used"
    for channel in CHANNELS:
        meant = named_with_unit(channel, [name])
        if meant:
            column, unit = meant
            return f'{said}; [columns] {channel} = "{column}", [units] {channel} = "{unit}" uses it'
    return said


def _check_time(file: Path, time: np.ndarray, lines: np.ndarray) -> None:
    missing = np.flatnonzero(np.isnan(time))
    if missing.size:
        raise CampaignError(
            f"{file}: line {lines[missing[0]]}: t is missing, allowed is a time in every row"
        )
    back = np.flatnonzero(np.diff(time) <= 0.0)
    if back.size:
        row = back[0] + 1
        again = "repeats" if time[row] == time[row - 1] else "falls back from"
        raise CampaignError(
            f"{file}: line {lines[row]}: t = {time[row]:.12g} s {again} {time[row - 1]:.12g} s, "
            f"allowed is a time that grows from row to row ({back.size} such row"
            f"{'s' * (back.size > 1)})"
        )


def _check_holes(file: Path, time: np.ndarray, lines: np.ndarray) -> None:
    """Refuse a record that is next to nothing but a hole in time."""
    if time.size < FEWEST:
        return
    steps = np.diff(time)
    interval = float(np.median(steps))
    places = (time[-1] - time[0]) / interval
    if places <= min(MOST_EMPTY * time.size, max(MOST_PLACES, 2 * time.size)):
        return
    row = int(np.argmax(steps)) + 1
    raise CampaignError(
        f"{file}: line {lines[row]}: t = {time[row]:.12g} s comes {steps[row - 1]:.4g} s after the "
        f"row before, in a record of {time.size} rows that are {interval:.4g} s apart; allowed are "
        f"holes up to {MOST_EMPTY} times as long as what was recorded: check the times, or give "
        "each part its own file and [[run]]"
    )


def _unique_names(runs: list[MeasuredRun]) -> list[MeasuredRun]:
    """Files of one name in several folders, or listed twice, get their number."""
    names = [run.name for run in runs]
    return [
        replace(run, name=f"{run.name} (run {number})") if names.count(run.name) > 1 else run
        for number, run in enumerate(runs, 1)
    ]


def _with_hold_outs(
    runs: tuple[MeasuredRun, ...], path: Path
) -> tuple[tuple[MeasuredRun, ...], list[str]]:
    if all(run.hold_out for run in runs):
        raise CampaignError(
            f"{path}: hold_out: true in every run, there is nothing to fit; allowed is false in at "
            "least one"
        )
    if any(run.hold_out for run in runs):
        return runs, []
    runs = choose_hold_outs(runs)
    held = [run.name for run in runs if run.hold_out]
    if held:
        return runs, [f"no run is marked hold_out; held out by rule: {', '.join(held)}"]
    alone = [run.name for run in runs if run.track is not None]
    return runs, [
        f"no run is held out, {name} is the only one with a track: the model is judged "
        "by what it was fitted to"
        for name in alone
    ]


def _with_noise(
    runs: tuple[MeasuredRun, ...], given: Mapping[str, float]
) -> tuple[tuple[MeasuredRun, ...], dict[str, float], tuple[str, ...], list[str]]:
    """Runs with their noise, that of the campaign, which is estimated, and remarks."""
    per_run: list[dict[str, float]] = [{} for _ in runs]
    overall: dict[str, float] = dict(given)
    remarks: list[str] = []
    estimated = []
    for channel in CHANNELS:
        there = [
            i
            for i, run in enumerate(runs)
            if run.track is not None and channel in run.motion.channels
        ]
        if channel in given or not there:
            values = [given.get(channel, 0.0)] * len(there)
        else:
            values, overall[channel], notes = _estimated(channel, [runs[i] for i in there])
            estimated.append(channel)
            remarks += notes
        for i, value in zip(there, values, strict=True):
            per_run[i][channel] = value
    runs = tuple(replace(run, noise=noise) for run, noise in zip(runs, per_run, strict=True))
    return runs, overall, tuple(estimated), remarks


def _estimated(channel: str, runs: list[MeasuredRun]) -> tuple[list[float], float, list[str]]:
    """Noise of each run, pooled where the runs agree; that of the campaign; remarks."""
    values, counts = [], []
    for run in runs:
        value = difference_noise(run.motion.time, run.motion[channel])
        if not value > 0.0:
            raise CampaignError(
                f"{run.file}: column {channel}: no noise can be estimated (no two samples differ, "
                f"or too few in a row), allowed is noise.{channel} in campaign.toml"
            )
        values.append(value)
        counts.append(int(np.count_nonzero(np.isfinite(run.motion[channel]))))
    pooled = float(np.sqrt(np.average(np.square(values), weights=counts)))
    if agree(values, counts):
        return [pooled] * len(values), pooled, []
    middle = float(np.median(values))
    span = f"{min(values):.2g} to {max(values):.2g}"
    remark = f"noise of {channel} differs from run to run ({span}): each run has its own"
    return values, middle, [remark]


def _with_sticks(runs: tuple[MeasuredRun, ...]) -> tuple[tuple[MeasuredRun, ...], list[str]]:
    """Runs with the sticks of their tracks, and remarks on these."""
    found = []
    names: dict[str, list[str]] = {}
    for run in runs:
        if run.track is not None:
            omega, noise = run.natural_frequency, run.noise["x"]
            run = replace(run, sticks=find_sticks(run.motion, run.surface_speed, omega, noise))
            for remark in stick_remarks(run):
                names.setdefault(remark, []).append(run.name)
        found.append(run)
    return tuple(found), [f"{', '.join(who)}: {remark}" for remark, who in names.items()]
