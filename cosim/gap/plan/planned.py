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
from cosim.gap.weak_form.rows import RunRows, rows_of
from cosim.gap.weak_form.system import System
from cosim.gap.weak_form.track import smooth, thinned

#: Ice on steel or ice at the temperatures and speeds of a cold room slides at about 0.1 (Marmo et
#: al. 2005); a usual break-away takes 1.3 times as much.
EXPECTED = {"mu_s": 0.13, "mu_k": 0.10}
#: Of a tracker that the file says nothing of, m.
NOISE = 2e-4
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
    """

    campaign: Campaign
    runs: tuple[PlannedRun, ...]
    friction: Mapping[str, float]


def read_plan(path: str | Path) -> PlannedCampaign:
    """The planned campaign in a TOML file, or in a folder's campaign.toml.

    Its keys are those of a measured campaign; of a run ``duration`` and ``rate`` take the place of
    a ``file``, which need not be there. CampaignError in one line: file, key, what is wrong, what
    is allowed.
    """
    path, table, tables, campaign = stated_in(path, RunTable)
    noise = {"x": NOISE, **table.noise.given}
    remarks = [] if "x" in table.noise.given else [f"noise.x is not given: {NOISE:g} m"]
    own, named = campaign.friction_table, table.friction.expected
    if own is not None:
        remarks.append(own.text)
        # a block that holds no more than it slides with does not stick
        named = {"mu_s": max(EXPECTED["mu_s"] / EXPECTED["mu_k"] * own.level, *own.mu), **named}
        named["mu_k"] = own.level
    expected = {**EXPECTED, **named}
    if unnamed := sorted(set(EXPECTED) - set(named)):
        said = ", ".join(f"friction.{key} = {expected[key]:g}" for key in unnamed)
        remarks.append(f"{said}: not given, typical of ice")
    if expected["mu_s"] < expected["mu_k"]:
        fault = f"mu_s = {expected['mu_s']:g} is below mu_k = {expected['mu_k']:g}"
        raise CampaignError(f"{path}: friction: {fault}, allowed is as much or more")
    if table.model.scheme != "exact":
        scheme = f'model.scheme = "{table.model.scheme}"'
        lacks = "what a scheme lacks is no question to a rig"
        raise CampaignError(f'{path}: {scheme}: {lacks}, allowed is "exact"')
    campaign = replace(campaign, noise=noise)
    runs = [_planned(path, campaign, run, number) for number, run in enumerate(tables, 1)]
    settings = tuple(run.setting for run in runs)
    check_fit_runs(settings, str(path))
    if any(table.file for table in tables):
        remarks.append("files of runs are not read: planned with duration and rate")
    campaign = replace(campaign, runs=settings, remarks=tuple(remarks))
    return PlannedCampaign(campaign, tuple(runs), expected)


def _planned(path: Path, campaign: Campaign, table: RunTable, number: int) -> PlannedRun:
    """One [[run]], checked against the rig."""
    where = f"{path}: run {number}"
    if table.summary.given:
        raise CampaignError(f"{where}: summary: figures of a run that is planned, allowed is none")
    with within(where):
        setting = run_of(campaign, table.model_copy(update={"file": ""}), number)
    setting = replace(setting, noise=campaign.noise)
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


def rows_of_run(campaign: Campaign, run: MeasuredRun) -> RunRows:
    """Rows along x."""
    return rows_of(smooth(thinned(run)), campaign.rig)
