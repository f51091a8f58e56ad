"""Contact points of the disc: rings of equal pressure, mirrored at the axis of the motion."""

from __future__ import annotations

import numpy as np

RINGS = (4, 8)  # points on each ring


def disc_points(radius: float, rings: tuple[int, ...] = RINGS) -> np.ndarray:
    """Points (x, y, share of the load) of a disc, shape (points, 3).

    Every point stands for the same area; a ring lies at the root-mean-square radius of its band,
    so that the polar moment of the points is that of the disc.
    """
    edges = np.sqrt(np.cumsum((0, *rings)) / sum(rings))
    rows = []
    for count, inner, outer in zip(rings, edges[:-1], edges[1:], strict=True):
        ring = radius * np.sqrt(0.5 * (inner**2 + outer**2))
        angle = 2 * np.pi * (np.arange(count) + 0.5) / count
        rows += [(ring * np.cos(a), ring * np.sin(a), 1.0 / sum(rings)) for a in angle]
    return np.array(rows)
