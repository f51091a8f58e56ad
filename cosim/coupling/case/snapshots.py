"""Pictures of the temperature fields, at regular times of a coupled run."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from thermal import BeltIceModel, FieldSeries, RigView, rig_view

#: Times closer than this part of the interval are the same: 3 macro steps of 0.1 s make 0.3 s.
ROUNDING = 1e-6

#: Most views that are kept; then every other one is dropped, and from there on not taken.
MOST_VIEWS = 400


class Snapshots:
    """Keeps the belt's contact face and, when a folder is given, writes the fields there.

    interval: s; a picture is taken of the first state shown at or after each multiple of it.
    folder: must exist; None writes no files. views: also keep the fields of belt and ice, as
    `views` (time in s, what is seen), evenly spread over the run, for an animation.
    `contact_length`: along the belt, m.
    """

    def __init__(self, interval: float, folder: str | Path | None = None, views: bool = False):
        self._interval = interval
        self._folder = folder
        self._number = -1
        self._series: FieldSeries | None = None
        self._taken: list[tuple[float, np.ndarray, float]] = []
        self._view_every = 1 if views else 0
        self.views: list[tuple[float, RigView]] = []
        self.position = np.empty(0)
        self.contact_length = float("nan")

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
        if self._view_every and len(self._taken) % self._view_every == 0:
            self._keep_view(time, model)
        self.position, temperature = model.belt_profile()
        self.contact_length = model.footprint.length
        self._taken.append((time, temperature, model.contact_position))

    def _keep_view(self, time: float, model: BeltIceModel) -> None:
        # half the memory, and more digits than a picture shows
        view = RigView(*(np.float32(part) for part in rig_view(model)))  # type: ignore[arg-type]
        self.views.append((time, view))
        if len(self.views) > MOST_VIEWS:
            del self.views[1::2]
            self._view_every *= 2

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
