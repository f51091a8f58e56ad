"""What a misfit may depend on, at every sample of a run."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import cumulative_trapezoid

from cosim.gap.atlas.model_track import ModelTrack

GRAVITY = 9.81


@dataclass(frozen=True)
class Variable:
    """``label`` as in a sentence, ``unit``, whether it has one value a run, and its scale."""

    label: str
    unit: str
    per_run: bool = False
    logarithmic: bool = False


VARIABLES = {
    "sliding_speed": Variable("the sliding speed", "m/s"),
    "position": Variable("the block's position", "m"),
    "time": Variable("the time in the run", "s"),
    "distance": Variable("the distance slid", "m"),
    "surface_position": Variable("the place on the surface", "m"),
    "hold_time": Variable("the hold time", "s", per_run=True, logarithmic=True),
    "load": Variable("the load", "N", per_run=True),
    "set_speed": Variable("the surface speed", "m/s", per_run=True),
    "time_phase": Variable("the time within a period", "periods"),
    "surface_phase": Variable("the place within a wavelength", "wavelengths"),
    "temperature": Variable("the ambient temperature", "degC", per_run=True),
}


def variables_of(track: ModelTrack) -> dict[str, np.ndarray]:
    """Variable -> (n,) values at the samples, but for phases; NaN where a variable has none.

    Speeds and positions are the model's, which has no noise. The hold time is one for the whole
    run, the median of its sticks: within a run a late break-away is a long stick by itself, and a
    slope of one against the other says nothing about the contact.
    """
    run, time = track.run, track.time
    sliding = np.abs(run.surface_speed - track.vx)
    holds = [s.duration for s in run.sticks if math.isfinite(s.start_sd + s.end_sd)]
    return {
        "sliding_speed": sliding,
        "position": track.x,
        "time": time - time[0],
        "distance": cumulative_trapezoid(sliding, time, initial=0.0),
        "surface_position": surface_position(track),
        "hold_time": np.full(len(time), np.median(holds) if holds else np.nan),
        "load": np.full(len(time), run.mass * GRAVITY),
        "set_speed": np.full(len(time), abs(run.surface_speed)),
        "temperature": np.full(len(time), run.ambient_degC),
    }


def surface_position(track: ModelTrack) -> np.ndarray:
    """(n,) place on the surface that is under the block, m from where it was at first."""
    run = track.run
    return run.surface_speed * (track.time - track.time[0]) - (track.x - track.x[0])
