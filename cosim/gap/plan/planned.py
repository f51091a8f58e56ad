"""A campaign that is only planned: what its file states, and its runs, simulated."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from stickslip import Parameters, simulate

from cosim.gap.data import Campaign, MeasuredRun, Track
from cosim.gap.data.campaign import check_fit_runs, run_of, stated_in
from cosim.gap.data.campaign_file import RunTable
from cosim.gap.data.errors import CampaignError, within
from cosim.gap.data.units import COARSEST
from cosim.gap.naming import Unknowns, asked_of
from cosim.gap.plan.known import NOISE, answer_of_gap, known_friction, rows_of_run, runs_made
from cosim.gap.weak_form.system import System

#: Over so much sliding speed friction falls from mu_s to mu_k, m/s: dry contacts have 1 to 8 mm/s.
TRANSITION = 2e-3
#: A run of more samples is a slip of the pen: a minute to the second is 6000.
MOST_SAMPLES = 200_000
#: Part of the springs' length beyond which no block goes: they would be crushed.
FARTHEST = 0.8

#: Tables of `Parameters`.
Blocks = Mapping[str, Mapping[str, float]]


@dataclass(frozen=True)
class PlannedRun:
    """A run that is to be made: its setting, duration in s and rate in Hz."""

    setting: MeasuredRun
    duration: float
    rate: float


@dataclass(frozen=True)
class PlannedCampaign:
    """What is to be measured.

    Attributes
    ----------
    campaign : rig, noise and what is known of the friction; its runs have no track
    runs : all, those that are held out too
    friction : coefficient -> value that is expected; mu_k of a table, whose level it is
    source : where each of them is from, in a line
    """

    campaign: Campaign
    runs: tuple[PlannedRun, ...]
    friction: Mapping[str, float]
    source: str


def read_plan(
    path: str | Path, model: str | Path | None = None, results: Path | None = None
) -> PlannedCampaign:
    """The planned campaign in a TOML file, or in a folder's campaign.toml.

    Its keys are those of a measured campaign. Of a run that has been made, its ``file`` says noise,
    duration and rate where the TOML file does not; of another, ``duration`` and ``rate`` do.

    model : a scenario, or a folder of `gap`'s, whose friction is expected
    results : in which `gap` may have left its answer on this campaign: its friction is taken where
        the TOML file states none

    CampaignError in one line: file, key, what is wrong, what is allowed.

    >>> from pathlib import Path
    >>> from cosim import read_plan
    >>> from cosim.gap.example import write_planned_example
    >>> planned = read_plan(write_planned_example(Path("next_week")))
    >>> len(planned.runs), planned.friction
    (4, {'mu_k': 0.22, 'mu_s': 0.3})
    """
    path, table, tables, campaign = stated_in(path, RunTable)
    if table.model.scheme != "exact":
        scheme = f'model.scheme = "{table.model.scheme}"'
        lacks = "what a scheme lacks is no question to a rig"
        raise CampaignError(f'{path}: {scheme}: {lacks}, allowed is "exact"')
    made = runs_made(path, table, tables, campaign)
    given = None if model is None else Path(model)
    answer = None if results is None else answer_of_gap(path, campaign, results)
    friction, source, doubts = known_friction(path, table, tables, campaign, made, given, answer)
    own, noise = campaign.friction_table, {"x": NOISE, **made.noise}
    remarks = doubts if own is None else [*doubts, own.text]
    if "x" not in table.noise.given:
        of_runs = ", that of the runs that were made" if made.runs else ""
        remarks.append(f"noise.x is not given: {noise['x']:.3g} m{of_runs}")
    campaign = replace(campaign, noise=noise)
    tracks = {run.file: run.motion for run in made.runs if run.file}
    runs = [_planned(path, campaign, run, number, tracks) for number, run in enumerate(tables, 1)]
    settings = tuple(run.setting for run in runs)
    check_fit_runs(settings, str(path))
    if tracks:
        names = ", ".join(run.name for run in made.runs)
        remarks.append(f"{names}: planned as made, with duration and rate of the files")
    if away := [run.file for run in tables if run.file and path.parent / run.file not in tracks]:
        remarks.append(f"{', '.join(away)}: not there yet, planned with duration and rate")
    campaign = replace(campaign, runs=settings, remarks=tuple(remarks))
    return PlannedCampaign(campaign, tuple(runs), friction, source)


def _planned(
    path: Path, campaign: Campaign, table: RunTable, number: int, tracks: Mapping[Path, Track]
) -> PlannedRun:
    """One [[run]], checked against the rig; tracks : file -> what was seen of it."""
    where = f"{path}: run {number}"
    if table.summary.given:
        raise CampaignError(f"{where}: summary: figures of a run that is planned, allowed is none")
    with within(where):
        setting = run_of(campaign, table.model_copy(update={"file": ""}), number)
    setting = replace(setting, noise=campaign.noise)
    if track := tracks.get(path.parent / table.file):
        seen = {"duration": track.duration, "rate": 1.0 / track.interval}
        stated = table.model_dump(include=table.model_fields_set & seen.keys())
        table = table.model_copy(update={**seen, **stated})
    period = 2.0 * np.pi / setting.natural_frequency
    if table.rate * COARSEST * period < 1.0:
        raise CampaignError(
            f"{where}: rate = {table.rate:g} Hz, the block's free vibration takes {period:.3g} s; "
            f"allowed is at least {1.0 / (COARSEST * period):.3g} Hz"
        )
    if table.duration < 2.0 * period or table.duration * table.rate > MOST_SAMPLES:
        raise CampaignError(
            f"{where}: duration = {table.duration:g} s, allowed is {2.0 * period:.3g} s (two free "
            f"vibrations) to {MOST_SAMPLES / table.rate:.4g} s ({MOST_SAMPLES} samples)"
        )
    return PlannedRun(setting, table.duration, table.rate)


def as_measured(planned: PlannedCampaign, seed: int = 0, blocks: Blocks | None = None) -> Campaign:
    """The runs as a tracker would see them; blocks : effects that are in them."""
    random, campaign = np.random.default_rng(seed), planned.campaign
    runs = [simulated(campaign, run, planned.friction, random, blocks) for run in planned.runs]
    return replace(planned.campaign, runs=tuple(runs))


def simulated(
    campaign: Campaign, run: PlannedRun, friction: Mapping[str, float],
    random: np.random.Generator, blocks: Blocks | None = None,
) -> MeasuredRun:  # fmt: skip
    """A run with its track: the block laid on the running surface with slack springs.

    friction : mu_s, mu_k; blocks : effects that are in it, as of `Parameters`. CampaignError where
    the rig cannot make the run.
    """
    setting = run.setting
    law: dict[str, Any] = {"transition_speed": TRANSITION, **friction}
    table = campaign.friction_table
    if table is not None:
        level = friction["mu_k"] / table.level
        law |= {"table_speed": table.speeds, "table_mu": tuple(level * np.array(table.mu))}
        law = {key: value for key, value in law.items() if key != "mu_k"}
    parameters = campaign.parameters(setting) | {
        "friction": law, "initial": {"vx": setting.surface_speed}, **(blocks or {}),
    }  # fmt: skip
    with warnings.catch_warnings(action="ignore"):
        kind = Parameters.of(campaign.catalogue)
        moved = simulate(kind.model_validate(parameters), run.duration, 1.0 / run.rate)
    if not np.abs(moved["x"]).max() <= FARTHEST * campaign.rig.spring_length:  # or no number
        allowed = "allowed are springs, mass and speed that keep the block between its springs"
        raise CampaignError(f"{campaign.name}: {setting.name}: the springs are crushed, {allowed}")
    seen = {
        name: moved[name] + campaign.noise[name] * random.standard_normal(moved.time.size)
        for name in ("x", "y", "phi")
        if name in campaign.noise
    }
    track = Track(moved.time, seen["x"], seen.get("y"), seen.get("phi"))
    return replace(setting, track=track)


def asked_as_planned(campaign: Campaign) -> tuple[System, Unknowns]:
    """Rows along x of all runs, and what `gap` asks of them: nothing moves the block across."""
    rows = [rows_of_run(campaign, run) for run in campaign.runs]
    system, _, unknowns = asked_of(campaign, rows)
    return system, unknowns
