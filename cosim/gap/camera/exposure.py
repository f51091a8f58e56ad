"""When the model has to be asked so that what a camera writes at its own times can be told.

A rolling shutter sees the block at t + c q_x(t), and what it saw then is what it wrote: the times
t + c q_x of the *written* x are right but for c times noise and misfit, and the rest is made up for
with the model's own velocity,

    q_x(t) = (p_x - c p_x' Q) / (1 - c p_x'),      p at t + c Q, Q the written x,

of an error of A (c (q_x - Q))^2 / 2, A the acceleration: micrometres at most. Nothing has to be
solved, and the model is asked at the same times whatever its parameters.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .camera import Camera
from .filters import filtered

#: Stretches without samples are filled for a filter, at the median interval of the others, where
#: they are longer than so many of these.
_GAP = 1.5
#: Two moments of the same motion are apart by at least this part of an interval.
_APART = 1e-9


@dataclass(frozen=True)
class Exposure:
    """The moments at which a camera's samples were taken.

    Attributes
    ----------
    camera : that took them
    frames : (m,) true times, s after the first sample, at which a frame began
    rows : (n,) which of them the written samples are; the others lie in between
    start : x that the delay of a rolling shutter counts from, m: the first one, as a delay of all
        samples alike is not seen, and none is to lie before the run's beginning
    moments : (m,) true times at which the block was seen
    """

    camera: Camera
    frames: np.ndarray
    rows: np.ndarray
    start: float
    moments: np.ndarray

    @staticmethod
    def of(camera: Camera, time: np.ndarray, x: np.ndarray | None) -> Exposure:
        """Of samples written at times (n,), s, and x (n,), m, NaN where missing (None: all)."""
        frames = time / camera.clock
        rows = np.arange(time.size)
        if camera.filters:
            frames, rows = _without_gaps(frames)
        place = np.zeros(frames.size)
        seen = np.isfinite(x) if x is not None else np.zeros(time.size, dtype=bool)
        if x is not None and seen.any():
            place = np.interp(frames, time[seen] / camera.clock, x[seen])
        moments = frames
        if camera.per_metre:
            moments = np.maximum.accumulate(frames + camera.per_metre * (place - place[0]))
            moments = moments + _APART * (frames - frames[0])
        return Exposure(camera, frames, rows, float(place[0]), moments)

    def true_states(self, states: np.ndarray, first: np.ndarray, speed: float) -> np.ndarray:
        """(k, 6) written states x, y, phi, vx, vy, omega as the block's own.

        first : (k,) row of the sample at which each is. Where a velocity along x is missing (NaN)
        it is that of the surface; a state of a filter's output is taken as it is, and the fit
        finds the one behind it.
        """
        at = self.rows[first]
        places, rates = states[:, :3].copy(), states[:, 3:] * self.camera.clock
        sticks = np.isnan(rates[:, 0])
        carried = self.camera.turned(np.tile([speed, 0.0, 0.0], (len(states), 1)))
        when = self.moments[at]
        drift = self.camera.drift_rate(when)
        rates[sticks, 0] = (carried[:, 0] + drift[:, 0])[sticks]
        if self.camera.per_metre:
            slow = 1.0 + self.camera.per_metre * np.where(sticks, 0.0, rates[:, 0])
            rates = rates / slow[:, None]
            late = self.moments[at] - self.frames[at] - self._delay(places[:, 0])
            places = places + rates * np.nan_to_num(late)[:, None]
        places[:, :2] -= self.camera.drift(when)
        rates[:, :2] -= drift
        result = np.hstack([self.camera.turned_back(places), self.camera.turned_back(rates)])
        result[np.isnan(states)] = np.nan
        return result

    def written(self, places: np.ndarray, rates: np.ndarray | None = None) -> np.ndarray:
        """(n, 3) x, y, phi as written, from the block's own (m, 3) at the moments.

        rates : (m, 3) its velocities; None where the camera needs none.
        """
        picture = self.camera.pictured(places, self.moments)
        if rates is None:
            return picture[self.rows]
        rates = self.camera.pictured_rates(rates, self.moments)
        if self.camera.per_metre:
            picture, rates = self._read_out(picture, rates)
        if self.camera.filters:
            wanted, kernel = self.frames[self.rows], self.camera.kernel
            return filtered(self.frames, picture, rates, wanted, kernel)
        return picture[self.rows]

    def _delay(self, x: np.ndarray) -> np.ndarray:
        """How long after its frame's beginning a place x, m, is seen, s."""
        return self.camera.per_metre * (x - self.start)

    def _read_out(self, picture: np.ndarray, rates: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """At the frames' own times instead of the moments; places and rates (m, 3)."""
        c = self.camera.per_metre
        fast = 1.0 - c * rates[:, 0]
        seen_late = self.moments - self.frames
        x = (picture[:, 0] - rates[:, 0] * (seen_late + c * self.start)) / fast
        later = self._delay(x) - seen_late
        return picture + rates * later[:, None], rates / fast[:, None]


def _without_gaps(times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(m,) times with further ones in long intervals, and (n,) where the given ones are."""
    steps = np.diff(times)
    usual = float(np.median(steps))
    counts = np.where(steps > _GAP * usual, np.ceil(steps / usual), 1).astype(int)
    rows = np.concatenate([[0], np.cumsum(counts)])
    filled = np.interp(np.arange(rows[-1] + 1), rows, times)
    filled[rows] = times
    return filled, rows
