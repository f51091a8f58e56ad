"""The study's spring angles and stiffness matrices: K = k sum g_i g_i^T.

g_i = (C, D, D A - C B) with A = r cos beta_i, B = r sin beta_i, C = cos alpha_i, D = sin alpha_i.
"""

import math

import numpy as np

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


def attachments(
    radius: float = ATTACHMENT_RADIUS, angles: np.ndarray = ATTACHMENT_ANGLES
) -> np.ndarray:
    """(4, 2): x and y of the spring attachments from the block's centre, m."""
    # mirror images cancel exactly: no rotation grows out of the last bit of sin 160 degrees
    return radius * np.round(np.stack([np.cos(angles), np.sin(angles)], axis=1), 15)


def stiffness_matrix(alpha: np.ndarray, radius: float = ATTACHMENT_RADIUS) -> np.ndarray:
    """K/k (3, 3) for spring angles alpha (4,), rad, and attachments at a radius, m; 1, m, m2."""
    c, d = np.cos(alpha), np.sin(alpha)
    x, y = attachments(radius).T
    g = np.stack([c, d, d * x - c * y])
    return np.asarray(g @ g.T)
