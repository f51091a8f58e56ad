"""Numbers fitted to the runs for fitting, and judged by those held out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import inf

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun

from .fitted import Fitted, Leeway, joined
from .numbers import Number
from .problem import IN_STEP, Problem
from .windows import Windows

#: Friction from which held-out runs set out beside none of their own, in standard deviations: more
#: friction beside a wrong zero is nearly as good. And the gap of fitted runs up to which the
#: model is near enough for that to matter.
ASIDE, NEAR_ENOUGH = (-0.75, 0.75), 2.0
#: Squares, in those of a model that the numbers hold, from which a start seldom leads back.
HOPELESS = 2.0
#: Of friction along the surface.
WAVE_LENGTH = "surface_pattern.wavelength"


def fit(
    campaign: Campaign, windows: Mapping[str, Windows], numbers: Sequence[Number],
    settings: Mapping[str, float] | None = None, scatter: float = 0.0,
    starts: Sequence[Mapping[str, float]] = (), near: Fitted | None = None, jobs: int = 2,
) -> Fitted:  # fmt: skip
    """Numbers that minimise the squared residuals over the windows of the runs for fitting.

    Minimises sum(((model - data) / noise)^2) + sum(((value - start) / prior)^2); held-out runs are
    then judged as by `judge`.

    windows : run's name -> windows, as of `windows_of_campaign`; settings : key or label -> value
    of what else of the model is not at its default; scatter : see `judge`; starts : labels ->
    values to set out from, of which the best is followed; other numbers are at their own starts
    near : a model that these numbers hold, whose start states are near; jobs : runs simulated at a
    time
    """
    settings = dict(settings or {})
    runs = [run for run in campaign.fit_runs if run.name in windows]
    states = {run.name: run.states for run in near.runs} if near else {}
    hopeless = HOPELESS * (near.cost - near.held_out_cost) if near else inf
    problem = Problem(
        campaign, runs, windows, numbers, settings, near=states, jobs=jobs, hopeless=hopeless
    )
    fitted = problem.solved(starts)
    held_out = [run for run in campaign.held_out_runs if run.name in windows]
    if not held_out:
        return fitted
    values = {**settings, **fitted.values}
    own = [_of_held_out(held_out, numbers, starts, fitted)]
    if scatter > 0.0 and fitted.gap[0] < NEAR_ENOUGH:
        own += [own[0] | {f"offset.friction@{run.name}": aside * scatter for run in held_out}
                for aside in ASIDE]  # fmt: skip
    judged = judge(
        campaign, windows, numbers, values, scatter, held_out, fitted.leeway, own, states, jobs
    )
    return joined(fitted, judged, [run.name for run in campaign.runs])


def _of_held_out(
    runs: Sequence[MeasuredRun], numbers: Sequence[Number],
    starts: Sequence[Mapping[str, float]], fitted: Fitted,
) -> dict[str, float]:  # fmt: skip
    """Where the held-out runs' own numbers set out.

    A longer wave on surfaces that are faster by as much is nearly the same: a set-point that does
    not follow a wave length would be off by whole waves at the end of a run.
    """
    start = {label: value for each in starts for label, value in each.items()}
    names = {run.name for run in runs}
    own = {label: one for label, one in start.items() if label.partition("@")[2] in names}
    for number in numbers:
        if number.key == WAVE_LENGTH:
            longer = fitted.values[number.key] / start.get(number.key, number.start) - 1.0
            speeds = [label for label in own if label.startswith("offset.speed@")]
            own |= {label: own[label] + longer for label in speeds}
    return own


def judge(
    campaign: Campaign, windows: Mapping[str, Windows], numbers: Sequence[Number],
    values: Mapping[str, float], scatter: float = 0.0, runs: Sequence[MeasuredRun] | None = None,
    leeway: Leeway | None = None, starts: Sequence[Mapping[str, float]] = (),
    near: Mapping[str, np.ndarray] | None = None, jobs: int = 2,
) -> Fitted:  # fmt: skip
    """How well given values describe some runs, those held out if not said.

    Free are the windows' start states and what no other run can tell: the tracker's zero, within
    its prior, phases, springs of a set-up that was not fitted, and friction if ``scatter``, its
    relative standard deviation from run to run, is not 0; the surface's speed, within its stated
    error, where that is a number of the fit's. With a ``leeway`` the numbers that all runs share
    may move within the errors of their fit, too: what the fitted runs do not determine they do not
    predict.
    """
    own = [number for number in numbers if number.scope == "run" or leeway is not None]
    if scatter > 0.0 and all(number.key != "offset.friction" for number in own):
        own.append(Number("offset.friction", 0.0, scatter, -1.0, 1.0, "run"))
    runs = campaign.held_out_runs if runs is None else runs
    runs = [run for run in runs if run.name in windows]
    found: list[Fitted] = []
    for start in starts or [{}]:
        problem = Problem(campaign, runs, windows, own, values, leeway, near, jobs)
        found.append(problem.solved([start]))
        if all(run.gap < IN_STEP for run in found[-1].runs):
            break
    best = min(found, key=lambda fitted: fitted.cost)
    return replace(best, simulated=sum(fitted.simulated for fitted in found))
