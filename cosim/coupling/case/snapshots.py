"""Pictures of the temperature of belt and ice, taken while a coupled run goes on."""

import json
import math
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

    model: whose pictures are taken. interval: s; a picture is taken of the first state shown at or
    after each multiple of it. folder: must exist; None writes no files. views: also keep the fields
    of belt and ice, as `views`, evenly spread over the run, for an animation. store: a folder,
    where what was taken is on disk while the run goes, so that another process can go on; None: in
    files without a name. `position` (n,) m of the belt's material; `contact_length`: along the
    belt, m.
    """

    def __init__(
        self,
        model: BeltIceModel,
        interval: float,
        folder: str | Path | None = None,
        views: bool = False,
        store: Path | None = None,
    ):
        self._model, self._interval, self._folder, self._store = model, interval, folder, store
        self.position = model.belt_profile()[0]
        self.contact_length = model.footprint.length
        self._shapes = [np.shape(part) for part in rig_view(model)] if views else []
        self._number, self._every = -1, 1
        #: Time and row of the views that are shown; the file has also those dropped later.
        self._kept: list[tuple[float, int]] = []
        self._pictures: GrowingTable | None = None
        self._views: GrowingTable | None = None
        self._series: FieldSeries | None = None

    def __call__(self, time: float) -> None:
        """Take a picture when one is due."""
        number = math.floor(time / self._interval + SAME_TIME)
        if number > self._number:
            self._number = number
            self.take(time)

    def take(self, time: float) -> None:
        """Take a picture now, unless the last one is of now; OutputError where the disk refuses."""
        if self.time.size and time <= self.time[-1]:
            return
        try:
            self._take(time)
        except OSError as error:
            raise OutputError(f"temperature fields: {error}") from error

    def _take(self, time: float) -> None:
        pictures = self._begun() if self._pictures is None else self._pictures
        if self._series is not None:
            self._series.write(time)
        if self._views is not None and len(pictures) % self._every == 0:
            self._keep_view(time, self._views)
        _, temperature = self._model.belt_profile()
        pictures.append(np.concatenate(([time, self._model.contact_position], temperature)))

    def _begun(self, pictures: int | None = None, views: int | None = None) -> GrowingTable:
        """Its files: new, or with so many rows that an earlier process has left in the store."""
        store, size = self._store, sum(map(math.prod, self._shapes))
        columns = 2 + self.position.size
        self._pictures = GrowingTable(columns, store and store / PICTURES, rows=pictures)
        if self._shapes:
            # half the memory, and more digits than a picture shows
            self._views = GrowingTable(size, store and store / VIEWS, single=True, rows=views)
        if self._folder is not None:
            self._series = FieldSeries(self._folder, self._model, times=self.time.tolist())
        return self._pictures

    def _keep_view(self, time: float, views: GrowingTable) -> None:
        self._kept.append((time, len(views)))
        views.append(np.concatenate([np.ravel(part) for part in rig_view(self._model)]))
        if len(self._kept) > MOST_VIEWS:
            del self._kept[1::2]
            self._every *= 2

    def save_state(self) -> bytes:
        """What of it is not in the files that it writes, and these on the disk."""
        rows = {}
        for name, table in (("pictures", self._pictures), ("views", self._views)):
            if table is not None:
                table.sync()
                rows[name] = len(table)
        own = {"number": self._number, "every": self._every, "kept": self._kept, "rows": rows}
        return json.dumps(own).encode()

    def load_state(self, saved: bytes) -> None:
        """Go on from what `save_state` gave and from the files in the store, in another process.

        Raises OutputError when the files are not those.
        """
        state = json.loads(saved)
        self._number, self._every = state["number"], state["every"]
        self._kept = [(time, row) for time, row in state["kept"]]
        if state["rows"]:
            self._begun(**state["rows"])

    @property
    def file(self) -> Path | None:
        """The collection of the written fields, None when none were written."""
        if self._folder is None or self._pictures is None:
            return None
        return collection(self._folder)

    @property
    def views(self) -> list[tuple[float, RigView]]:
        """Time in s and what is seen of belt and ice."""
        if self._views is None:
            return []
        rows, found = self._views.rows(), []
        ends = np.cumsum([math.prod(shape) for shape in self._shapes])[:-1]
        for time, row in self._kept:
            parts = zip(np.split(rows[row], ends), self._shapes, strict=True)
            shaped: list[Any] = [part.reshape(shape)[()] for part, shape in parts]
            found.append((time, RigView(*shaped)))
        return found

    def _columns(self) -> np.ndarray:
        if self._pictures is None:
            return np.empty((0, 2 + self.position.size))
        return self._pictures.rows()

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
