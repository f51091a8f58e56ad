"""Figures of a stick-slip motion: what a report gives where the record itself is not public."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from stickslip import Trajectory
from stickslip.reference.linearised import SchemeRun

Array = NDArray[np.float64]

# an oscillation counts once it has left a band of this part of the range about the mean
BAND = 0.1
# half range below which nobody sees an oscillation in a plotted record, m
VISIBLE = 5e-4


@dataclass(frozen=True)
class Motion:
    """time s, x m, y m, phi rad: (n,) each. phases (k, 3): begin s, end s, mode (1 slip)."""

    time: Array
    x: Array
    y: Array
    phi: Array
    phases: Array

    @classmethod
    def of_scheme(cls, run: SchemeRun) -> Motion:
        """The motion of a run of the study's scheme."""
        return cls(run.time, run.q[:, 0], run.q[:, 1], run.q[:, 2], run.phases[:, :3])

    @classmethod
    def of_trajectory(cls, run: Trajectory) -> Motion:
        """The motion of a run of the exact model."""
        times, modes = run.events[:, 0], run.events[:, 1]
        edges = np.concatenate([[run.time[0]], times, [run.time[-1]]])
        mode = np.concatenate([[run["mode"][0]], modes])
        phases = np.stack([edges[:-1], edges[1:], mode], axis=1)
        return cls(run.time, run["x"], run["y"], run["phi"], phases)

    def since(self, start: float) -> Motion:
        """From ``start`` (s) on; a phase that has begun before is cut there."""
        keep = self.time >= start
        phases = self.phases[self.phases[:, 1] > start].copy()
        phases[:, 0] = np.maximum(phases[:, 0], start)
        return Motion(self.time[keep], self.x[keep], self.y[keep], self.phi[keep], phases)


def figures(motion: Motion) -> dict[str, float]:
    """The figures that a campaign's ``summary`` may hold; NaN for one that the motion has not.

    mean_x, mean_y, amplitude_x (half range), break_away_x, restick_x in m; frequency:
    oscillations of x per second; slip_share: of the time; slip_duration, stick_duration: means of
    whole phases, s; max_rotation_deg: either way.
    """
    half_range = 0.5 * float(np.ptp(motion.x))
    upward = _upward_crossings(motion.time, motion.x) if half_range > VISIBLE else np.empty(0)
    return {
        "mean_x": _cycle_mean(motion.time, motion.x, upward),
        "mean_y": _time_mean(motion.time, motion.y),
        "amplitude_x": half_range,
        "frequency": _rate(upward),
        "max_rotation_deg": float(np.degrees(np.abs(motion.phi).max())),
    } | _phase_figures(motion)


def _phase_figures(motion: Motion) -> dict[str, float]:
    begin, end, mode = motion.phases.T
    lasting = end - begin
    inner = slice(1, -1)  # the first and the last are cut
    slips, sticks = mode[inner] == 1, mode[inner] == 0
    x_at = np.interp(begin[inner], motion.time, motion.x)
    return {
        "slip_share": float(lasting[mode == 1].sum() / lasting.sum()),
        "slip_duration": _mean(lasting[inner][slips]),
        "stick_duration": _mean(lasting[inner][sticks]),
        "break_away_x": _mean(x_at[slips]),
        "restick_x": _mean(x_at[sticks]),
    }


def _mean(values: Array) -> float:
    return float(values.mean()) if values.size else math.nan


def _time_mean(time: Array, values: Array) -> float:
    return float(np.trapezoid(values, time) / (time[-1] - time[0]))


def _cycle_mean(time: Array, x: Array, upward: Array) -> float:
    """Mean over whole oscillations, as a cut one would tilt it; else over all the time."""
    if len(upward) < 2:
        return _time_mean(time, x)
    ends = upward[[0, -1]]
    first, last = np.interp(ends, time, x)
    inside = (time > ends[0]) & (time < ends[1])
    return _time_mean(
        np.concatenate([ends[:1], time[inside], ends[1:]]),
        np.concatenate([[first], x[inside], [last]]),
    )


def _upward_crossings(time: Array, x: Array) -> Array:
    """Times at which x has risen through a band about its mean, one an oscillation."""
    away = x - _time_mean(time, x)
    band = BAND * float(np.ptp(x))
    side = np.where(away > band, 1, np.where(away < -band, -1, 0))
    seen = np.flatnonzero(side)
    after = seen[1:][(side[seen[1:]] == 1) & (side[seen[:-1]] == -1)]
    # between two rows: a figure must not jump with the rows
    share = (band - away[after - 1]) / (away[after] - away[after - 1])
    return time[after - 1] + share * (time[after] - time[after - 1])


def _rate(upward: Array) -> float:
    """Oscillations per second; none where x does not come back."""
    return float((len(upward) - 1) / (upward[-1] - upward[0])) if len(upward) > 1 else 0.0
