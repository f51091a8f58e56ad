"""A run as a model would have it, as if it had been measured."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from stickslip.effects.candidate import OFFSETS

from cosim.gap.data import Campaign, MeasuredRun, Track, find_sticks
from cosim.gap.estimation.preparation import known_parameters, prepare
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import COLUMN, SegmentedRun
from cosim.gap.estimation.segments import Segment

from .member import Member, without_zero
from .range import Experiment, tracked

#: The block may move out by this part of the springs' installed length.
FARTHEST = 0.4


@dataclass(frozen=True)
class Setting:
    """What all rehearsals share: times (n,) s, channels, whether the block may leave its line."""

    campaign: Campaign
    time: np.ndarray
    channels: tuple[str, ...]
    planar: bool


def setting_of(campaign: Campaign, planar: bool) -> Setting:
    """Duration and sampling of the campaign's runs; channels that all of them have."""
    runs = tracked(campaign)
    duration = float(np.median([run.motion.duration for run in runs]))
    interval = float(np.median([run.motion.interval for run in runs]))
    time = interval * np.arange(int(round(duration / interval)) + 1)
    channels = tuple(
        name
        for name in COLUMN
        if all(name in run.motion.channels for run in runs) and campaign.noise.get(name)
    )
    return Setting(campaign, time, channels, planar)


def rehearse(
    setting: Setting, experiment: Experiment, values: Mapping[str, float]
) -> SegmentedRun | None:
    """A model's own motion in an experiment as a run; None where the rig cannot do it.

    It cannot where springs would be crushed or the model gives up.
    """
    run = _planned(setting, experiment)
    outputs = _simulated(setting, run, experiment, without_zero(values, OFFSETS))
    x = outputs[:, COLUMN["x"]]
    if not np.isfinite(x).all() or np.abs(x).max() > FARTHEST * setting.campaign.rig.spring_length:
        return None
    seen = {name: outputs[:, COLUMN[name]] for name in setting.channels}
    track = Track(setting.time, seen["x"], seen.get("y"), seen.get("phi"))
    sticks = find_sticks(track, run.surface_speed, run.natural_frequency, run.noise["x"])
    measured = _planned(setting, experiment, track, sticks)
    return prepare(setting.campaign, [measured], setting.planar)[0]


def _planned(setting: Setting, experiment: Experiment, track=None, sticks=()) -> MeasuredRun:
    first = tracked(setting.campaign)[0]
    return MeasuredRun(
        "next", None, experiment.mass, experiment.stiffness, experiment.surface_speed,
        first.ambient_degC, False, track, None,
        {name: setting.campaign.noise[name] for name in setting.channels}, sticks,
    )  # fmt: skip


def _simulated(setting: Setting, run: MeasuredRun, experiment: Experiment, values) -> np.ndarray:
    """Outputs (n, O_SIZE) from the experiment's start, places as the camera writes them."""
    state, since = np.zeros(8), np.nan
    if experiment.start == "carried":
        state[3], since = experiment.surface_speed, 0.0
    else:
        state[0] = experiment.pull
    known = known_parameters(setting.campaign, run, setting.planar)
    segment = Segment(0, len(setting.time), state, (), since)
    segmented = SegmentedRun(
        run.name, known, run.surface_speed, known["temperature_dependence.reference_degC"],
        setting.time, {}, {}, (segment,),
    )  # fmt: skip
    outputs = segmented.simulate(values, state[None, :])
    outputs[:, list(COLUMN.values())] = segmented.places(values, state[None, :])
    return outputs


def problem_of(segmented: SegmentedRun, member: Member) -> Problem:
    """A member's fit to somebody else's motion."""
    return Problem([segmented], member.free_parameters, dict(member.settings))
