"""A campaign file and its CSV files as a checked campaign."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path

from pydantic import ValidationError
from stickslip import Parameters

from cosim.gap.data.campaign_file import FILE_NAME, CampaignTable, RunTable, read_tables
from cosim.gap.data.errors import CampaignError
from cosim.gap.data.friction_table import read_friction_table
from cosim.gap.data.hold_out import with_hold_outs, without_duplicates
from cosim.gap.data.measured import Campaign, MeasuredRun
from cosim.gap.data.noise import with_noise
from cosim.gap.data.reading.columns import Reading
from cosim.gap.data.track_file import read_track, regime_remarks
from cosim.gap.data.units import check_units
from cosim.scenario.faults import describe_faults


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
    campaign = campaign_of(path, table, run_tables)
    remarks = list(campaign.remarks)
    if campaign.friction_table is not None and not any(run.file for run in run_tables):
        alone = "of runs of which only figures are known the law is mu_s and mu_k"
        raise CampaignError(f"{path}: friction.table: {alone}; allowed with a file in a [[run]]")
    runs: list[MeasuredRun] = []
    converted: dict[str, list[str]] = {}
    for number, run_table in enumerate(run_tables, 1):
        reading = _reading(f"{path}: run {number}", table, run_table)
        run, notes, units = _read_run(path, campaign, run_table, number, reading)
        runs.append(run)
        remarks += notes
        if units:
            converted.setdefault(units, []).append(run_table.file)
    remarks += [f"{', '.join(who)}: converted: {what}" for what, who in converted.items()]
    kept, copies = without_duplicates(_unique_names(runs), str(path))
    kept, held = with_hold_outs(kept, str(path))
    kept, noise, estimated, differs = with_noise(kept, table.noise.given)
    regimes = [f"{run.name}: {remark}" for run in kept for remark in regime_remarks(run)]
    return replace(
        campaign, noise=noise, noise_estimated=estimated, runs=kept,
        remarks=(*remarks, *copies, *held, *differs, *regimes),
    )  # fmt: skip


def campaign_of(path: Path, table: CampaignTable, runs: list[RunTable]) -> Campaign:
    """What the file states of all runs; they are still to be read, or to be made."""
    law = read_friction_table(path, table, [one.surface_speed for one in runs])
    return Campaign(
        table.name, path.parent, table.rig, table.model.scheme, table.noise.given, (), (),
        () if law is None else (law.text,), table.friction.given, table.errors, law,
        table.limits.given,
    )  # fmt: skip


def _reading(where: str, table: CampaignTable, run: RunTable) -> Reading:
    """Columns and units of a run's file: its own, else those of the campaign."""
    columns = {**table.columns.given, **run.columns.given}
    first: dict[str, str] = {}
    for channel, name in columns.items():
        if first.setdefault(name, channel) != channel:
            fault = f"columns.{channel}: {name} is columns.{first[name]} too"
            raise CampaignError(f"{where}: {fault}, allowed is a column for each")
    return Reading(columns, {**table.units.given, **run.units.given})


def _read_run(
    path: Path, campaign: Campaign, table: RunTable, number: int, reading: Reading
) -> tuple[MeasuredRun, list[str], str]:
    """A run, remarks on it, and which of its columns were in other units."""
    run = MeasuredRun(
        name=Path(table.file).stem if table.file else f"run {number}",
        file=path.parent / table.file if table.file else None,
        mass=table.mass, stiffness=table.stiffness, surface_speed=table.surface_speed,
        ambient_degC=table.ambient_degC, hold_out=table.hold_out,
        summary=table.summary.given or None, reading=reading,
    )  # fmt: skip
    try:  # what only rig and block together can show
        with warnings.catch_warnings(action="ignore"):  # the fit decides on the friction
            Parameters.model_validate(campaign.parameters(run), strict=True)
    except ValidationError as report:
        fault = describe_faults(report, Parameters)
        raise CampaignError(f"{path}: run {number}: {fault}") from None
    if run.file is None:
        return run, [], ""
    track, remarks, converted = read_track(run.file, reading)
    remarks += check_units(run.file, run, track, campaign.rig)
    return replace(run, track=track), remarks, converted


def _unique_names(runs: list[MeasuredRun]) -> list[MeasuredRun]:
    """Files of one name in several folders, or listed twice, get their number."""
    names = [run.name for run in runs]
    return [
        replace(run, name=f"{run.name} (run {number})") if names.count(run.name) > 1 else run
        for number, run in enumerate(runs, 1)
    ]
