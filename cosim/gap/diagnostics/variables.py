"""What a misfit may depend on, at every sample of a run."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.integrate import cumulative_trapezoid
from scipy.signal import savgol_filter
from stickslip.packing import GRAVITY

from cosim.gap.diagnostics.model_track import ModelTrack

#: Part of the natural period over which the measured motion is smoothed.
SMOOTHED = 0.15


@dataclass(frozen=True)
class Variable:
    """A variable.

    Attributes
    ----------
    label : as in a sentence
    kind : "within" a run, one value "per run", or a "phase"
    follows : it follows the friction itself, as the block stands where friction and springs
        balance; only its changes within a slip then say anything
    """

    label: str
    unit: str
    kind: str = "within"
    logarithmic: bool = False
    follows: bool = False


VARIABLES = {
    "sliding_speed": Variable("the sliding speed", "m/s"),
    "position": Variable("the block's position", "m", follows=True),
    "time": Variable("the time in the run", "s"),
    "distance": Variable("the distance slid", "m"),
    "surface_position": Variable("the place on the surface", "m"),
    "hold_time": Variable("the hold time", "s", "per run", logarithmic=True),
    "load": Variable("the load", "N", "per run"),
    "set_speed": Variable("the surface speed", "m/s", "per run"),
    "time_phase": Variable("the time within a period", "periods", "phase"),
    "surface_phase": Variable("the place within a wavelength", "wavelengths", "phase"),
    "temperature": Variable("the ambient temperature", "degC", "per run"),
}


def variables_of(track: ModelTrack) -> dict[str, np.ndarray]:
    """Variable -> (n,) values at the samples, but for phases; NaN where a variable has none.

    Speeds and positions are the measured ones, smoothed: the model's may have drifted. The hold
    time is one for the whole run, the median of its sticks: within a run a late break-away is a
    long stick by itself, and a slope of one against the other says nothing about the contact.
    """
    run, time = track.run, track.time
    x, velocity = smoothed(track)
    sliding = np.abs(run.surface_speed - velocity)
    holds = [s.duration for s in run.sticks if math.isfinite(s.start_sd + s.end_sd)]
    return {
        "sliding_speed": sliding,
        "position": x,
        "time": time - time[0],
        "distance": cumulative_trapezoid(sliding, time, initial=0.0),
        "surface_position": run.surface_speed * (time - time[0]) - (x - x[0]),
        "hold_time": np.full(len(time), np.median(holds) if holds else np.nan),
        "load": np.full(len(time), run.mass * GRAVITY),
        "set_speed": np.full(len(time), abs(run.surface_speed)),
        "temperature": np.full(len(time), run.ambient_degC),
    }


def smoothed(track: ModelTrack) -> tuple[np.ndarray, np.ndarray]:
    """(n,) measured x and its rate, m and m/s, by parabolas over a small part of a period."""
    time, x = track.time, track.run.motion.x
    seen = np.isfinite(x)
    interval = track.run.motion.interval
    even = np.arange(time[0], time[-1] + interval, interval)
    values = np.interp(even, time[seen], x[seen])
    part = SMOOTHED * 2.0 * math.pi / track.run.natural_frequency
    width = 2 * max(int(0.5 * part / interval), 2) + 1
    curve = [savgol_filter(values, width, 2, deriv=order, delta=interval) for order in (0, 1)]
    return np.interp(time, even, curve[0]), np.interp(time, even, curve[1])


def surface_position(track: ModelTrack) -> np.ndarray:
    """(n,) place on the surface that is under the block, m from where it was at first."""
    x, _ = smoothed(track)
    return track.run.surface_speed * (track.time - track.time[0]) - (x - x[0])
