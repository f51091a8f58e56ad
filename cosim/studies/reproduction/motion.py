"""Figures of a stick-slip motion, read alike off the scheme and the exact model."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from stickslip import Trajectory
from stickslip.reference.linearised import SchemeRun

WINDOW = 20.0  # s, the study's run at constant speed: oscillations are counted over as much
# an oscillation counts once it has left a band of this part of the range about the mean
BAND = 0.1


@dataclass(frozen=True)
class Motion:
    """time s, x m, y m, phi rad, friction N (along x), mode (1 slip): (n,) each.

    phases (k, 3): begin s, end s, mode.
    """

    time: np.ndarray
    x: np.ndarray
    y: np.ndarray
    phi: np.ndarray
    friction: np.ndarray
    mode: np.ndarray
    phases: np.ndarray

    @classmethod
    def of_scheme(cls, run: SchemeRun) -> Motion:
        """The motion of a run of the study's scheme."""
        x, y, phi = run.q.T
        return cls(run.time, x, y, phi, run.load[:, 0], run.mode, run.phases[:, :3])

    @classmethod
    def of_trajectory(cls, run: Trajectory) -> Motion:
        """The motion of a run of the exact model."""
        edges = np.concatenate([run.time[:1], run.events[:, 0], run.time[-1:]])
        modes = np.concatenate([run["mode"][:1], run.events[:, 1]])
        phases = np.stack([edges[:-1], edges[1:], modes], axis=1)
        x, y, phi, force = (run[name] for name in ("x", "y", "phi", "friction_force_x"))
        return cls(run.time, x, y, phi, force, run["mode"], phases)

    def last(self, share: float) -> Motion:
        """The last ``share`` of the time."""
        return self.between(self.time[-1] - share * (self.time[-1] - self.time[0]))

    def between(self, start: float, end: float = math.inf) -> Motion:
        """From ``start`` to ``end`` (s)."""
        keep = (self.time >= start) & (self.time <= end)
        rows = {name: values[keep] for name, values in vars(self).items() if name != "phases"}
        inside = self.phases[(self.phases[:, 1] > start) & (self.phases[:, 0] < end)].copy()
        inside[:, :2] = np.clip(inside[:, :2], start, end)
        return replace(self, phases=inside, **rows)

    @property
    def phi_deg(self) -> np.ndarray:
        """Rotation, deg: (n,)."""
        return np.asarray(np.degrees(self.phi))

    @property
    def rotation(self) -> float:
        """Largest rotation either way, deg."""
        return float(np.abs(self.phi_deg).max())


@dataclass(frozen=True)
class MotionFigures:
    """What is read off a run; m, s, deg, 1. A figure that a run does not have is NaN."""

    mean_x: float
    half_range_x: float
    rate: float  # oscillations of x per second
    slip_share: float
    slip_time: float  # mean duration of a whole slip, and of a whole stick
    stick_time: float
    max_rotation: float
    mean_y: float
    mean_friction: float  # size of the force along x, in slip, N
    swing_rate: float  # of the fastest swing of phi: its angle by its duration, deg/s

    @property
    def oscillations(self) -> float:
        """In 20 s."""
        return WINDOW * self.rate


def figures(motion: Motion, between_rows: bool = False, visible: float = 0.0) -> MotionFigures:
    """Figures of all of ``motion``; cut it to the steady part first.

    between_rows: of `upward_crossings`; visible: half range of x (m) of the least oscillation.
    """
    time, x, slip = motion.time, motion.x, motion.mode == 1
    half_range = 0.5 * float(np.ptp(x))
    upward = upward_crossings(time, x, between_rows) if half_range > visible else np.empty(0)
    lasting, slips = motion.phases[:, 1] - motion.phases[:, 0], motion.phases[:, 2] == 1
    inner = slice(1, -1)  # the first and the last are cut
    return MotionFigures(
        mean_x=cycle_mean(time, x, upward),
        half_range_x=half_range,
        rate=_rate(upward),
        slip_share=float(lasting[slips].sum() / lasting.sum()),
        slip_time=mean(lasting[inner][slips[inner]]),
        stick_time=mean(lasting[inner][~slips[inner]]),
        max_rotation=motion.rotation,
        mean_y=time_mean(time, motion.y),
        mean_friction=mean(np.abs(motion.friction[slip])),
        swing_rate=_swing_rate(motion),
    )


def average(many: list[MotionFigures]) -> MotionFigures:
    """Mean of each figure over several runs, of those that have it."""
    table = np.array([list(vars(one).values()) for one in many])
    return MotionFigures(*(mean(column[np.isfinite(column)]) for column in table.T))


def mean(values: np.ndarray) -> float:
    """The mean, NaN of nothing."""
    return float(values.mean()) if values.size else math.nan


def time_mean(time: np.ndarray, values: np.ndarray) -> float:
    """Mean over time, samples at uneven times."""
    return float(np.trapezoid(values, time) / (time[-1] - time[0]))


def upward_crossings(time: np.ndarray, x: np.ndarray, between_rows: bool = False) -> np.ndarray:
    """Times at which x has risen through a band about its mean, one an oscillation.

    between_rows: interpolated, so that a figure does not jump with the rows; else the row after.
    """
    away = x - time_mean(time, x)
    band = BAND * float(np.ptp(x))
    side = np.where(away > band, 1, np.where(away < -band, -1, 0))
    seen = np.flatnonzero(side)
    after = seen[1:][(side[seen[1:]] == 1) & (side[seen[:-1]] == -1)]
    if not between_rows:
        return np.asarray(time[after])
    share = (band - away[after - 1]) / (away[after] - away[after - 1])
    return np.asarray(time[after - 1] + share * (time[after] - time[after - 1]))


def oscillation_rate(time: np.ndarray, x: np.ndarray) -> float:
    """Oscillations of x about its mean per second, from the first upward crossing to the last."""
    return _rate(upward_crossings(time, x))


def _rate(upward: np.ndarray) -> float:
    return float((len(upward) - 1) / np.ptp(upward)) if len(upward) > 1 else math.nan


def cycle_mean(time: np.ndarray, x: np.ndarray, upward: np.ndarray) -> float:
    """Mean over whole oscillations, so that a cut one does not tilt it; else over all the time."""
    if len(upward) < 2:
        return time_mean(time, x)
    ends = upward[[0, -1]]
    inside = time[(time > ends[0]) & (time < ends[1])]
    whole = np.concatenate([ends[:1], inside, ends[1:]])
    return time_mean(whole, np.interp(whole, time, x))


def _swing_rate(motion: Motion) -> float:
    """Largest angle by duration of a swing from one turning point of phi to the next, deg/s.

    Only swings of more than a tenth of the largest one: a fast shiver is no swing.
    """
    turns = np.diff(motion.phi)
    moves = np.flatnonzero(turns)
    turning = moves[1:][np.sign(turns[moves[1:]]) != np.sign(turns[moves[:-1]])]
    angle = np.abs(np.diff(motion.phi_deg[turning]))
    if not len(angle):
        return 0.0
    whole = angle > 0.1 * angle.max()
    return float((angle / np.diff(motion.time[turning]))[whole].max())
