"""Pictures of the temperature of belt and ice, taken while a coupled run goes on."""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from cosim.coupling.record import GrowingTable
from cosim.files import OutputError
from thermal import BeltIceModel, FieldSeries, RigView, collection, rig_view

#: Times closer than this part of the interval are the same: 3 macro steps of 0.1 s make 0.3 s.
SAME_TIME = 1e-6

#: Most views that are shown; then every other one is dropped, and from there on not taken.
MOST_VIEWS = 400

#: Files of the pictures and of the views in the folder where they are kept.
PICTURES, VIEWS = "pictures.npy", "views.npy"


class Snapshots:
    """Keeps the belt's contact face and, when a folder is given, writes the fields there.

    interval: s; a picture is taken of the first state shown at or after each multiple of it.
    folder: must exist; None writes no files. views: also keep the fields of belt and ice, as
    `views`, evenly spread over the run, for an animation. store: a folder, where what was taken is
    on disk while the run goes, so that another process can go on; None: in files without a name.
    `contact_length`: along the belt, m.
    """

    def __init__(
        self,
        interval: float,
        folder: str | Path | None = None,
        views: bool = False,
        store: Path | None = None,
    ):
        self._interval, self._folder, self._store = interval, folder, store
        self._number = -1
        self._series: FieldSeries | None = None
        self._pictures: GrowingTable | None = None
        self._views = _Views(store) if views else None
        self._last_time = -math.inf
        self.position = np.empty(0)
        self.contact_length = float("nan")

    def __call__(self, time: float, model: BeltIceModel) -> None:
        """Take a picture when one is due."""
        number = math.floor(time / self._interval + SAME_TIME)
        if number > self._number:
            self._number = number
            self.take(time, model)

    def take(self, time: float, model: BeltIceModel) -> None:
        """Take a picture now, unless the last one is of now; OutputError where the disk refuses."""
        if time <= self._last_time:
            return
        try:
            self._take(time, model)
        except OSError as error:
            raise OutputError(f"temperature fields: {error}") from error

    def _take(self, time: float, model: BeltIceModel) -> None:
        self.position, temperature = model.belt_profile()
        self.contact_length = model.footprint.length
        if self._folder is not None:
            if self._series is None:
                self._series = FieldSeries(self._folder, model, times=self.time.tolist())
            self._series.write(time)
        if self._pictures is None:
            store = self._store and self._store / PICTURES
            self._pictures = GrowingTable(2 + self.position.size, store)
        if self._views is not None:
            self._views.show(len(self._pictures), time, model)
        self._pictures.append(np.concatenate(([time, model.contact_position], temperature)))
        self._last_time = time

    def save_state(self) -> bytes:
        """What of it is not in the files that it writes, and these on the disk."""
        for table in (self._pictures, None if self._views is None else self._views.table):
            if table is not None:
                table.sync()
        return json.dumps(
            {
                "number": self._number,
                "position": self.position.tolist(),
                "contact_length": self.contact_length,
                "pictures": None if self._pictures is None else len(self._pictures),
                "views": None if self._views is None else self._views.state(),
            }
        ).encode()

    def load_state(self, saved: bytes) -> None:
        """Go on from what `save_state` gave and from the files in the store, in another process.

        Raises OutputError when the files are not those.
        """
        state = json.loads(saved)
        self._number, self.contact_length = state["number"], state["contact_length"]
        self.position = np.array(state["position"])
        if state["pictures"] is None or self._store is None:
            return
        self._pictures = GrowingTable(
            2 + self.position.size, self._store / PICTURES, rows=state["pictures"]
        )
        self._last_time = float(self.time[-1])
        if self._views is not None and state["views"] is not None:
            self._views.restore(state["views"])

    @property
    def file(self) -> Path | None:
        """The collection of the written fields, None when none were written."""
        if self._folder is None or self._pictures is None:
            return None
        return collection(self._folder)

    @property
    def views(self) -> list[tuple[float, RigView]]:
        """Time in s and what is seen of belt and ice."""
        return [] if self._views is None else self._views.shown()

    def _columns(self) -> np.ndarray:
        return np.empty((0, 2)) if self._pictures is None else self._pictures.rows()

    @property
    def time(self) -> np.ndarray:
        """Times of the pictures, s, (k,)."""
        return self._columns()[:, 0]

    @property
    def temperature(self) -> np.ndarray:
        """Contact face of the belt at the `position`s of its material (n,) m: degC, (k, n)."""
        return self._columns()[:, 2:]

    @property
    def contact(self) -> np.ndarray:
        """Material position under the contact's centre, m, (k,)."""
        return self._columns()[:, 1]


class _Views:
    """What belt and ice look like, one row a picture; the file keeps also those dropped later."""

    def __init__(self, store: Path | None):
        self._store = store
        self._every = 1
        self._kept: list[tuple[float, int]] = []
        self._shapes: list[tuple[int, ...]] = []
        self.table: GrowingTable | None = None

    def show(self, number: int, time: float, model: BeltIceModel) -> None:
        """Keep the view of a picture, by its number, unless there are enough around it."""
        if number % self._every:
            return
        parts = [np.asarray(part) for part in rig_view(model)]
        if self.table is None:
            self._shapes = [part.shape for part in parts]
            # half the memory, and more digits than a picture shows
            size = sum(part.size for part in parts)
            self.table = GrowingTable(size, self._store and self._store / VIEWS, single=True)
        self._kept.append((time, len(self.table)))
        self.table.append(np.concatenate([part.ravel() for part in parts]))
        if len(self._kept) > MOST_VIEWS:
            del self._kept[1::2]
            self._every *= 2

    def shown(self) -> list[tuple[float, RigView]]:
        """Time in s and view, of those that are kept."""
        if self.table is None:
            return []
        ends = np.cumsum([math.prod(shape) for shape in self._shapes])[:-1]
        rows = self.table.rows()
        found = []
        for time, row in self._kept:
            parts = zip(np.split(rows[row], ends), self._shapes, strict=True)
            shaped: list[Any] = [part.reshape(shape)[()] for part, shape in parts]
            found.append((time, RigView(*shaped)))
        return found

    def state(self) -> dict[str, Any]:
        """What of it is not in the file."""
        return {
            "every": self._every,
            "kept": self._kept,
            "shapes": self._shapes,
            "rows": None if self.table is None else len(self.table),
        }

    def restore(self, state: Mapping[str, Any]) -> None:
        """Go on from a state that `state` gave, in a folder."""
        self._every = state["every"]
        self._kept = [(time, row) for time, row in state["kept"]]
        self._shapes = [tuple(shape) for shape in state["shapes"]]
        if state["rows"] is not None and self._store is not None:
            size = sum(math.prod(shape) for shape in self._shapes)
            self.table = GrowingTable(size, self._store / VIEWS, True, state["rows"])
