"""Fits in segments as fitted models: the motion, the start and the residual of every run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from stickslip.effects.candidate import OFFSETS
from stickslip.kernel import layout

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.diagnostics.model_track import tracks_of
from cosim.gap.estimation.fitted import Fitted
from cosim.gap.estimation.problem import Problem
from cosim.gap.result import FittedModel, FittedRun

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
    runs = {
        run.name: run
        for problem, fitted in parts
        for run in _runs(problem, fitted, [by_name[f.name] for f in problem.segmented_runs])
    }
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
        gap=(fitted.rms_residual(), _held_out(parts)),
    )


def _held_out(parts: Sequence[tuple[Problem, Fitted]]) -> float:
    """Root mean square residual over all held-out runs; that of the fit where none is held out."""
    rows = [r for _, fitted in parts[1:] for r in fitted.residuals] or list(parts[0][1].residuals)
    return float(np.sqrt(sum(r @ r for r in rows) / sum(r.size for r in rows)))


def _runs(problem: Problem, fitted: Fitted, runs: Sequence[MeasuredRun]) -> list[FittedRun]:
    tracks = tracks_of(problem, fitted, runs)
    return [
        FittedRun(track, _start(problem, fitted, i), fitted.rms_residual([i]), fitted.own_values(i))
        for i, track in enumerate(tracks)
    ]


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
    return x, y, phi, vx, vy, omega
