"""The study's springs and friction: spring angles and stiffness matrices, the contact as strips.

K = k sum g_i g_i^T with g_i = (C, D, D A - C B), A = r cos beta_i, B = r sin beta_i,
C = cos alpha_i, D = sin alpha_i.

The contact disc is cut into strips along y, force = pressure x area. The mean of mu_k falls
linearly with a strip's sliding speed (slope 0: it does not). The scatter is normal. Strips scatter
independently, so force and moment of all strips together are normal too, with the variances
sum f_j^2 and sum (f_j y_j)^2 and no covariance (the strips are symmetric): two draws stand for a
hundred, exactly.
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


STRIPS = 100


def strips(radius: float) -> tuple[np.ndarray, np.ndarray]:
    """Shares of pi r^2 and middles y (m) of the strips, (100,) each.

    Areas by the trapezium, as the study takes them: they add up to 0.9989 of the disc.
    """
    edges = np.linspace(-radius, radius, STRIPS + 1)
    chord = 2.0 * np.sqrt(np.maximum(radius**2 - edges**2, 0.0))
    area = 0.5 * (chord[1:] + chord[:-1]) * np.diff(edges)
    return area / (math.pi * radius**2), 0.5 * (edges[1:] + edges[:-1])
