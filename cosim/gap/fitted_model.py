"""Fits in windows as fitted models: the motion, the start and the gap of every run."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from stickslip.effects.candidate import OFFSETS
from stickslip.kernel import layout

from cosim.gap.atlas.from_fit import tracks_of
from cosim.gap.read import Campaign, MeasuredRun
from cosim.gap.result import FittedModel, FittedRun
from cosim.gap.shooting.fitted import Fitted
from cosim.gap.shooting.problem import Problem

_STATE = (layout.O_X, layout.O_Y, layout.O_PHI, layout.O_VX, layout.O_VY, layout.O_OMEGA)


def fitted_model(
    campaign: Campaign,
    parts: Sequence[tuple[Problem, Fitted]],
    intervals: Mapping[str, tuple[float, float]] | None = None,
) -> FittedModel:
    """A model from its fits: the first part is that of the runs for fitting, others are held out.

    Every problem's flights carry the names of the campaign's runs.
    """
    by_name = {run.name: run for run in campaign.runs}
    runs = {
        run.name: run
        for problem, fitted in parts
        for run in _runs(problem, fitted, [by_name[f.name] for f in problem.flights])
    }
    problem, fitted = parts[0]
    free = problem.flights[0].known
    return FittedModel(
        values=fitted.values,
        settings=dict(problem.settings),
        intervals=dict(intervals or {}),
        degrees_of_freedom=tuple(
            name for name in ("x", "y", "phi") if free.get(f"rig.free_{name}", 1.0)
        ),
        runs=tuple(runs[name] for name in by_name if name in runs),
        gap=(fitted.gap(), _held_out(parts)),
    )


def _held_out(parts: Sequence[tuple[Problem, Fitted]]) -> float:
    """Gap over all held-out runs; that of the fit where none is held out."""
    rows = [r for _, fitted in parts[1:] for r in fitted.residuals] or list(parts[0][1].residuals)
    return float(np.sqrt(sum(r @ r for r in rows) / sum(r.size for r in rows)))


def _runs(problem: Problem, fitted: Fitted, runs: Sequence[MeasuredRun]) -> list[FittedRun]:
    tracks = tracks_of(problem, fitted, runs)
    return [
        FittedRun(track, _start(problem, fitted, i), fitted.gap([i]), fitted.own_values(i))
        for i, track in enumerate(tracks)
    ]


def _start(problem: Problem, fitted: Fitted, run: int) -> tuple[float, ...]:
    """The model's own state at the first sample; in a stick its velocity is the surface's."""
    values = problem.settings | fitted.values | fitted.own_values(run)
    states = fitted.point.states[run].copy()
    for axis, key in enumerate(OFFSETS):  # states are measured ones: with the tracker's zero
        states[:, axis] -= values.pop(key, 0.0)
    first = problem.flights[run].fly(values, states)[0]
    return tuple(float(first[column]) for column in _STATE)
