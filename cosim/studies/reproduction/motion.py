"""Figures of a stick-slip motion, read alike off the scheme and the exact model."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from stickslip import Trajectory
from stickslip.reference.linearised import SchemeRun

WINDOW = 20.0  # s, the study's run at constant speed: oscillations are counted over as much
# an oscillation counts once it has left a band of this part of the range about the mean
BAND = 0.1


@dataclass(frozen=True)
class Motion:
    """time s, x m, y m, phi rad, omega rad/s, friction N (along x): (n,) each.

    phases (k, 3): begin s, end s, mode (1 slip); jumps (k,): jump of x' at each phase's end, m/s.
    """

    time: np.ndarray
    x: np.ndarray
    y: np.ndarray
    phi: np.ndarray
    omega: np.ndarray
    friction: np.ndarray
    mode: np.ndarray
    phases: np.ndarray
    jumps: np.ndarray

    @classmethod
    def of_scheme(cls, run: SchemeRun) -> Motion:
        """The motion of a run of the study's scheme."""
        return cls(
            run.time,
            run.q[:, 0],
            run.q[:, 1],
            run.q[:, 2],
            run.velocity[:, 2],
            run.load[:, 0],
            run.mode,
            run.phases[:, :3],
            run.phases[:, 4],
        )

    @classmethod
    def of_trajectory(cls, run: Trajectory) -> Motion:
        """The motion of a run of the exact model; re-stick is an event there, without a jump."""
        times, modes = run.events[:, 0], run.events[:, 1]
        edges = np.concatenate([[run.time[0]], times, [run.time[-1]]])
        phases = np.stack(
            [edges[:-1], edges[1:], np.concatenate([[run["mode"][0]], modes])], axis=1
        )
        return cls(
            run.time,
            run["x"],
            run["y"],
            run["phi"],
            run["omega"],
            run["friction_force_x"],
            run["mode"],
            phases,
            np.zeros(len(phases)),
        )

    def last(self, share: float) -> Motion:
        """The last ``share`` of the time."""
        start = self.time[-1] - share * (self.time[-1] - self.time[0])
        return self.since(start)

    def since(self, start: float) -> Motion:
        """From ``start`` (s) on."""
        return self.between(start, float("inf"))

    def between(self, start: float, end: float) -> Motion:
        """From ``start`` to ``end`` (s)."""
        keep = (self.time >= start) & (self.time <= end)
        phases = (self.phases[:, 1] > start) & (self.phases[:, 0] < end)
        cut = self.phases[phases].copy()
        cut[:, :2] = np.clip(cut[:, :2], start, end)
        return Motion(
            self.time[keep],
            self.x[keep],
            self.y[keep],
            self.phi[keep],
            self.omega[keep],
            self.friction[keep],
            self.mode[keep],
            cut,
            self.jumps[phases],
        )


@dataclass(frozen=True)
class MotionFigures:
    """What the study reads off a run; m, s, deg, 1. A figure that a run does not have is NaN."""

    mean_x: float
    half_range_x: float
    oscillations: float  # in 20 s
    slip_share: float
    slip_time: float  # mean duration of a slip
    max_rotation: float  # deg
    max_rotation_rate: float  # deg/s
    mean_y: float
    range_y: float
    mean_friction: float  # size of the force along x, in slip, N
    swing_rate: float  # of the fastest swing of phi: its angle by its duration, deg/s


def figures(motion: Motion) -> MotionFigures:
    """Figures of all of ``motion``; cut it to the steady part first."""
    return MotionFigures(
        mean_x=cycle_mean(motion.time, motion.x),
        half_range_x=0.5 * float(np.ptp(motion.x)),
        oscillations=WINDOW * oscillation_rate(motion.time, motion.x),
        slip_share=_slip_share(motion.phases),
        slip_time=_slip_time(motion.phases),
        max_rotation=float(np.degrees(np.abs(motion.phi).max())),
        max_rotation_rate=float(np.degrees(np.abs(motion.omega).max())),
        mean_y=time_mean(motion.y, motion.time),
        range_y=float(np.ptp(motion.y)),
        mean_friction=_mean_friction(motion),
        swing_rate=_swing_rate(motion),
    )


def average(many: list[MotionFigures]) -> MotionFigures:
    """Mean of each figure over several runs."""
    table = np.array([list(vars(one).values()) for one in many])
    known = np.isfinite(table).sum(axis=0)
    mean = np.where(known, np.nansum(table, axis=0) / np.maximum(known, 1), np.nan)
    return MotionFigures(*mean.tolist())


def time_mean(values: np.ndarray, time: np.ndarray) -> float:
    """Mean over time, samples at uneven times."""
    return float(np.trapezoid(values, time) / (time[-1] - time[0]))


def upward_crossings(time: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Times at which x has risen through a band about its mean, one an oscillation."""
    away = x - time_mean(x, time)
    band = BAND * float(np.ptp(x))
    side = np.where(away > band, 1, np.where(away < -band, -1, 0))
    seen = np.flatnonzero(side)
    upward = seen[1:][(side[seen[1:]] == 1) & (side[seen[:-1]] == -1)]
    return time[upward]


def oscillation_rate(time: np.ndarray, x: np.ndarray) -> float:
    """Oscillations of x about its mean per second, from the first upward crossing to the last."""
    upward = upward_crossings(time, x)
    return float((len(upward) - 1) / (upward[-1] - upward[0])) if len(upward) > 1 else math.nan


def cycle_mean(time: np.ndarray, x: np.ndarray) -> float:
    """Mean over whole oscillations, so that a cut one does not tilt it; else over all the time."""
    upward = upward_crossings(time, x)
    if len(upward) < 2:
        return time_mean(x, time)
    whole = (time >= upward[0]) & (time <= upward[-1])
    return time_mean(x[whole], time[whole])


def _slip_share(phases: np.ndarray) -> float:
    lasting = phases[:, 1] - phases[:, 0]
    return float(lasting[phases[:, 2] == 1].sum() / lasting.sum())


def _slip_time(phases: np.ndarray) -> float:
    """Mean duration of the slips that lie wholly inside, s."""
    inner = phases[1:-1]
    slips = inner[inner[:, 2] == 1]
    return float(np.mean(slips[:, 1] - slips[:, 0])) if len(slips) else float("nan")


def _mean_friction(motion: Motion) -> float:
    slip = motion.mode == 1
    return float(np.abs(motion.friction[slip]).mean()) if slip.any() else float("nan")


def _swing_rate(motion: Motion) -> float:
    """Largest angle by duration of a swing from one turning point of phi to the next, deg/s.

    Only swings of more than a tenth of the largest one: a fast shiver is no swing.
    """
    turns = np.diff(motion.phi)
    moves = np.flatnonzero(turns)
    turning = moves[1:][np.sign(turns[moves[1:]]) != np.sign(turns[moves[:-1]])]
    angle = np.abs(np.diff(np.degrees(motion.phi[turning])))
    if not len(angle):
        return 0.0
    whole = angle > 0.1 * angle.max()
    return float((angle / np.diff(motion.time[turning]))[whole].max())
