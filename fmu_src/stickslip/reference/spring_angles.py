"""The study's spring angles and stiffness matrices: K = k sum g_i g_i^T.

g_i = (C, D, D A - C B) with A = r cos beta_i, B = r sin beta_i, C = cos alpha_i, D = sin alpha_i.
The source runs compiled as well as interpreted.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

TREATMENTS = ("zero", "constant", "opposed", "updated")
SMALL_ANGLE = math.radians(1.0)  # the study's constant spring angle

ATTACHMENT_RADIUS = 0.05
ATTACHMENT_ANGLES = np.radians([160.0, 20.0, 200.0, 340.0])


def treatment_number(name: str) -> int:
    """Place of a treatment in `TREATMENTS`; ValueError for an unknown one."""
    if name not in TREATMENTS:
        raise ValueError(f"alpha treatment {name!r}: allowed are {', '.join(TREATMENTS)}")
    return TREATMENTS.index(name)


def fixed_angles(treatment: str) -> np.ndarray:
    """alpha (4,), rad, as the run begins."""
    signs = {
        "zero": (0.0, 0.0, 0.0, 0.0),
        "constant": (1.0, 1.0, 1.0, 1.0),
        "opposed": (1.0, 1.0, -1.0, -1.0),
        "updated": (0.0, 0.0, 0.0, 0.0),
    }
    treatment_number(treatment)
    return SMALL_ANGLE * np.array(signs[treatment])


@njit(cache=True)
def updated_angles(phi, attachment, beta, reach, length, mirrored, alpha):
    """Write alpha (4,) = arctan(rise / length) into ``alpha``.

    rise = reach [sin(beta + phi) - sin beta]; the study's reach is 1 where the attachment radius
    belongs. A spring that comes from the +x side is the mirror image: its angle has the opposite
    sign, which the study leaves out.
    """
    for i in range(4):
        rise = reach * (math.sin(beta[i] + phi) - math.sin(beta[i]))
        alpha[i] = math.atan2(rise, length)
        if mirrored and attachment[i, 0] > 0.0:
            alpha[i] = -alpha[i]


@njit(cache=True)
def stiffness_over_k(alpha, attachment, matrix):
    """Write K/k (3, 3) for angles ``alpha`` (4,) and attachments (4, 2), m, into ``matrix``."""
    matrix[:, :] = 0.0
    g = np.empty(3)
    for i in range(4):
        c, d = math.cos(alpha[i]), math.sin(alpha[i])
        g[0] = c
        g[1] = d
        g[2] = d * attachment[i, 0] - c * attachment[i, 1]
        for row in range(3):
            for column in range(3):
                matrix[row, column] += g[row] * g[column]


def attachments(
    radius: float = ATTACHMENT_RADIUS, angles: np.ndarray = ATTACHMENT_ANGLES
) -> np.ndarray:
    """(4, 2): x and y of the spring attachments from the block's centre, m."""
    # mirror images cancel exactly: no rotation grows out of the last bit of sin 160 degrees
    return radius * np.round(np.stack([np.cos(angles), np.sin(angles)], axis=1), 15)


def stiffness_matrix(alpha: np.ndarray) -> np.ndarray:
    """K/k (3, 3) of the study's rig for spring angles alpha (4,), rad; 1, m, m2."""
    matrix = np.empty((3, 3))
    stiffness_over_k(np.asarray(alpha, dtype=float), attachments(), matrix)
    return matrix
