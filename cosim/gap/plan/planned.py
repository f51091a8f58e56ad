"""A campaign that is only planned, as if it had been measured: on the plain model, without noise.

The runs are simulated, cut into the shooting segments that a fit would use, and differentiated
there. The data are the segments' own motion: at that point no residual is left, and what a law adds
to the motion is all that a fit of the plain model would see.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from pydantic import ValidationError
from stickslip import Parameters
from stickslip.effects.candidate import FreeParameter
from stickslip.packing import GRAVITY

from cosim.gap.candidates.plain import (
    CREEP,
    EXPONENT,
    TRANSITION,
    plain_free_parameters,
    plain_settings,
)
from cosim.gap.data import Campaign, MeasuredRun, Track, find_sticks
from cosim.gap.data.campaign_file import FILE_NAME, RunTable, read_tables
from cosim.gap.data.errors import CampaignError
from cosim.gap.data.friction_table import read_friction_table
from cosim.gap.data.units import COARSEST
from cosim.gap.doubts.sampling import least_rate, vibration_leak
from cosim.gap.estimation.columns import Columns
from cosim.gap.estimation.drive import LOADING
from cosim.gap.estimation.fit import fit
from cosim.gap.estimation.fitted import Point, start
from cosim.gap.estimation.preparation import known_parameters, prepare, thinned
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import COLUMN, SegmentedRun
from cosim.gap.estimation.segments import STATES, Segment
from cosim.scenario.faults import describe_faults

#: Ice on steel or ice at the temperatures and speeds of a cold room slides at about 0.1 (Marmo et
#: al. 2005); a usual break-away takes 1.3 times as much.
EXPECTED = {"mu_s": 0.13, "mu_k": 0.10}
#: Of a tracker that the file says nothing of, m.
NOISE = 2e-4
#: Samples of a run: one is a minute to the second, or an hour of a slow camera; more is a slip of
#: the pen.
_MOST_SAMPLES = 200_000
#: Rounds in which the segments' states, read off the motion, settle on it.
_SETTLE = 3


@dataclass(frozen=True)
class PlannedRun:
    """A run that is to be made: its setting, duration in s and rate in Hz."""

    setting: MeasuredRun
    duration: float
    rate: float

    @property
    def time(self) -> np.ndarray:
        """(n,) s, of the samples."""
        return np.arange(int(round(self.duration * self.rate)) + 1) / self.rate


@dataclass(frozen=True)
class PlannedCampaign:
    """What is to be measured.

    Attributes
    ----------
    campaign : rig, noise and what is known of the friction; its runs have no track
    runs : those that are to be fitted
    friction : coefficient -> value that is expected; mu_k of a table, whose level it is
    """

    campaign: Campaign
    runs: tuple[PlannedRun, ...]
    friction: Mapping[str, float]

    @property
    def settings(self) -> dict[str, float]:
        """What is set in every model: the campaign's own table of friction, if it has one."""
        return plain_settings(self.campaign)

    @property
    def planar(self) -> bool:
        """Whether the block would be seen leaving its line: y is measured and the rig allows it."""
        return "y" in self.campaign.noise and "y" in self.campaign.rig.degrees_of_freedom


@dataclass(frozen=True)
class Rehearsal:
    """A planned campaign as the plain model has it, with derivatives.

    Attributes
    ----------
    campaign : with tracks
    runs : cut into segments; the data are the model's own motion in them
    free_parameters : of the plain model
    point : where the model is at
    columns : of each run
    """

    campaign: Campaign
    runs: tuple[SegmentedRun, ...]
    free_parameters: tuple[FreeParameter, ...]
    point: Point
    columns: tuple[Columns, ...]

    @property
    def settings(self) -> dict[str, float]:
        """What is set in the plain model: the campaign's own table of friction, if it has one."""
        return plain_settings(self.campaign)

    @property
    def problem(self) -> Problem:
        """The plain model's fit to its own motion."""
        return Problem(self.runs, self.free_parameters, self.settings)

    @property
    def rows(self) -> int:
        """Residuals of all runs."""
        return sum(columns.residuals.size for columns in self.columns)


