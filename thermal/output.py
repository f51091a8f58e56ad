"""Temperature of belt and ice as somebody beside the rig sees it: arrays, and files for ParaView.

x = 0 is the centre of the contact, z = 0 the contact face, metres. The belt lies below (the loop
cut opposite the contact, its temperatures interpolated linearly to this frame), the ice stands
above: of a cylinder the section through its axis, of a sample all of it.

The series of files is one VTU file (written by meshio) for each time and a PVD collection that
names them. A file appears under its name only when it is complete and the collection is replaced
as a whole, so whatever interrupts a run, what was written before stays readable.
"""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import meshio
import numpy as np
from numpy.typing import NDArray

from .grids import grid_points, quadrilaterals
from .model import BeltIceModel

Array = NDArray[np.float64]


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
    place = (model.contact_position + offset) / cell
    node = np.floor(place).astype(np.int64)
    part = (place - node)[:, None]
    return offset, (1.0 - part) * field[node % cells] + part * field[(node + 1) % cells]


def rig_view(model: BeltIceModel) -> RigView:
    """What the model holds now."""
    offset, belt = seen_belt(model)
    x, height, rise = model.ice.section()
    ice = model.parameters.ambient.temperature_degC + rise
    return RigView(offset, model.belt.depth, belt, x, height, ice, model.footprint.length)


def collection(folder: str | Path, name: str = "temperature") -> Path:
    """The file of a series that names the others."""
    return Path(folder) / f"{name}.pvd"


#: Thickness of the stretched belt as a part of its length.
STRETCHED = 0.1


class FieldSeries:
    """Writes `<name>.pvd` and `<name>_<number>.vtu` into a folder that exists.

    Point data `temperature_degC`, `rise_K` over the air, and `stretch_m`: with the filter Warp By
    Vector the belt, a line to the eye, becomes `STRETCHED` as thick as it is long. Cell data `part`
    (0 belt, 1 ice). An earlier series of that name is replaced from its first file on. times: of
    the fields (s) that an earlier process wrote and this one goes on from; then from the next one.
    """

    def __init__(
        self,
        folder: str | Path,
        model: BeltIceModel,
        name: str = "temperature",
        times: Sequence[float] = (),
    ) -> None:
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise ValueError(f"{self.folder}: no such folder for the temperature fields")
        self.name = name
        self._model = model
        self._written = [(time, self._file_name(n)) for n, time in enumerate(times)]
        belt, ice = model.belt, model.ice
        self._below = grid_points(seen_belt(model)[0], -belt.depth)
        below = quadrilaterals(belt.cells + 1, belt.depth.size)
        self._stretch = self._stretched()
        self._cells = [("quad", below), (ice.cell_type, ice.cells + len(self._below))]
        self._part = [
            np.full(len(cells), part, dtype=np.int32) for part, (_, cells) in enumerate(self._cells)
        ]

    def _file_name(self, number: int) -> str:
        return f"{self.name}_{number:05d}.vtu"

    @property
    def path(self) -> Path:
        """The collection, the one file to open."""
        return collection(self.folder, self.name)

    def _point_data(self) -> dict[str, Array]:
        """Arrays over all points, by names with units."""
        ambient = self._model.parameters.ambient.temperature_degC
        belt = seen_belt(self._model)[1].ravel() - ambient
        rise = np.concatenate((belt, self._model.ice.at_points()))
        return {
            "temperature_degC": ambient + rise,
            "rise_K": rise,
            "stretch_m": self._stretch,
        }

    def _stretched(self) -> Array:
        """Displacements (points, 3) m that thicken the belt; the ice stays."""
        below = self._below
        length, depth = np.ptp(below[:, 0]), -below[:, 2].min()
        moved = np.zeros((len(below) + len(self._model.ice.points), 3))
        moved[: len(below), 2] = (STRETCHED * length / depth - 1.0) * below[:, 2]
        return moved

    def write(self, time: float) -> Path:
        """Add the model's present fields at time (s); returns the VTU file.

        ValueError when time is not after the last one written; OSError when the disk refuses.
        """
        if not math.isfinite(time) or (self._written and time <= self._written[-1][0]):
            last = f"{self._written[-1][0]:g} s" if self._written else "none"
            raise ValueError(f"time = {time:g} s of a field must be after the last one ({last})")
        path = self.folder / self._file_name(len(self._written))
        points = np.concatenate((self._below, self._model.ice.points))
        mesh = meshio.Mesh(
            points,
            self._cells,
            point_data=self._point_data(),
            cell_data={"part": self._part},
        )
        partial = path.with_suffix(".partial")
        mesh.write(partial, file_format="vtu")
        os.replace(partial, path)
        self._written.append((time, path.name))
        self._write_collection()
        return path

    def _write_collection(self) -> None:
        root = ElementTree.Element(
            "VTKFile", type="Collection", version="0.1", byte_order="LittleEndian"
        )
        collection = ElementTree.SubElement(root, "Collection")
        for time, file in self._written:
            ElementTree.SubElement(
                collection, "DataSet", timestep=repr(time), group="", part="0", file=file
            )
        partial = self.path.with_suffix(".partial")
        ElementTree.ElementTree(root).write(partial, encoding="utf-8", xml_declaration=True)
        os.replace(partial, self.path)
