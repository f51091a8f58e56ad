"""Force of the four springs on the block, for whole tracks at once."""

from __future__ import annotations

import numpy as np

from cosim.gap.data.campaign_file import Rig


def spring_loads(
    rig: Rig, stiffness: float, x: np.ndarray, y: np.ndarray | float = 0.0,
    phi: np.ndarray | float = 0.0, turned: float = 0.0, frame: float = 0.0, diagonal: float = 0.0,
) -> np.ndarray:  # fmt: skip
    """(3, n) forces along x and y and moments on the block at places (n,), N, N m; exact geometry.

    stiffness : of one spring, N/m; x, y : m; phi : rad; turned : of every spring about its
    attachment, rad; frame : of all anchors about the middle, rad; diagonal : by which anchors 1
    and 4 are off along y, 2 and 3 the other way, m (the effect spring_misalignment). Complex steps
    pass through.
    """
    angles = np.deg2rad(rig.attachment_angles_deg)[:, None]
    bx, by = rig.attachment_radius * np.cos(angles), rig.attachment_radius * np.sin(angles)
    outward = np.where(bx >= 0.0, 1.0, -1.0) * rig.spring_length
    arm_x, arm_y = np.cos(phi) * bx - np.sin(phi) * by, np.sin(phi) * bx + np.cos(phi) * by
    ax, ay = bx + outward * np.cos(turned), by + outward * np.sin(turned)
    dx = np.cos(frame) * ax - np.sin(frame) * ay - x - arm_x
    aside = diagonal * np.array([[1.0], [-1.0], [-1.0], [1.0]])
    dy = np.sin(frame) * ax + np.cos(frame) * ay + aside - y - arm_y
    pull = stiffness * (1.0 - rig.spring_natural_length / np.sqrt(dx * dx + dy * dy))
    return np.asarray(np.sum([pull * dx, pull * dy, pull * (arm_x * dy - arm_y * dx)], axis=1))


def extensions(rig: Rig, x: np.ndarray) -> np.ndarray:
    """(4, n) extensions of the springs over their natural length with the block at x (n,), m."""
    angles = np.deg2rad(rig.attachment_angles_deg)
    side = np.where(np.cos(angles) >= 0.0, 1.0, -1.0)
    stretched = rig.spring_length - rig.spring_natural_length
    return np.asarray(stretched - side[:, None] * np.asarray(x)[None, :])