def read_plan(path: str | Path) -> PlannedCampaign:
    """The planned campaign in a TOML file, or in a folder's campaign.toml.

    Its keys are those of a measured campaign; of a run ``duration`` and ``rate`` take the place of
    a ``file``, which need not be there. CampaignError in one line: file, key, what is wrong, what
    is allowed.
    """
    path = Path(path)
    path = path / FILE_NAME if path.is_dir() else path
    table, tables = read_tables(path, RunTable)
    given = table.noise.given
    noise = {"x": NOISE, **{name: given[name] for name in COLUMN if name in given}}
    remarks = [] if "x" in given else [f"noise.x is not given: {NOISE:g} m"]
    own = read_friction_table(path, table, [run.surface_speed for run in tables])
    named = table.friction.expected
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
        raise CampaignError(
            f"{path}: friction: mu_s = {expected['mu_s']:g} is below mu_k = {expected['mu_k']:g}, "
            "allowed is as much or more"
        )
    campaign = Campaign(
        table.name, path.parent, table.rig, table.model.scheme, noise, (), (),
        friction=table.friction.given, errors=table.errors, friction_table=own,
    )  # fmt: skip
    _check_scheme(path, campaign)
    runs = [_planned(path, campaign, run, number) for number, run in enumerate(tables, 1)]
    fitted = tuple(run for run in runs if not run.setting.hold_out)
    if not fitted:
        raise CampaignError(
            f"{path}: hold_out: true in every run, there is nothing to fit; allowed is false in at "
            "least one"
        )
    if len(fitted) < len(runs):
        remarks.append(f"held out, and not counted: {len(runs) - len(fitted)} of {len(runs)} runs")
    remarks += _not_read(tables)
    remarks += _too_slow(runs, expected["mu_s"], noise["x"])
    settings = tuple(run.setting for run in runs)
    campaign = replace(campaign, runs=settings, remarks=tuple(remarks))
    return PlannedCampaign(campaign, fitted, expected)


def _not_read(tables: Sequence[RunTable]) -> list[str]:
    """Of files that are named: their length and rate are not those that are planned with."""
    taken = sorted({(table.duration, table.rate) for table in tables if table.file})
    if not taken:
        return []
    said = ", ".join(f"{duration:g} s at {rate:g} Hz" for duration, rate in taken)
    return [f"files of runs are not read: planned with duration and rate, {said}"]


def _too_slow(runs: Sequence[PlannedRun], mu_s: float, noise: float) -> list[str]:
    """Of runs whose noise could not be told from their motion, were it not given."""
    lines = []
    for run in runs:
        setting = run.setting
        swing = mu_s * setting.mass * GRAVITY / setting.total_stiffness
        wanted = least_rate(swing, setting.natural_frequency, noise)
        if vibration_leak(swing, setting.natural_frequency, 1.0 / run.rate) > noise:
            lines.append(
                f"{setting.name}: at {run.rate:g} Hz noise of {1e3 * noise:g} mm cannot be told "
                f"from the motion, expected are {wanted:.2g} Hz at least, or noise.x given once it "
                "is measured"
            )
    return lines


def _check_scheme(path: Path, campaign: Campaign) -> None:
    if campaign.scheme != "exact":
        raise CampaignError(
            f'{path}: model.scheme = "{campaign.scheme}": what a scheme lacks is no question to a '
            'rig, allowed is "exact"'
        )


def _planned(path: Path, campaign: Campaign, table: RunTable, number: int) -> PlannedRun:
    """One [[run]], checked against the rig."""
    where = f"{path}: run {number}"
    if table.summary.given:
        raise CampaignError(f"{where}: summary: figures of a run that is planned, allowed is none")
    setting = MeasuredRun(
        f"run {number}", None, table.mass, table.stiffness, table.surface_speed,
        table.ambient_degC, table.hold_out, noise=campaign.noise,
    )  # fmt: skip
    try:
        with warnings.catch_warnings(action="ignore"):
            Parameters.model_validate(campaign.parameters(setting), strict=True)
    except ValidationError as report:
        raise CampaignError(f"{where}: {describe_faults(report, Parameters)}") from None
    period = 2.0 * np.pi / setting.natural_frequency
    if table.rate * COARSEST * period < 1.0:
        raise CampaignError(
            f"{where}: rate = {table.rate:g} Hz, the block's free vibration takes {period:.3g} s; "
            f"allowed is at least {1.0 / (COARSEST * period):.3g} Hz"
        )
    if table.duration < 2.0 * period or table.duration * table.rate > _MOST_SAMPLES:
        raise CampaignError(
            f"{where}: duration = {table.duration:g} s, allowed is {2.0 * period:.3g} s (two free "
            f"vibrations) to {_MOST_SAMPLES / table.rate:.4g} s ({_MOST_SAMPLES} samples)"
        )
    return PlannedRun(setting, table.duration, table.rate)


#: How a contact gives way: known of a rehearsal, whose contact is a switch. What a fit of it takes
#: up besides is far from linear, and makes the sizes larger than the least that noise allows.
_CONTACT = (TRANSITION, EXPONENT, CREEP, LOADING)


