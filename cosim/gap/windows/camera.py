"""What a camera with a fault makes of the block's motion, and what of that can be undone.

With the place r at the time s, the camera writes q at t:

    t = (1 + clock) s,     q = R(rotation) (1 + scale) filter(r(s + latency x~ / 0.1 m)) + drift(s)

x~ is where the camera sees it.

A fault acts in the runs whose ``measurement.<fault>_in`` is not 0; without that in all.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d
from scipy.signal import lfilter

from cosim.gap.data import Track
from cosim.gap.data.noise import GAP
from cosim.gap.weak_form.camera_faults import (
    COURSES,
    FILTERS,
    HALF_WINDOW,
    PAST,
    WINDOW,
    crept,
    leaning,
)

#: Faults that can be undone; what a filter took away, or rounding, is gone.
UNDONE = ("scale", "clock", "rotation", "drift", "latency")
#: Part of an interval by which samples are off that count as even.
JITTER = 0.01
#: How far a filter's kernel reaches, in standard deviations.
REACH = 5.0


def fault(values: Mapping[str, float], name: str) -> float:
    """Size of a fault in a run, SI; 0 where it is not. values : of the run, key -> value"""
    size = values.get(f"measurement.{name}", 0.0)
    return float(size * values.get(f"measurement.{name}_in", 1.0))


def true_time(time: np.ndarray, values: Mapping[str, float]) -> np.ndarray:
    """Times (n,) written, s, by a clock without its fault."""
    return np.asarray(time / (1.0 + fault(values, "clock")))


def seen(places: np.ndarray, time: np.ndarray, values: Mapping[str, float]) -> np.ndarray:
    """(n, 3) x, y, phi as the camera writes them, of the block's at times (n,); m, m, rad."""
    if not any(key.startswith("measurement.") for key in values):
        return places
    places = places.copy()
    latency = fault(values, "latency")
    if latency:
        places[:, 0] = leaning(time, places[:, 0], -latency)
    places = _filtered(places, time, values)
    places[:, :2] = (1.0 + fault(values, "scale")) * _turned(places[:, :2], values, 1.0)
    places[:, :2] += _drift(time, values)
    return places


def undone(track: Track, values: Mapping[str, float]) -> Track:
    """The track as a camera without these faults would have written it, but for a filter's."""
    time = true_time(track.time, values)
    y = np.zeros_like(track.x) if track.y is None else track.y  # a missing y would take x with it
    still = np.column_stack([track.x, y]) - _drift(time, values)
    x, y = _turned(still, values, -1.0).T / (1.0 + fault(values, "scale"))
    latency = fault(values, "latency")
    if latency:
        x = leaning(time, x, latency)
    return replace(track, time=time, x=x, y=None if track.y is None else y)


def _turned(places: np.ndarray, values: Mapping[str, float], way: float) -> np.ndarray:
    """(n, 2) in axes that are turned; way : 1 as written, -1 back."""
    angle = way * fault(values, "rotation")
    if angle == 0.0:
        return places
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(places @ np.array([[c, -s], [s, c]]))


def _drift(time: np.ndarray, values: Mapping[str, float]) -> np.ndarray:
    """(n, 2) of the zeros of x and y, m; an arm that gives way does so along both."""
    course = list(COURSES)[int(values.get("measurement.drift_course", 0.0))]
    aside = values.get("measurement.drift_y", 0.0) * values.get("measurement.drift_in", 1.0)
    return np.outer(crept(course, time, time), [fault(values, "drift"), aside])


def _filtered(places: np.ndarray, time: np.ndarray, values: Mapping[str, float]) -> np.ndarray:
    """By the tracker's filter, of each stretch without lost samples by itself.

    A model that is lost is seen nowhere.
    """
    interval = float(np.median(np.diff(time)))
    width = fault(values, "smoothing") / interval
    if width <= 0.0:
        return places
    kind = FILTERS[int(values.get("measurement.smoothing_kind", 0.0))]
    lost = np.isnan(places).any(axis=1)
    gaps = np.flatnonzero((np.diff(time) > GAP * interval) | np.diff(lost)) + 1
    smooth = places.copy()
    for rows in np.split(np.arange(time.size), gaps):
        if rows.size > 1 and not lost[rows[0]]:
            smooth[rows] = _evenly_smoothed(places[rows], time[rows], width, kind)
    return smooth


def _evenly_smoothed(places: np.ndarray, time: np.ndarray, width: float, kind: str) -> np.ndarray:
    """A filter is one over time: samples whose times jitter are drawn from an even course."""
    even = np.linspace(time[0], time[-1], time.size)
    is_even = np.allclose(time, even, rtol=0.0, atol=JITTER * (time[-1] - time[0]) / time.size)
    if is_even:
        return _smoothed(places, width, kind)
    smooth = _smoothed(CubicSpline(time, places)(even), width, kind)
    return np.asarray(CubicSpline(even, smooth)(time))


def _smoothed(places: np.ndarray, width: float, kind: str) -> np.ndarray:
    """By a filter of `FILTERS`; the motion goes on beyond the ends as there.

    width : standard deviation, samples
    """
    reach = min(math.ceil(REACH * width), len(places) - 1)
    padded = np.pad(places, ((reach, reach), (0, 0)), mode="reflect", reflect_type="odd")
    if kind == PAST:
        keeps = math.exp(-1.0 / width)
        held = keeps * padded[:1]
        smooth = lfilter([1.0 - keeps], [1.0, -keeps], padded, axis=0, zi=held)[0]
    elif kind == WINDOW:  # by its integral: the mean of whole samples would jump with the width
        half, at = HALF_WINDOW * width, np.arange(len(padded))
        integral = CubicSpline(at, padded).antiderivative()
        smooth = (integral(at + half) - integral(at - half)) / (2.0 * half)
    else:
        smooth = gaussian_filter1d(padded, width, axis=0, mode="nearest")
    return np.asarray(smooth[reach : reach + len(places)])
