"""Where block, attachments and anchors are, seen from above."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from stickslip import Parameters
from stickslip.kernel.layout import P_ANCHOR, P_ATTACH

Array = NDArray[np.float64]


class Pose(NamedTuple):
    """Position (m) and rotation (rad) of the block in the frame of the rig."""

    x: float
    y: float
    phi: float


REST = Pose(0.0, 0.0, 0.0)


def anchors(parameters: Parameters) -> Array:
    """Fixed ends of the springs (4, 2), m."""
    return np.array(parameters.pack()[P_ANCHOR : P_ANCHOR + 8]).reshape(4, 2)


def attachments(parameters: Parameters, pose: Pose) -> Array:
    """Ends of the springs on the block (4, 2), m: (x, y) + R(phi) b_i."""
    arms = np.array(parameters.pack()[P_ATTACH : P_ATTACH + 8]).reshape(4, 2)
    c, s = np.cos(pose.phi), np.sin(pose.phi)
    return np.array([pose.x, pose.y]) + arms @ np.array([[c, s], [-s, c]])


def coil(begin: Array, end: Array, turns: int = 9, width: float = 0.006) -> Array:
    """A spring drawn as a zigzag from ``begin`` to ``end`` (2,), m: (2 turns + 4, 2)."""
    along = end - begin
    length = np.hypot(*along)
    across = np.array([-along[1], along[0]]) / length
    stations = np.concatenate([[0.0], np.linspace(0.12, 0.88, 2 * turns + 2), [1.0]])
    swing = np.zeros(stations.size)
    swing[2:-2] = 0.5 * width * np.where(np.arange(stations.size - 4) % 2, 1.0, -1.0)
    return begin + stations[:, None] * along + swing[:, None] * across