def rehearse_plan(plan: PlannedCampaign) -> Rehearsal:
    """The planned runs on the plain model with the friction that is expected."""
    friction = {f"friction.{key}": value for key, value in plan.friction.items()}
    first = _with_tracks(plan, [_tracked(plan, run, (), friction) for run in plan.runs])
    # numbers of the plain model that a fit has to find are what it would start from; only the
    # friction is given
    free_parameters = tuple(
        _centred(free, friction)
        for free in plain_free_parameters(first, plan.planar)
        if free.key not in _CONTACT
    )
    tracked = [_tracked(plan, run, free_parameters, friction) for run in plan.runs]
    return _differentiated(_with_tracks(plan, tracked), plan.planar, free_parameters)


def rehearse_run(
    plan: PlannedCampaign, run: PlannedRun, free_parameters: Sequence[FreeParameter]
) -> Rehearsal:
    """One more run on the same model: a campaign of that run alone."""
    campaign = _with_tracks(plan, [_tracked(plan, run, free_parameters, {})])
    return _differentiated(campaign, plan.planar, tuple(free_parameters))


def _centred(free: FreeParameter, friction: Mapping[str, float]) -> FreeParameter:
    """Starting at what is expected, which lies in its range."""
    start = friction.get(free.key, free.start)
    return replace(free, start=start, low=min(free.low, start), high=max(free.high, start))


def _with_tracks(plan: PlannedCampaign, runs: Sequence[MeasuredRun]) -> Campaign:
    return replace(plan.campaign, runs=tuple(runs))


def _tracked(
    plan: PlannedCampaign,
    run: PlannedRun,
    free_parameters: Sequence[FreeParameter],
    settings: Mapping[str, float],
) -> MeasuredRun:
    """The run with its motion: laid on the running surface with slack springs, carried along."""
    outputs = motion(plan, run, free_parameters, settings)
    seen = {name: outputs[:, COLUMN[name]] for name in plan.campaign.noise}
    track = Track(run.time, seen["x"], seen.get("y"), seen.get("phi"))
    setting = run.setting
    if not np.isfinite(track.x).all():
        raise CampaignError(
            f"{plan.campaign.name}: {setting.name}: the plain model cannot follow its motion, "
            "allowed are springs, mass and speed for which it can"
        )
    sticks = find_sticks(
        track, setting.surface_speed, setting.natural_frequency, setting.noise["x"]
    )
    return thinned(replace(setting, track=track, sticks=sticks))


def motion(
    plan: PlannedCampaign,
    run: PlannedRun,
    free_parameters: Sequence[FreeParameter] = (),
    settings: Mapping[str, float] | None = None,
) -> np.ndarray:
    """The model's outputs (n, O_SIZE) in a run, free parameters at their starts."""
    free_parameters = [free for free in free_parameters if free.key not in (settings or {})]
    known = known_parameters(plan.campaign, run.setting, plan.planar)
    state = np.zeros(STATES)
    state[3] = run.setting.surface_speed
    whole = SegmentedRun(
        run.setting.name, known, run.setting.surface_speed,
        known["temperature_dependence.reference_degC"], run.time, {}, {},
        (Segment(0, run.time.size, state, (), 0.0),),
    )  # fmt: skip
    at = start([whole], free_parameters)
    problem = Problem([whole], free_parameters, {**plan.settings, **(settings or {})})
    return problem.simulated(0, at.shared, at.own[0], state[None, :])[0]


def _differentiated(
    campaign: Campaign, planar: bool, free_parameters: tuple[FreeParameter, ...]
) -> Rehearsal:
    """Segments that start from the motion's own states, and derivatives there."""
    segmented = prepare(campaign, campaign.runs, planar)
    point = start(segmented, free_parameters)
    settings = plain_settings(campaign)
    problem = Problem(segmented, free_parameters, settings)
    point = fit(problem, point, _SETTLE, fixed=True).point
    point = replace(start(segmented, free_parameters), states=point.states)
    runs = tuple(own_data(problem, i, point) for i in range(len(segmented)))
    problem = Problem(runs, free_parameters, settings)
    columns = tuple(
        problem.columns(i, point, rows, range(point.shared.size))
        for i, rows in enumerate(problem.all_residuals(point))
    )
    return Rehearsal(campaign, runs, free_parameters, point, columns)


def own_data(problem: Problem, run: int, point: Point) -> SegmentedRun:
    """A run whose data are what the model does in its segments."""
    outputs, offsets = problem.simulated(run, point.shared, point.own[run], point.states[run])
    segmented = problem.segmented_runs[run]
    channels = {
        name: outputs[:, COLUMN[name]] + offsets.get(f"offset.{name}", 0.0)
        for name in segmented.channels
    }
    return replace(segmented, channels=channels)
