"""What is known of a planned campaign beforehand: friction and noise, and where that is from."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from stickslip.friction.parameters import Friction

from cosim.gap.checks import doubts_of
from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.data.campaign import run_of, shortened
from cosim.gap.data.campaign_file import CampaignTable, RunTable
from cosim.gap.data.columns import Reading
from cosim.gap.data.errors import CampaignError, within
from cosim.gap.data.friction_table import FrictionTable
from cosim.gap.data.noise import with_noise
from cosim.gap.data.run_up import after_run_up
from cosim.gap.data.track_file import read_track
from cosim.gap.show.model_file import safe_name
from cosim.gap.weak_form.rig_unknowns import Level
from cosim.gap.weak_form.rows import RunRows, rows_of
from cosim.gap.weak_form.track import smooth, thinned
from cosim.manifest import MANIFEST
from cosim.scenario.toml_file import parsed, text_of
from cosim.scenario.validation import ScenarioError, checked

#: Ice on steel or ice at the temperatures and speeds of a cold room slides at about 0.1 (Marmo et
#: al. 2005); a usual break-away takes 1.3 times as much.
TYPICAL, BREAK_AWAY = 0.10, 1.3
#: Of a tracker that nothing is known of, m.
NOISE = 2e-4
#: Less than any contact: what moves there is no block in slip.
LEAST = 0.01
COEFFICIENTS = {"mu_k", "mu_s"}
#: What `gap` leaves in its folder.
MODEL = "model.toml"


def runs_made(
    path: Path, table: CampaignTable, tables: Sequence[RunTable], campaign: Campaign
) -> Campaign:
    """The runs whose files are there already, and their noise, stated or estimated."""
    runs = []
    for number, run_table in enumerate(tables, 1):
        if run_table.file and (campaign.path / run_table.file).is_file():
            columns = {**table.columns.given, **run_table.columns.given}
            reading = Reading(columns, {**table.units.given, **run_table.units.given})
            with within(f"{path}: run {number}"):
                run = run_of(campaign, run_table, number)
            track, _, _ = read_track(campaign.path / run_table.file, reading)
            runs.append(replace(run, track=track))
    if not runs:
        return replace(campaign, noise=table.noise.given)
    kept, _ = after_run_up(shortened(runs)[0])
    kept, noise, _, _ = with_noise(kept, table.noise.given)
    return replace(campaign, runs=kept, noise={"x": noise["x"]})


def known_friction(
    path: Path, table: CampaignTable, tables: Sequence[RunTable], campaign: Campaign,
    made: Campaign, model: Path | None, answer: Path | None,
) -> tuple[dict[str, float], str, list[str]]:  # fmt: skip
    """mu_k and mu_s; where each is from, in a line; why tracks are not taken, a line each.

    What ``model`` says goes first, then what the campaign's file states, then ``answer``, the
    folder of what `gap` has found, and last what the runs show that have been made.
    """
    own, doubts = campaign.friction_table, []
    speed = float(np.mean([abs(run.surface_speed) for run in tables]))
    stated = table.friction.expected | ({} if own is None else {"mu_k": own.level})
    known: dict[str, Mapping[str, float]] = {path.name: stated}
    if model is not None:
        if own is not None:
            raise CampaignError(f"{path}: friction.table beside a model, allowed is one of the two")
        known = {**friction_of(model, campaign, speed), **known}
    if answer is not None:
        known |= friction_of(answer, campaign, speed)
    if made.runs and not COEFFICIENTS <= set().union(*known.values()):
        doubts = [f"friction is not read off the runs: {doubt.text}"
                  for doubt in doubts_of(made) if doubt.severe]  # fmt: skip
        known["read off the runs that were made"] = {} if doubts else _seen_in(made)
    found, source = _filled(known)
    if found["mu_s"] < found["mu_k"]:
        fault = f"{source}: mu_s is below mu_k"
        raise CampaignError(f"{path}: friction: {fault}, allowed is as much or more")
    return found, source, doubts


def friction_of(model: Path, campaign: Campaign, speed: float) -> dict[str, Mapping[str, float]]:
    """What a model is, in words -> its mu_s and mu_k; of a table its level at a speed, m/s.

    model : a scenario's file, or a folder in which `gap` has left one
    """
    file = model / MODEL if model.is_dir() else model
    if not file.is_file():
        raise CampaignError(f"{file}: no such file, allowed is a scenario or the results of gap")
    try:
        tables = parsed(text_of(file), file)
    except ScenarioError as fault:
        raise CampaignError(str(fault)) from None
    stated = tables.get("friction")
    given = dict(stated) if isinstance(stated, dict) else {}
    if given.get("table"):
        given["table"] = str(file.parent / str(given["table"]))
    with within(f"{file}: friction"):
        read = checked(Friction, given)
    values = {key: getattr(read, key) for key in COEFFICIENTS & read.model_fields_set}
    if read.has_table and not read.table_temperature_degC:
        values["mu_k"] = FrictionTable(file, read.table_speed, read.table_mu, speed).level
    if not values or min(values.values()) <= 0.0:
        none = "no mu_k or mu_s above 0, allowed is one of them"
        raise CampaignError(f"{file}: friction: {none}")
    left = [effect.id for effect in campaign.catalogue.effects if tables.get(effect.id)]
    return {f"{file}" + (f", without its {', '.join(left)}" if left else ""): values}


def answer_of_gap(path: Path, campaign: Campaign, results: Path) -> Path | None:
    """The folder in which `gap` has left its answer on this campaign, if it has."""
    folder = results / f"{safe_name(campaign.name)}-gap"
    try:
        source = json.loads((folder / MANIFEST).read_text(encoding="utf-8"))["campaign"]
    except (OSError, ValueError, LookupError, TypeError):
        return None
    ours = {str(path.resolve()), str(path.resolve().parent)}
    return folder if source in ours and (folder / MODEL).is_file() else None


def _seen_in(made: Campaign) -> dict[str, float]:
    """Friction in slip and at break-away, of those that the runs have."""
    rows = [rows_of_run(made, run) for run in made.runs]
    level, seen = Level.of(rows), {}
    if level.kinetic > LEAST and any(run.track.slips_mask.any() for run in rows):
        seen["mu_k"] = level.kinetic
    if any(run.events for run in rows):
        seen["mu_s"] = max(level.static, seen.get("mu_k", 0.0))
    return seen


def _filled(known: Mapping[str, Mapping[str, float]]) -> tuple[dict[str, float], str]:
    """Of each coefficient the first that is known, else by the other; and where each is from."""
    found: dict[str, float] = {}
    told: dict[str, str] = {}
    for key in ("mu_k", "mu_s"):
        where = next((name for name, values in known.items() if key in values), None)
        if where is not None:
            found[key], told[key] = float(known[where][key]), where
    if not found:
        found["mu_k"], told["mu_k"] = TYPICAL, "not known: typical of ice"
    for key, other, part in (("mu_s", "mu_k", BREAK_AWAY), ("mu_k", "mu_s", 1.0 / BREAK_AWAY)):
        if key not in found:
            found[key], told[key] = part * found[other], f"not known: {part:.3g} {other}"
    groups: dict[str, list[str]] = {}
    for key in ("mu_k", "mu_s"):
        groups.setdefault(told[key], []).append(f"{key} = {found[key]:.4g}")
    return found, "; ".join(f"{', '.join(keys)} ({where})" for where, keys in groups.items())


def rows_of_run(campaign: Campaign, run: MeasuredRun) -> RunRows:
    """Rows along x."""
    return rows_of(smooth(thinned(run)), campaign.rig)
