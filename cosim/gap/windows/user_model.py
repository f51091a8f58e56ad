"""The model as its user states it: ideal dry friction, exact springs, a steady even surface."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np
from stickslip.packing import GRAVITY

from cosim.gap.data import Campaign, MeasuredRun

from .numbers import Number
from .sticks import sticks_of
from .windows import moves_across

#: Bounds of a friction coefficient that nobody has measured, in parts of its first guess.
FRICTION_RANGE = (0.1, 10.0)
#: Standard deviations within which a stated number stays: an effect that is missing would else pull
#: it anywhere, since its rows are few beside thousands of samples.
STATED_RANGE = 3.0
#: Least difference of the two coefficients at the start, part of mu_k: with less nothing sticks.
LEAST_EXCESS = 0.05
#: Part of a run in stick above which nothing slips: noise hides the ends of a stick.
ALL_STICK = 0.9
#: The study's scheme as far as the model has it: one spring of four counts in stick.
STUDY = {"stick_stiffness.ratio": 0.25}


def user_model(campaign: Campaign) -> tuple[list[Number], dict[str, float]]:
    """Numbers and settings of the plain model: mu_s, mu_k, stiffness per set-up, tracker's zeros.

    Coefficients that the campaign states are held by their stated errors; a table of friction is
    taken as the law, and mu_k is its value at the mean surface speed. A coefficient that no motion
    depends on is set, not fitted: mu_s where nothing sticks, mu_k where nothing slips.
    """
    runs = [run for run in campaign.fit_runs if run.track is not None]
    everywhere = [run for run in campaign.runs if run.track is not None]
    settings = dict(STUDY) if campaign.scheme == "study" else {}
    table = campaign.friction_table
    if table is not None:
        for i, (speed, part) in enumerate(zip(table.speeds, table.parts, strict=True), 1):
            settings[f"friction.table_speed[{i}]"] = float(speed)
            settings[f"friction.table_part[{i}]"] = float(part)
    numbers = []
    sticks = any(breaks_away(run) or run.rounding for run in runs)  # coarse steps hide sticks
    slips = any(not never_slips(run) for run in runs)
    for name, guess in zip(("mu_s", "mu_k"), friction_guess(runs), strict=True):
        key = f"friction.{name}"
        value, sd = campaign.known_friction.get(name, (guess, None))
        if not (sticks if name == "mu_s" else slips):
            settings[key] = value
        elif sd is None:
            low, high = (part * guess for part in FRICTION_RANGE)
            numbers.append(Number(key, guess, None, low, high))
        else:
            numbers.append(_stated(key, value, sd))
    numbers.append(_stated("offset.stiffness", 0.0, campaign.errors.stiffness, "setup"))
    return [*numbers, *_zeros(campaign, everywhere)], settings


def _zeros(campaign: Campaign, runs: Sequence[MeasuredRun]) -> list[Number]:
    """The tracker's zero in each run, along x and, where the block moves across, along y."""
    numbers = []
    for channel in ("x", "y") if moves_across(campaign) else ("x",):
        there = [run for run in runs if channel in run.motion.channels]
        if there:
            sd = float(np.median([campaign.zero_sd(run, channel) for run in there]))
            numbers.append(_stated(f"offset.{channel}", 0.0, sd, "run"))
    return numbers


def _stated(
    key: str, value: float, sd: float, scope: Literal["campaign", "run", "setup"] = "campaign"
) -> Number:
    """A number that is known to a standard deviation."""
    low, high = value - STATED_RANGE * sd, value + STATED_RANGE * sd
    return Number(key, value, sd, low if value == 0.0 else max(low, 0.0), high, scope)


def breaks_away(run: MeasuredRun) -> bool:
    """Whether a stick is seen to begin and to end."""
    return any(np.isfinite(stick.start_sd + stick.end_sd) for stick in sticks_of(run))


def never_slips(run: MeasuredRun) -> bool:
    """Whether the block goes with the surface all the time."""
    sticks = sticks_of(run)
    if any(np.isfinite(stick.start_sd) for stick in sticks):
        return False
    return sum(stick.duration for stick in sticks) > ALL_STICK * run.motion.duration


def friction_guess(runs: Sequence[MeasuredRun]) -> tuple[float, float]:
    """mu_s from where sticks end, mu_k from about where the block swings.

    The springs balance friction there: mu = 4 k x / (m g). Where nothing sticks mu_s is just mu_k,
    the least that a contact holds; where nothing slips more than any load that was held.
    """
    holding, sliding, held = [], [], []
    for run in runs:
        mu = np.abs(run.total_stiffness * run.motion.x / (run.mass * GRAVITY))
        ends = [mu[s.last] for s in sticks_of(run) if np.isfinite(s.end_sd)]
        starts = [mu[s.first] for s in sticks_of(run) if np.isfinite(s.start_sd)]
        mean = float(np.nanmean(mu[mu.size // 4 :]))
        held.append(float(np.nanmax(mu)))
        if ends and starts:
            holding.append(float(np.nanmedian(ends)))
            mean = 0.5 * (holding[-1] + float(np.nanmedian(starts)))
        elif run.rounding:  # sticks are not seen between coarse steps
            holding.append(held[-1])
        sliding.append(mean)
    mu_k = max(float(np.median(sliding)), 1e-3)
    if runs and all(map(never_slips, runs)):
        return 2.0 * max(held), mu_k
    mu_s = float(np.median(holding)) if holding else mu_k
    return max(mu_s, (1.0 + LEAST_EXCESS * bool(holding)) * mu_k), mu_k
