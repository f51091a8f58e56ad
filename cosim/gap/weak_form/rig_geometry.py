"""Force of the four springs on the block, for whole tracks at once."""

from __future__ import annotations

import numpy as np

from cosim.gap.data.campaign_file import Rig


def spring_force(
    rig: Rig,
    stiffness: float,
    x: np.ndarray,
    y: np.ndarray | float = 0.0,
    phi: np.ndarray | float = 0.0,
    turned: float = 0.0,
) -> tuple[np.ndarray, np.ndarray]:
    """(n,) forces along x and y on the block at places (n,), N: of `spring_loads`."""
    return spring_loads(rig, stiffness, x, y, phi, turned)[:2]


def spring_loads(
    rig: Rig,
    stiffness: float,
    x: np.ndarray,
    y: np.ndarray | float = 0.0,
    phi: np.ndarray | float = 0.0,
    turned: float = 0.0,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(n,) forces along x and y and moments on the block at places (n,), N, N m; exact geometry.

    stiffness : of one spring, N/m; x, y : m; phi : rad; turned : of every spring about its
    attachment, rad (the effect spring_misalignment)
    """
    x = np.asarray(x, dtype=float)
    along, across, moment = np.zeros_like(x), np.zeros_like(x), np.zeros_like(x)
    cos_phi, sin_phi = np.cos(phi), np.sin(phi)
    for angle in np.deg2rad(rig.attachment_angles_deg):
        bx, by = rig.attachment_radius * np.cos(angle), rig.attachment_radius * np.sin(angle)
        outward = rig.spring_length if bx >= 0.0 else -rig.spring_length
        arm_x, arm_y = cos_phi * bx - sin_phi * by, sin_phi * bx + cos_phi * by
        dx = bx + outward * np.cos(turned) - x - arm_x
        dy = by + outward * np.sin(turned) - y - arm_y
        length = np.sqrt(dx * dx + dy * dy)
        pull = stiffness * (1.0 - rig.spring_natural_length / length)
        along += pull * dx
        across += pull * dy
        moment += pull * (arm_x * dy - arm_y * dx)
    return along, across, moment


def extensions(rig: Rig, x: np.ndarray) -> np.ndarray:
    """(4, n) extensions of the springs over their natural length with the block at x (n,), m."""
    angles = np.deg2rad(rig.attachment_angles_deg)
    side = np.where(np.cos(angles) >= 0.0, 1.0, -1.0)
    stretched = rig.spring_length - rig.spring_natural_length
    return stretched - side[:, None] * np.asarray(x)[None, :]
