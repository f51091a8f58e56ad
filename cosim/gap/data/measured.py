"""What a measured campaign is made of: tracks and runs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from stickslip.catalogue import CATALOGUE, Catalogue

from cosim.gap.data.campaign_file import Errors, Rig
from cosim.gap.data.friction_table import FrictionTable

#: Measured quantities, in the order in which they are looked at.
CHANNELS = ("x", "y", "phi", "force")
#: Standard deviation of the tracker's zero along x and y where the campaign states none, m.
ZERO = 5e-4


@dataclass(frozen=True, eq=False)
class Track:
    """What a tracker saw of one run.

    Attributes
    ----------
    time : (n,) array, s since the first row, strictly increasing; jitter and gaps as they are
    x, y, phi, force : (n,) arrays, m, m, rad, N; NaN is a missing sample or an outlier; None
        where the channel was not measured. force is what the springs pull the block back with along
        x, positive where x is; it is compared with their stiffness, the model is fitted to places
    time_offset : time of the first row in the file, s
    """

    time: np.ndarray = field(repr=False)
    x: np.ndarray = field(repr=False)
    y: np.ndarray | None = field(default=None, repr=False)
    phi: np.ndarray | None = field(default=None, repr=False)
    force: np.ndarray | None = field(default=None, repr=False)
    time_offset: float = 0.0

    def __getitem__(self, channel: str) -> np.ndarray:
        """Samples of a measured channel; KeyError for one that was not measured."""
        values = getattr(self, channel) if channel in CHANNELS else None
        if values is None:
            raise KeyError(channel)
        return np.asarray(values)

    @property
    def channels(self) -> tuple[str, ...]:
        """The channels that were measured."""
        return tuple(name for name in CHANNELS if getattr(self, name) is not None)

    def until(self, time: float) -> Track:
        """The rows up to a time, s."""
        return self._rows(slice(int(np.searchsorted(self.time, time, side="right"))))

    def since(self, time: float) -> Track:
        """The rows from a time on, s; the first of them is the first row then."""
        cut = self._rows(slice(int(np.searchsorted(self.time, time)), None))
        begin = float(cut.time[0])
        return replace(cut, time=cut.time - begin, time_offset=self.time_offset + begin)

    def _rows(self, rows: slice) -> Track:
        cut: dict[str, Any] = {name: self[name][rows] for name in self.channels}
        return replace(self, time=self.time[rows], **cut)

    @property
    def duration(self) -> float:
        """s"""
        return float(self.time[-1] - self.time[0])

    @property
    def interval(self) -> float:
        """Median time between two rows, s."""
        return float(np.median(np.diff(self.time)))


@dataclass(frozen=True, eq=False)
class MeasuredRun:
    """A run: how it was set up, and what was seen of it (a track, or figures alone).

    Attributes
    ----------
    mass : kg
    stiffness : of one of the four springs, N/m
    surface_speed : set-point, m/s
    ambient_degC : degC
    hold_out : never used for fitting
    track, summary : one of the two; summary is figure -> (value, standard deviation)
    noise : channel -> standard deviation of one sample of this run
    rounding : channel -> step of the numbers that are written (m) and factor by which `noise` is
        larger for it than stated, where the step is coarse
    """

    name: str
    file: Path | None
    mass: float
    stiffness: float
    surface_speed: float
    ambient_degC: float
    hold_out: bool
    track: Track | None = field(default=None, repr=False)
    summary: Mapping[str, tuple[float, float]] | None = None
    noise: Mapping[str, float] = field(default_factory=dict)
    rounding: Mapping[str, tuple[float, float]] = field(default_factory=dict)

    @property
    def motion(self) -> Track:
        """What the tracker saw; ValueError for a run of which only figures are known."""
        if self.track is None:
            raise ValueError(f"{self.name}: only figures are known of this run, it has no track")
        return self.track

    @property
    def total_stiffness(self) -> float:
        """Of the four springs along x, N/m."""
        return 4.0 * self.stiffness

    @property
    def natural_frequency(self) -> float:
        """omega = sqrt(4 k / m), rad/s."""
        return math.sqrt(self.total_stiffness / self.mass)

    @property
    def operating_point(self) -> tuple[float, float, float, float]:
        """Speed, mass, stiffness, ambient temperature."""
        return self.surface_speed, self.mass, self.stiffness, self.ambient_degC


@dataclass(frozen=True)
class Campaign:
    """Everything that is known of some runs on one rig.

    Attributes
    ----------
    path : the folder
    scheme : "exact" or "study", where the workflow starts
    noise : channel -> standard deviation of a sample, over all runs; that of a run is in the run
    noise_estimated : channels whose noise is not given, but taken from the data
    remarks : what the reader should know, a line each
    friction : coefficient -> (value, standard deviation), of those that are known beforehand
    errors : how well the file's other numbers are known
    friction_table : kinetic friction over the sliding speed that the model sets out from, if any
    limits : surface_speed (m/s), mass (kg), stiffness (N/m) -> (low, high), of those that are
        stated: a next run is asked for within them
    catalogue : effects that are tried, those of the file's own among them
    """

    name: str
    path: Path
    rig: Rig
    scheme: str
    noise: Mapping[str, float]
    noise_estimated: tuple[str, ...]
    runs: tuple[MeasuredRun, ...]
    remarks: tuple[str, ...] = ()
    friction: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    errors: Errors = field(default_factory=Errors)
    friction_table: FrictionTable | None = None
    limits: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    catalogue: Catalogue = CATALOGUE

    @property
    def known_friction(self) -> dict[str, tuple[float, float]]:
        """coefficient -> (value, standard deviation), the level of a table among them as mu_k."""
        if self.friction_table is None:
            return dict(self.friction)
        level = self.friction_table.level
        return {**self.friction, "mu_k": (level, self.errors.friction_table * level)}

    def zero_sd(self, run: MeasuredRun, channel: str = "x") -> float:
        """Standard deviation of the tracker's zero in a run, in the channel's unit."""
        if channel in ("x", "y") and "zero" not in self.errors.model_fields_set:
            return ZERO
        return self.errors.zero * run.noise[channel]

    @property
    def fit_runs(self) -> tuple[MeasuredRun, ...]:
        """Runs that parameters may be fitted to."""
        return tuple(run for run in self.runs if not run.hold_out)

    @property
    def held_out_runs(self) -> tuple[MeasuredRun, ...]:
        """Runs that are for judging alone."""
        return tuple(run for run in self.runs if run.hold_out)

    @property
    def setups(self) -> list[tuple[float, float]]:
        """Mass and stiffness of the springs: every pair that a run was made with."""
        return sorted({(run.mass, run.stiffness) for run in self.runs})

    def setup_of(self, run: MeasuredRun) -> int:
        """Number of a run's set-up; one that no run of the campaign has comes after all."""
        pair, setups = (run.mass, run.stiffness), self.setups
        return setups.index(pair) if pair in setups else len(setups)

    def parameters(self, run: MeasuredRun) -> dict[str, dict[str, Any]]:
        """What is known of a run, as tables of `stickslip.Parameters`; the rest is for the fit.

        A slab's curvature is known: `Parameters` takes it from rig.slab_radius.
        """
        return {
            "rig": self.rig.model_dump() | {"mass": run.mass},
            "springs": {"stiffness": run.stiffness},
            "surface": {"speed": run.surface_speed},
        }
