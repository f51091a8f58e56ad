"""Belt and ice as somebody beside the rig sees them: the contact's centre at x = 0."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

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
    offset = (np.arange(cells + 1) - cells / 2) * cell
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
