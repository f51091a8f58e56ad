"""Pictures of the temperature fields, at regular times of a coupled run."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from thermal import BeltIceModel, FieldSeries

#: Times closer than this part of the interval are the same: 3 macro steps of 0.1 s make 0.3 s.
ROUNDING = 1e-6


class Snapshots:
    """Keeps the belt's contact face and, when a folder is given, writes the fields there.

    interval: s; a picture is taken of the first state shown at or after each multiple of it.
    folder: must exist; None writes no files.
    """

    def __init__(self, interval: float, folder: str | Path | None = None):
        self._interval = interval
        self._folder = folder
        self._number = -1
        self._series: FieldSeries | None = None
        self._taken: list[tuple[float, np.ndarray, float]] = []
        self.position = np.empty(0)

    def __call__(self, time: float, model: BeltIceModel) -> None:
        """Take a picture when one is due."""
        number = math.floor(time / self._interval + ROUNDING)
        if number > self._number:
            self._number = number
            self.take(time, model)

    def take(self, time: float, model: BeltIceModel) -> None:
        """Take a picture now, unless the last one is of now."""
        if self._taken and time <= self._taken[-1][0]:
            return
        if self._folder is not None:
            self._series = self._series or FieldSeries(self._folder, model)
            self._series.write(time)
        self.position, temperature = model.belt_profile()
        self._taken.append((time, temperature, model.contact_position))

    @property
    def file(self) -> Path | None:
        """The collection of the written fields, None when none were written."""
        return self._series.path if self._series else None

    @property
    def time(self) -> np.ndarray:
        """Times of the pictures, s, (k,)."""
        return np.array([time for time, _, _ in self._taken])

    @property
    def temperature(self) -> np.ndarray:
        """Contact face of the belt at the `position`s of its material (n,) m: degC, (k, n)."""
        profiles = [profile for _, profile, _ in self._taken]
        return np.array(profiles).reshape(len(profiles), self.position.size)

    @property
    def contact(self) -> np.ndarray:
        """Material position under the contact's centre, m, (k,)."""
        return np.array([contact for _, _, contact in self._taken])
