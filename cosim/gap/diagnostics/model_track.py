"""What a fitted model makes of a run, beside what was measured."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from stickslip.effects.candidate import OFFSETS
from stickslip.kernel import layout

from cosim.gap.data import MeasuredRun, Stick, find_sticks
from cosim.gap.data.measured import Track
from cosim.gap.estimation.fitted import Fitted
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import COLUMN, LOST

STICK, SLIP = 0.0, 1.0


@dataclass(frozen=True)
class ModelTrack:
    """A model's motion at the times of a run's samples.

    Attributes
    ----------
    run : what was measured
    x, vx : (n,) arrays, m, m/s; x as the tracker writes it, its zero and faults included
    mode : (n,) array, 0 stick, 1 slip
    y, phi : (n,) arrays, m, rad, or None where they are not compared
    segment : (n,) array of whole numbers: the model starts anew where it changes
    """

    run: MeasuredRun
    x: np.ndarray = field(repr=False)
    vx: np.ndarray = field(repr=False)
    mode: np.ndarray = field(repr=False)
    y: np.ndarray | None = field(default=None, repr=False)
    phi: np.ndarray | None = field(default=None, repr=False)
    segment: np.ndarray | None = field(default=None, repr=False)

    @property
    def time(self) -> np.ndarray:
        """(n,) s"""
        return self.run.motion.time

    @property
    def channels(self) -> tuple[str, ...]:
        """Channels that are both measured and modelled."""
        return tuple(
            name
            for name in ("x", "y", "phi")
            if name in self.run.motion.channels and getattr(self, name) is not None
        )

    def residual(self, channel: str) -> np.ndarray:
        """(n,) measured less modelled, in units of the noise; NaN where nothing was measured."""
        return (self.run.motion[channel] - getattr(self, channel)) / self.run.noise[channel]

    def misfit(self) -> np.ndarray:
        """(r,) residuals of all channels where something was measured; far off where lost."""
        rows = [self.residual(name)[np.isfinite(self.run.motion[name])] for name in self.channels]
        return np.clip(np.nan_to_num(np.concatenate(rows), nan=LOST), -LOST, LOST)

    @cached_property
    def segments(self) -> np.ndarray:
        """(n,) number of the stretch between two starts of the model."""
        return np.zeros(len(self.time), dtype=int) if self.segment is None else self.segment

    @cached_property
    def model_sticks(self) -> tuple[Stick, ...]:
        """Sticks of the model, found as those of the measurement are, but followed over gaps."""
        run = self.run
        track, speed, omega = Track(self.time, self.x), run.surface_speed, run.natural_frequency
        return find_sticks(track, speed, omega, run.noise["x"], gap=math.inf)

    @cached_property
    def measured_mode(self) -> np.ndarray:
        """(n,) 0 stick, 1 slip, NaN where a corner lies within its error of the sample."""
        mode = np.full(len(self.time), SLIP)
        for stick in self.run.sticks:
            inside = (self.time >= stick.start) & (self.time <= stick.end)
            mode[inside] = STICK
            for at, sd in ((stick.start, stick.start_sd), (stick.end, stick.end_sd)):
                if math.isfinite(sd):
                    mode[np.abs(self.time - at) <= 2.0 * sd] = np.nan
        return mode

    def stretches(self, mode: float, samples: int) -> list[np.ndarray]:
        """Indices of each stretch in which model and measurement are both in ``mode``.

        Only those of at least so many samples of x; none crosses a start of the model.
        """
        both = (self.mode == mode) & (self.measured_mode == mode)
        edges = np.flatnonzero((np.diff(both.astype(int)) != 0) | (np.diff(self.segments) != 0)) + 1
        parts = np.split(np.arange(len(both)), edges)
        seen = np.isfinite(self.run.motion.x)
        parts = [part[seen[part]] for part in parts if both[part[0]]]
        return [part for part in parts if len(part) >= samples]


def tracks_of(problem: Problem, fitted: Fitted, runs: Sequence[MeasuredRun]) -> list[ModelTrack]:
    """The fitted model's motion in each run of a problem, in their order."""
    return [_track(problem, fitted, number, run) for number, run in enumerate(runs)]


def _track(problem: Problem, fitted: Fitted, number: int, run: MeasuredRun) -> ModelTrack:
    segmented = problem.segmented_runs[number]
    values = problem.settings | fitted.values | fitted.own_values(number)
    offsets = {key: values.pop(key) for key in OFFSETS if key in values}
    states = fitted.point.states[number].copy()
    for axis, key in enumerate(OFFSETS):  # states are measured ones: with the tracker's zero
        states[:, axis] -= offsets.get(key, 0.0)
    outputs = segmented.simulate(values, states)
    places = segmented.places(values, states)  # what a camera makes of them
    segment = np.zeros(len(segmented.time), dtype=int)
    for place, piece in enumerate(segmented.segments):
        segment[piece.first : piece.last] = place
    return ModelTrack(
        run,
        x=places[:, COLUMN["x"]] + offsets.get("offset.x", 0.0),
        vx=outputs[:, layout.O_VX],
        mode=outputs[:, layout.O_MODE],
        y=places[:, COLUMN["y"]] + offsets.get("offset.y", 0.0)
        if "y" in segmented.channels
        else None,
        phi=places[:, COLUMN["phi"]] if "phi" in segmented.channels else None,
        segment=segment,
    )
