"""Fits in segments as fitted models: the motion, the start and the residual of every run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from stickslip.effects.candidate import OFFSETS
from stickslip.kernel import layout

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.diagnostics.model_track import tracks_of
from cosim.gap.estimation.fitted import Fitted
from cosim.gap.estimation.intervals import undetermined
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segments import FRICTION
from cosim.gap.result import FittedModel, FittedRun

#: Steps of a free parameter within which it is at its bound.
_NEAR = 1e-3
_STATE = (layout.O_X, layout.O_Y, layout.O_PHI, layout.O_VX, layout.O_VY, layout.O_OMEGA)


def fitted_model(
    campaign: Campaign,
    parts: Sequence[tuple[Problem, Fitted]],
    intervals: Mapping[str, tuple[float, float]] | None = None,
) -> FittedModel:
    """A model from its fits: the first part is that of the runs for fitting, others are held out.

    The runs of every problem carry the names of the campaign's runs.
    """
    by_name = {run.name: run for run in campaign.runs}
    by_part = [
        _runs(problem, fitted, [by_name[each.name] for each in problem.segmented_runs])
        for problem, fitted in parts
    ]
    runs = {run.name: run for part in by_part for run in part}
    problem, fitted = parts[0]
    free = problem.segmented_runs[0].known
    return FittedModel(
        values=fitted.values,
        settings=dict(problem.settings),
        intervals=dict(intervals or {}),
        degrees_of_freedom=tuple(
            name for name in ("x", "y", "phi") if free.get(f"rig.free_{name}", 1.0)
        ),
        runs=tuple(runs[name] for name in by_name if name in runs),
        gap=(_gap(by_part[0]), _gap(by_part[-1])),
        at_bound=_at_bound(problem, fitted),
        undetermined=undetermined(problem.shared, intervals or {}),
    )


def _at_bound(problem: Problem, fitted: Fitted) -> dict[str, float]:
    """Numbers that a fit left at a bound, on the scale of the fit to `_NEAR` of a step.

    Where a strength may not change its sign, nothing is no bound but the plain model.
    """
    found = {}
    for free in problem.shared:
        for bound in (free.low, free.high):
            near = abs(free.scaled(fitted.values[free.key]) - free.scaled(bound)) < _NEAR
            if near and (bound != 0.0 or not free.is_strength):
                found[free.key] = bound
    return found


def _gap(runs: Sequence[FittedRun]) -> float:
    """Root mean square residual over some runs; one that the model lost counts as far off."""
    rows = np.concatenate([run.track.misfit() for run in runs])
    return float(np.sqrt(np.mean(rows**2)))


def _runs(problem: Problem, fitted: Fitted, runs: Sequence[MeasuredRun]) -> list[FittedRun]:
    found = []
    for i, track in enumerate(tracks_of(problem, fitted, runs)):
        misfit = track.misfit()
        both, static = np.exp(fitted.point.states[i][0, list(FRICTION)])
        found.append(
            FittedRun(
                track,
                _start(problem, fitted, i),
                float(np.sqrt(np.mean(misfit**2))),
                fitted.own_values(i),
                problem.segmented_runs[i].setup,
                (float(both * static), float(both)),
            )
        )
    return found


def _start(
    problem: Problem, fitted: Fitted, run: int
) -> tuple[float, float, float, float, float, float]:
    """The model's own state at the first sample; in a stick its velocity is the surface's."""
    values = problem.settings | fitted.values | fitted.own_values(run)
    states = fitted.point.states[run].copy()
    for axis, key in enumerate(OFFSETS):  # states are measured ones: with the tracker's zero
        states[:, axis] -= values.pop(key, 0.0)
    first = problem.segmented_runs[run].simulate(values, states)[0]
    x, y, phi, vx, vy, omega = (float(first[column]) for column in _STATE)
    known = problem.segmented_runs[run].known  # a tracker sees some motion along a guide, too
    vy *= known.get("rig.free_y", 1.0)
    omega *= known.get("rig.free_phi", 1.0)
    return x, y, phi, vx, vy, omega
