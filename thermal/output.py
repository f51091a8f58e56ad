"""Temperature of belt and ice as somebody beside the rig sees it: arrays, and files for ParaView.

x = 0 is the centre of the contact, z = 0 the contact face, metres. The belt lies below (the loop
cut opposite the contact, its temperatures interpolated linearly to this frame), the ice stands
above: of a cylinder the section through its axis, of a sample all of it.

The series of files is one VTU file (written by meshio) for each time and a PVD collection that
names them; beside it the same again with a belt so many times thicker, as its name says, that is
no mere line to the eye. A file appears under its name only when it is complete and a collection is
replaced as a whole, so whatever interrupts a run, what was written before stays readable.
"""

import math
import os
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import meshio
import numpy as np

from .arrays import Array, grid_points, interpolated, quadrilaterals
from .model import BeltIceModel


class RigView(NamedTuple):
    """Temperatures at one time, degC.

    offset (n,) m along the belt's motion, n covering the loop cut opposite the contact; depth (d,)
    m below the contact face; belt (n, d). x (m,) m, height (h,) m above the face; ice (m, h) of
    the section y = 0, NaN outside the ice. contact: its length along the belt, m.
    """

    offset: Array
    depth: Array
    belt: Array
    x: Array
    height: Array
    ice: Array
    contact: float


def seen_belt(model: BeltIceModel) -> tuple[Array, Array]:
    """Offset (n,) m and temperature (n, depths) degC, interpolated linearly to the rig."""
    cells, cell = model.belt.cells, model.belt.cell
    offset = (np.arange(cells + 1, dtype=np.float64) - cells / 2) * cell
    _, _, field = model.belt_field()
    return offset, interpolated(field, (model.contact_position + offset) / cell)


def rig_view(model: BeltIceModel) -> RigView:
    """What the model holds now."""
    offset, belt = seen_belt(model)
    x, height, rise = model.ice.section()
    ice = model.parameters.ambient.temperature_degC + rise
    return RigView(offset, model.belt.depth, belt, x, height, ice, model.footprint.length)


#: What the files of a series begin with.
NAME = "temperature"


def collection(folder: str | Path, name: str = NAME) -> Path:
    """The file of a series that names the others."""
    return Path(folder) / f"{name}.pvd"


#: Thickness of the stretched belt, about, as a part of its length.
STRETCHED = 0.1


def stretch_factor(length: float, thickness: float) -> float:
    """By what the stretched view multiplies the depth of a belt (m): two digits, at least 1."""
    return max(1.0, float(f"{STRETCHED * length / thickness:.2g}"))


class FieldSeries:
    """Writes `temperature.pvd` and `temperature_<number>.vtu` into a folder that exists.

    Point data `temperature_degC`, `rise_K` over the air, and `stretch_m`, with which the filter
    Warp By Vector thickens the belt. Cell data `part` (0 belt, 1 ice). Beside it the same fields
    already stretched, `temperature_belt_<factor>x.pvd`: heights below the contact are `factor`
    times the true ones (see `stretch_factor`), the ice and all lengths along the belt are true.

    An earlier series is replaced from its first file on. times: of the fields (s) that an earlier
    process wrote and this one goes on from; then from the next one.
    """

    def __init__(
        self, folder: str | Path, model: BeltIceModel, times: Sequence[float] = ()
    ) -> None:
        self.folder: Path = Path(folder)
        if not self.folder.is_dir():
            raise ValueError(f"{self.folder}: no such folder for the temperature fields")
        self._model = model
        self._times = list(times)
        belt, ice, offset = model.belt, model.ice, seen_belt(model)[0]
        below = grid_points(offset, -belt.depth)
        points = np.concatenate((below, ice.points))
        #: How many times thicker the belt of the stretched view is.
        self.factor: float = stretch_factor(float(np.ptp(offset)), float(belt.depth.max()))
        #: Displacements (points, 3) m that thicken the belt; the ice stays.
        self._stretch = np.zeros_like(points)
        self._stretch[: len(below), 2] = (self.factor - 1.0) * below[:, 2]
        self._views = {NAME: points}
        if self.factor > 1.0:
            self._views[f"{NAME}_belt_{self.factor:g}x"] = points + self._stretch
        self._cells = [
            ("quad", quadrilaterals(belt.cells + 1, belt.depth.size)),
            (ice.cell_type, ice.cells + len(below)),
        ]
        self._part = [
            np.full(len(cells), part, dtype=np.int32) for part, (_, cells) in enumerate(self._cells)
        ]

    @property
    def path(self) -> Path:
        """The collection, the one file to open."""
        return collection(self.folder)

    def write(self, time: float) -> Path:
        """Add the model's present fields at time (s); returns the VTU file of the true view.

        ValueError when time is not after the last one written; OSError when the disk refuses.
        """
        if not math.isfinite(time) or (self._times and time <= self._times[-1]):
            last = f"{self._times[-1]:g} s" if self._times else "none"
            raise ValueError(f"time = {time:g} s of a field must be after the last one ({last})")
        ambient = self._model.parameters.ambient.temperature_degC
        belt = seen_belt(self._model)[1].ravel() - ambient
        rise = np.concatenate((belt, self._model.ice.at_points()))
        data = {"temperature_degC": ambient + rise, "rise_K": rise}
        # what would thicken the stretched view once more is in the true one alone
        more = {NAME: {"stretch_m": self._stretch}}
        files = [self._write_view(name, data | more.get(name, {})) for name in self._views]
        self._times.append(time)
        for name in self._views:
            self._write_collection(name)
        return files[0]

    def _write_view(self, name: str, data: dict[str, Array]) -> Path:
        path = self.folder / _file_name(name, len(self._times))
        mesh = meshio.Mesh(
            self._views[name], self._cells, point_data=data, cell_data={"part": self._part}
        )
        partial = path.with_suffix(".partial")
        mesh.write(partial, file_format="vtu")
        os.replace(partial, path)
        return path

    def _write_collection(self, name: str) -> None:
        root = ElementTree.Element(
            "VTKFile", type="Collection", version="0.1", byte_order="LittleEndian"
        )
        entries = ElementTree.SubElement(root, "Collection")
        for number, time in enumerate(self._times):
            entry = {"timestep": repr(time), "group": "", "part": "0"}
            ElementTree.SubElement(entries, "DataSet", entry, file=_file_name(name, number))
        path = collection(self.folder, name)
        partial = path.with_suffix(".partial")
        ElementTree.ElementTree(root).write(partial, encoding="utf-8", xml_declaration=True)
        os.replace(partial, path)


def _file_name(name: str, number: int) -> str:
    return f"{name}_{number:05d}.vtu"
