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
        begins, modes = run.phases
        phases = np.stack([begins, np.append(begins[1:], run.time[-1]), modes], axis=1)
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


def figures(*motions: Motion, visible: float = 0.0) -> dict[str, float]:
    """Figures of all of a motion, or the mean of those of several, by name; NaN: it has none.

    Cut motions to their steady part first. mean_x, mean_y, amplitude_x (half range), and
    break_away_x, restick_x, where x is as a phase begins, m; frequency: oscillations of x per
    second; oscillations: in 20 s; slip_share: of the time; slip_duration, stick_duration: means of
    whole phases, s; hold: median stick, s; max_rotation: either way, deg; friction: mean size of
    the force along x in slip, N; swing_rate: angle by duration of the fastest swing of phi, deg/s.

    visible: half range of x (m) of the least oscillation.
    """
    each = [_figures(one, visible) for one in motions]
    known = {name: np.array([one[name] for one in each]) for name in each[0]}
    found = {name: mean(values[np.isfinite(values)]) for name, values in known.items()}
    return found | {"oscillations": WINDOW * found["frequency"]}


def _figures(motion: Motion, visible: float) -> dict[str, float]:
    time, x = motion.time, motion.x
    half_range = 0.5 * float(np.ptp(x))
    upward = upward_crossings(time, x) if half_range > visible else np.empty(0)
    lasting, slips = motion.phases[:, 1] - motion.phases[:, 0], motion.phases[:, 2] == 1
    whole = slice(1, -1)  # the first and the last are cut
    held = lasting[~slips & (lasting > 0.0)]  # the scheme has sticks that end as they begin
    begins = np.interp(motion.phases[whole, 0], time, x)
    return {
        "mean_x": cycle_mean(time, x, upward),
        "mean_y": time_mean(time, motion.y),
        "amplitude_x": half_range,
        "frequency": rate(upward),
        "slip_share": float(lasting[slips].sum() / lasting.sum()),
        "slip_duration": mean(lasting[whole][slips[whole]]),
        "stick_duration": mean(lasting[whole][~slips[whole]]),
        "hold": float(np.median(held)) if held.size else math.nan,
        "break_away_x": mean(begins[slips[whole]]),
        "restick_x": mean(begins[~slips[whole]]),
        "max_rotation": motion.rotation,
        "friction": mean(np.abs(motion.friction[motion.mode == 1])),
        "swing_rate": _swing_rate(motion),
    }


def mean(values: np.ndarray) -> float:
    """The mean, NaN of nothing."""
    return float(values.mean()) if values.size else math.nan


def time_mean(time: np.ndarray, values: np.ndarray) -> float:
    """Mean over time, samples at uneven times."""
    return float(np.trapezoid(values, time) / (time[-1] - time[0]))


def upward_crossings(time: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Times at which x has risen through a band about its mean, one an oscillation.

    Between the rows, so that a figure does not jump with them.
    """
    away = x - time_mean(time, x)
    band = BAND * float(np.ptp(x))
    side = np.where(away > band, 1, np.where(away < -band, -1, 0))
    seen = np.flatnonzero(side)
    after = seen[1:][np.diff(side[seen]) > 0]
    share = (band - away[after - 1]) / (away[after] - away[after - 1])
    return np.asarray(time[after - 1] + share * (time[after] - time[after - 1]))


def rate(upward: np.ndarray) -> float:
    """Oscillations per second, from the first upward crossing to the last."""
    return float((len(upward) - 1) / np.ptp(upward)) if len(upward) > 1 else math.nan


def cycle_mean(time: np.ndarray, x: np.ndarray, upward: np.ndarray) -> float:
    """Mean over whole oscillations, so that a cut one does not tilt it; else over all the time."""
    if len(upward) < 2:
        return time_mean(time, x)
    inside = time[(time > upward[0]) & (time < upward[-1])]
    whole = np.concatenate([upward[:1], inside, upward[-1:]])
    return time_mean(whole, np.interp(whole, time, x))


def _swing_rate(motion: Motion) -> float:
    """Largest angle by duration of a swing from one turning point of phi to the next, deg/s.

    Only swings of more than a tenth of the largest one: a fast shiver is no swing.
    """
    turns = np.diff(motion.phi)
    moves = np.flatnonzero(turns)
    turning = moves[1:][np.diff(np.sign(turns[moves])) != 0]
    angle = np.abs(np.diff(motion.phi_deg[turning]))
    if not len(angle):
        return 0.0
    whole = angle > 0.1 * angle.max()
    return float((angle / np.diff(motion.time[turning]))[whole].max())
