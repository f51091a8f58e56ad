"""A campaign file and its CSV files as a checked campaign."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from stickslip import Parameters

from cosim.gap.data.campaign_file import (
    FILE_NAME,
    CampaignTable,
    MeasuredRunTable,
    RunTable,
    read_tables,
)
from cosim.gap.data.columns import Reading
from cosim.gap.data.errors import CampaignError, within
from cosim.gap.data.friction_table import read_friction_table
from cosim.gap.data.measured import Campaign, MeasuredRun
from cosim.gap.data.noise import with_noise
from cosim.gap.data.run_up import after_run_up
from cosim.gap.data.track_file import read_track, regime_remarks
from cosim.gap.data.units import check_units
from cosim.scenario.validation import checked

#: So many equal samples in a row are no coincidence of two measurements.
PATTERN = 16
#: Free vibrations of a run that are looked at: ten minutes of a usual rig, and minutes of work.
MOST_VIBRATIONS = 1000.0


def read_campaign(path: str | Path) -> Campaign:
    """The campaign in a TOML file, or in a folder's campaign.toml; CSV files lie beside it.

    Columns are t (s), x (m, along the surface's motion) and, where measured, y (m), phi (rad),
    force (N, what the springs pull the block back with along x, positive where x is).
    ``[columns]`` names them otherwise, ``[units]`` or the header (`x [mm]`, `t/ms`, `phi (deg)`)
    states other units; both tables may stand in a ``[[run]]`` too, and hold there. What was
    converted is among the remarks, and so is what is odd, yet can be used.

    Raises CampaignError in one line: file, key or column, what is wrong, what is allowed.

    >>> from pathlib import Path
    >>> from cosim import read_campaign
    >>> from cosim.gap.example import write_example
    >>> campaign = read_campaign(write_example(Path("cold_room")))
    >>> campaign.name, [run.surface_speed for run in campaign.runs]
    ('example', [...])
    """
    path, table, run_tables, campaign = stated_in(path)
    law = campaign.friction_table
    if law is not None and not any(run.file for run in run_tables):
        alone = "of runs of which only figures are known the law is mu_s and mu_k"
        raise CampaignError(f"{path}: friction.table: {alone}; allowed with a file in a [[run]]")
    runs, remarks = [], [] if law is None else [law.text]
    converted: dict[str, list[str]] = {}
    for number, run_table in enumerate(run_tables, 1):
        with within(f"{path}: run {number}"):
            run, reading = run_of(campaign, run_table, number), _reading(table, run_table)
        if run.file is not None:
            track, notes, units = read_track(run.file, reading)
            run = replace(run, track=track)
            remarks += [*notes, *check_units(run, campaign.rig)]
            if units:
                converted.setdefault(units, []).append(run_table.file)
        runs.append(run)
    remarks += [f"{', '.join(who)}: converted: {what}" for what, who in converted.items()]
    kept, copies = without_duplicates(_unique_names(runs), str(path))
    kept, held = with_hold_outs(kept, str(path))
    kept, cut = shortened(kept)
    kept, run_ups = after_run_up(kept)
    kept, noise, estimated, differs = with_noise(kept, table.noise.given)
    regimes = [f"{run.name}: {remark}" for run in kept for remark in regime_remarks(run)]
    if any(run.track is not None for run in kept):
        unused = [run.name for run in kept if run.track is None]
        regimes += [f"{name}: summary: ignored beside runs with a file" for name in unused]
    return replace(
        campaign, noise=noise, noise_estimated=estimated, runs=kept,
        remarks=(*remarks, *copies, *held, *cut, *run_ups, *holes(kept), *differs, *regimes),
    )  # fmt: skip


def holes(runs: Sequence[MeasuredRun]) -> list[str]:
    """A remark on the runs whose block the tracker lost for more than a quarter of a swing."""
    longest = {}
    for run in runs:
        if run.track is not None:
            lost = float(np.diff(run.track.time[np.isfinite(run.track.x)]).max())
            if lost > 0.5 * np.pi / run.natural_frequency:
                longest[run.name] = lost
    if not longest:
        return []
    most = f"lost for up to {max(longest.values()):.2g} s, of which nothing is asked"
    return [f"{', '.join(longest)}: the block is {most}"]


def stated_in(
    path: str | Path, kind: type[RunTable] = MeasuredRunTable
) -> tuple[Path, CampaignTable, list[RunTable], Campaign]:
    """A file, also of a folder; its tables, and the campaign that it states, still without runs."""
    path = Path(path)
    path = path / FILE_NAME if path.is_dir() else path
    table, run_tables, catalogue = read_tables(path, kind)
    law = read_friction_table(path, table, [run.surface_speed for run in run_tables])
    return path, table, run_tables, Campaign(
        table.name, path.parent, table.rig, table.model.scheme, {}, (), (), (),
        table.friction.given, table.errors, law, table.limits.given, catalogue,
    )  # fmt: skip


def _reading(table: CampaignTable, run: RunTable) -> Reading:
    """Columns and units of a run's file: its own, else those of the campaign."""
    columns = {**table.columns.given, **run.columns.given}
    first: dict[str, str] = {}
    for channel, name in columns.items():
        if (other := first.setdefault(name, channel)) != channel:
            fault = f"columns.{channel}: {name} is columns.{other} too"
            raise CampaignError(f"{fault}, allowed is a column for each")
    return Reading(columns, {**table.units.given, **run.units.given})


def run_of(campaign: Campaign, table: RunTable, number: int) -> MeasuredRun:
    """A run as it is stated; what only rig and block together can show is checked."""
    run = MeasuredRun(
        Path(table.file).stem if table.file else f"run {number}",
        campaign.path / table.file if table.file else None,
        table.mass, table.stiffness, table.surface_speed, table.ambient_degC, table.hold_out,
        summary=table.summary.given or None,
    )  # fmt: skip
    with warnings.catch_warnings(action="ignore"):  # the fit decides on the friction
        checked(Parameters.of(campaign.catalogue), campaign.parameters(run))
    return run


def _unique_names(runs: list[MeasuredRun]) -> list[MeasuredRun]:
    """Files of one name in several folders, or listed twice, get their number."""
    names = [run.name for run in runs]
    return [
        replace(run, name=f"{run.name} (run {number})") if names.count(run.name) > 1 else run
        for number, run in enumerate(runs, 1)
    ]


def without_duplicates(
    runs: Sequence[MeasuredRun], source: str
) -> tuple[tuple[MeasuredRun, ...], list[str]]:
    """Runs whose data are in no earlier run, and a remark on each that was left out.

    Of two runs with the same data the fitted one stays: a copy tells nothing new, and a held-out
    copy of a fitted run would judge the fit by its own data. CampaignError where the same data are
    said to come from two operating points: one of them is wrong.
    """
    kept: list[MeasuredRun] = []
    remarks = []
    for run in sorted(runs, key=lambda run: run.hold_out):
        twin = next((other for other in kept if _same_data(run, other)), None)
        if twin is None:
            kept.append(run)
            continue
        same = f"{run.name} holds the same data as {twin.name}"
        if run.operating_point != twin.operating_point:
            raise CampaignError(
                f"{source}: {same}, but its mass, stiffness, surface_speed or ambient_degC differ; "
                "allowed is each measurement once"
            )
        copy = " and is not held out from it" if run.hold_out and not twin.hold_out else ""
        remarks.append(f"{same}{copy}: left out")
    return tuple(run for run in runs if run in kept), remarks


def shortened(runs: Sequence[MeasuredRun]) -> tuple[tuple[MeasuredRun, ...], list[str]]:
    """Runs without what comes after `MOST_VIBRATIONS`, and a remark on each that was longer."""
    kept, remarks = [], []
    for run in runs:
        longest = MOST_VIBRATIONS * 2.0 * math.pi / run.natural_frequency
        if run.track is not None and run.track.duration > longest:
            remarks.append(
                f"{run.name}: of {run.track.duration:.3g} s the first {longest:.3g} s are looked "
                f"at, {MOST_VIBRATIONS:g} free vibrations; a later part may be a run of its own"
            )
            run = replace(run, track=run.track.until(longest))
        kept.append(run)
    return tuple(kept), remarks


def _same_data(run: MeasuredRun, other: MeasuredRun) -> bool:
    """Whether one track is the other or a part of it."""
    if run.track is None or other.track is None:
        return run.summary is not None and run.summary == other.summary
    present = [one.motion.x[np.isfinite(one.motion.x)] for one in (run, other)]
    short, long = sorted(present, key=len)
    if len(short) < PATTERN:
        return False
    begins = sliding_window_view(long, PATTERN)[: len(long) - len(short) + 1]
    starts = np.flatnonzero((begins == short[:PATTERN]).all(axis=1))
    return any(np.array_equal(long[start : start + len(short)], short) for start in starts)


def check_fit_runs(runs: Sequence[MeasuredRun], source: str) -> None:
    """CampaignError where nothing is left to fit."""
    if all(run.hold_out for run in runs):
        nothing = "hold_out: true in every run, there is nothing to fit"
        raise CampaignError(f"{source}: {nothing}; allowed is false in at least one")


def with_hold_outs(
    runs: tuple[MeasuredRun, ...], source: str
) -> tuple[tuple[MeasuredRun, ...], list[str]]:
    """As marked, else by rule, and a remark on it; CampaignError where nothing is left to fit.

    The rule holds out every third run with a track, the second, fifth, ... in the order of speed,
    mass and stiffness: a held-out run then mostly lies between two that are fitted, and slow and
    fast ones are both judged. Of two runs the faster one is held out; a single run is not. Runs of
    which only figures are known stay for the fit.
    """
    check_fit_runs(runs, source)
    if any(run.hold_out for run in runs):
        return runs, []
    tracks = [run for run in runs if run.track is not None]
    tracks.sort(key=lambda run: (abs(run.surface_speed), run.mass, run.stiffness, run.name))
    if held := [run for run in runs if run in tracks[1::3]]:
        said = f"no run is marked hold_out; held out by rule: {', '.join(run.name for run in held)}"
        return tuple(replace(run, hold_out=run in held) for run in runs), [said]
    judged = "is the only one with a track: the model is judged by what it was fitted to"
    return runs, [f"no run is held out, {run.name} {judged}" for run in tracks]
