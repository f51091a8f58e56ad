"""Model tracks of a fit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from stickslip.effects.candidate import OFFSETS
from stickslip.kernel import layout

from cosim.gap.atlas.model_track import ModelTrack
from cosim.gap.read import MeasuredRun
from cosim.gap.shooting.fitted import Fitted
from cosim.gap.shooting.problem import Problem


def tracks_of(problem: Problem, fitted: Fitted, runs: Sequence[MeasuredRun]) -> list[ModelTrack]:
    """The fitted model's motion in each run of a problem, in their order."""
    return [_track(problem, fitted, number, run) for number, run in enumerate(runs)]


def _track(problem: Problem, fitted: Fitted, number: int, run: MeasuredRun) -> ModelTrack:
    flight = problem.flights[number]
    values = problem.settings | fitted.values | fitted.own_values(number)
    offsets = {key: values.pop(key) for key in OFFSETS if key in values}
    states = fitted.point.states[number].copy()
    for axis, key in enumerate(OFFSETS):  # states are measured ones: with the tracker's zero
        states[:, axis] -= offsets.get(key, 0.0)
    outputs = flight.fly(values, states)
    window = np.zeros(len(flight.time), dtype=int)
    for place, piece in enumerate(flight.windows):
        window[piece.first : piece.last] = place
    return ModelTrack(
        run,
        x=outputs[:, layout.O_X] + offsets.get("offset.x", 0.0),
        vx=outputs[:, layout.O_VX],
        mode=outputs[:, layout.O_MODE],
        y=outputs[:, layout.O_Y] + offsets.get("offset.y", 0.0) if "y" in flight.channels else None,
        phi=outputs[:, layout.O_PHI] if "phi" in flight.channels else None,
        window=window,
    )
