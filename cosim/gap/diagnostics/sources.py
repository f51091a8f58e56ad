"""Misfits of each channel and regime, ready for least squares over bins of any variable."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from cosim.gap.data import Stick
from cosim.gap.diagnostics.model_track import SLIP, STICK, ModelTrack
from cosim.gap.diagnostics.response import (
    Normal,
    Stretch,
    slip_stretch,
    stick_stretch,
)


@dataclass(frozen=True)
class Points:
    """Misfits that were seen one by one in a run: (m,) values and errors, indices of samples."""

    track: int
    rows: np.ndarray
    values: np.ndarray
    errors: np.ndarray

    def normal(self, inputs: np.ndarray, level: bool = False) -> Normal:
        """Normal equations of inputs (m, b) at its samples; points have no level of their own."""
        columns = inputs / self.errors[:, None]
        scaled = self.values / self.errors
        return Normal(columns.T @ columns, columns.T @ scaled, float(scaled @ scaled), len(scaled))


@dataclass(frozen=True)
class Source:
    """Where a region's misfit is read from.

    Attributes
    ----------
    channel, regime, quantity, unit : what it is
    pieces : stretches of a run, or the points of a run
    unsuited : variables that say nothing here
    """

    channel: str
    regime: str
    quantity: str
    unit: str
    pieces: Sequence[Stretch | Points] = field(repr=False)
    unsuited: tuple[str, ...] = ()

    @property
    def tracks(self) -> np.ndarray:
        """(p,) number of the run of each piece."""
        return np.array([piece.track for piece in self.pieces], dtype=int)

    def normals(
        self, inputs: Callable[[Stretch | Points], np.ndarray], level: bool = False
    ) -> list[Normal]:
        """Normal equations of each piece, for inputs (n, b) at its samples.

        level : of a stretch, only what changes within it counts
        """
        return [piece.normal(inputs(piece), level) for piece in self.pieces]

    def at_samples(self, variables: Sequence[Mapping[str, np.ndarray]], name: str) -> np.ndarray:
        """Values of a variable at all samples of the pieces."""
        parts = [variables[piece.track][name][piece.rows] for piece in self.pieces]
        return np.concatenate([np.empty(0), *parts])


#: Fewest samples of a stretch, and its longest part of a natural period where means are taken.
FEWEST, PART = 6, 0.25
UNITS = {"y": "m", "phi": "rad"}
AT_REST = ("sliding_speed",)


def sources(tracks: Sequence[ModelTrack]) -> list[Source]:
    """All channels and regimes of which there is anything to be seen."""
    every = [
        Source("x", "slip", "friction force", "N", _slips(tracks)),
        Source("x", "stick", "speed", "m/s", _sticks(tracks), AT_REST),
        _corners(tracks, "break-away", "end"),
        _corners(tracks, "re-stick", "start"),
    ]
    for channel in ("y", "phi"):
        for regime, mode in (("slip", SLIP), ("stick", STICK)):
            pieces = [
                _means(number, track, channel, mode)
                for number, track in enumerate(tracks)
                if channel in track.channels
            ]
            pieces = [piece for piece in pieces if len(piece.values)]
            unsuited = AT_REST if mode == STICK else ()
            every.append(Source(channel, regime, "position", UNITS[channel], pieces, unsuited))
    return [source for source in every if source.pieces]


def _slips(tracks: Sequence[ModelTrack]) -> list[Stretch]:
    found = []
    for number, track in enumerate(tracks):
        run, residual = track.run, track.residual("x")
        for rows in track.stretches(SLIP, FEWEST):
            found.append(
                slip_stretch(
                    number, rows, track.time[rows], residual[rows], run.noise["x"],
                    run.mass, run.natural_frequency,
                )
            )  # fmt: skip
    return found


def _sticks(tracks: Sequence[ModelTrack]) -> list[Stretch]:
    found = []
    for number, track in enumerate(tracks):
        residual = track.residual("x")
        for rows in track.stretches(STICK, FEWEST):
            time = track.time[rows]
            found.append(stick_stretch(number, rows, time, residual[rows], track.run.noise["x"]))
    return found


def _corners(tracks: Sequence[ModelTrack], regime: str, corner: str) -> Source:
    """Spring force at break-away (end of a stick) or re-stick (start), measured less modelled."""
    pieces = [_points_at_corners(number, track, corner) for number, track in enumerate(tracks)]
    pieces = [piece for piece in pieces if len(piece.values)]
    return Source("x", regime, "spring force", "N", pieces, (*AT_REST, "position"))


def _points_at_corners(number: int, track: ModelTrack, corner: str) -> Points:
    run = track.run
    rows, values, errors = [], [], []
    for measured, modelled in _matched(track):
        apart = _level(track, run.motion.x, measured, corner)
        apart -= _level(track, track.x, modelled, corner)
        if not math.isfinite(apart + _sd(measured, corner) + _sd(modelled, corner)):
            continue
        error = math.hypot(
            run.surface_speed * _sd(measured, corner),
            run.noise["x"] / math.sqrt(measured.last - measured.first + 1),
        )
        rows.append(measured.last if corner == "end" else measured.first)
        values.append(run.total_stiffness * apart)
        errors.append(run.total_stiffness * error)
    return Points(number, np.array(rows, dtype=int), np.array(values), np.array(errors))


def _sd(stick: Stick, corner: str) -> float:
    return stick.end_sd if corner == "end" else stick.start_sd


def _matched(track: ModelTrack) -> list[tuple[Stick, Stick]]:
    """Measured stick and the model's stick that it overlaps most, each one once."""
    pairs = []
    for measured in track.run.sticks:
        overlaps = [
            (min(measured.end, other.end) - max(measured.start, other.start), other)
            for other in track.model_sticks
        ]
        overlap, best = max(overlaps, key=lambda pair: pair[0], default=(0.0, None))
        if best is not None and overlap > 0.5 * max(measured.duration, best.duration):
            pairs.append((measured, best))
    return pairs


def _level(track: ModelTrack, x: np.ndarray, stick: Stick, corner: str) -> float:
    """x of a stick's line at its corner; NaN without a sample in it."""
    rows = np.arange(stick.first, stick.last + 1)
    rows = rows[np.isfinite(x[rows])]
    if not rows.size:
        return math.nan
    at = getattr(stick, corner)
    return float(np.mean(x[rows] - track.run.surface_speed * (track.time[rows] - at)))


def _means(number: int, track: ModelTrack, channel: str, mode: float) -> Points:
    """Mean residual of each short piece of a stretch."""
    run = track.run
    residual = track.residual(channel) * run.noise[channel]
    longest = PART * 2.0 * math.pi / run.natural_frequency
    rows, values, errors = [], [], []
    for stretch in track.stretches(mode, FEWEST):
        pieces = max(round((track.time[stretch[-1]] - track.time[stretch[0]]) / longest), 1)
        for piece in np.array_split(stretch, pieces):
            there = piece[np.isfinite(residual[piece])]
            if len(there):
                rows.append(there[len(there) // 2])
                values.append(float(np.mean(residual[there])))
                errors.append(run.noise[channel] / math.sqrt(len(there)))
    return Points(number, np.array(rows, dtype=int), np.array(values), np.array(errors))
