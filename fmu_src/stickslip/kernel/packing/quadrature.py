"""Tables by which `friction.disc` integrates over the contact."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

from .. import Floats
from ..layout import DEPTHS, P_QUADRATURE, Q_DEPTH, Q_RAY, Q_STRIP, RAYS


def set_quadrature(p: Floats) -> None:
    """Angles of strips and rays (midpoint rule) and Gauss-Legendre nodes with their weights."""
    set_angles(p, P_QUADRATURE + Q_STRIP, 2 * RAYS)
    set_angles(p, P_QUADRATURE + Q_RAY, RAYS)
    set_nodes(p, P_QUADRATURE + Q_DEPTH)


def set_angles(p: Floats, at: int, parts: int) -> None:
    """Cosine and squared sine of RAYS midpoints, of so many parts that make half a turn."""
    for j in range(RAYS):
        angle = (j + 0.5) * pi / parts
        p[at + j] = cos(angle)
        p[at + RAYS + j] = sin(angle) * sin(angle)


def set_nodes(p: Floats, at: int) -> None:
    """The four nodes between -1 and 1, in pairs from the inner to the outer, then the weights."""
    inner = -1.0
    for j in range(2):
        root = sqrt(3.0 / 7.0 + inner * 2.0 / 7.0 * sqrt(6.0 / 5.0))
        weight = (18.0 - inner * sqrt(30.0)) / 36.0
        p[at + 2 * j] = -root
        p[at + 2 * j + 1] = root
        p[at + DEPTHS + 2 * j] = weight
        p[at + DEPTHS + 2 * j + 1] = weight
        inner = 1.0
