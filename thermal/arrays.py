"""Arrays as the whole package has them; tensor grids: their lines, and their cells for ParaView."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def graded(length: float, elements: int, stretch: float) -> Array:
    """Element boundaries from 0 to length, m; a geometric row, last over first is `stretch`."""
    sizes = stretch ** (np.arange(elements) / max(1, elements - 1))
    return np.concatenate(([0.0], np.cumsum(sizes) * (length / sizes.sum())))


def quadrilaterals(columns: int, rows: int) -> NDArray[np.int64]:
    """Cells of a grid of nodes, numbered row by row within each column: (cells, 4)."""
    corner = (np.arange(columns - 1)[:, None] * rows + np.arange(rows - 1)).ravel()
    return np.stack((corner, corner + rows, corner + rows + 1, corner + 1), axis=1)


def grid_points(x: Array, z: Array) -> Array:
    """Nodes of a grid in the plane y = 0: (columns * rows, 3), m."""
    grid = np.zeros((x.size, z.size, 3))
    grid[..., 0] = x[:, None]
    grid[..., 2] = z
    return grid.reshape(-1, 3)


def interpolated(field: Array, place: Array) -> Array:
    """Linearly, of nodes (n, ...) of which the last is followed by the first, at places (m,).

    A place is counted in nodes; it may lie loops ahead or behind.
    """
    node = np.floor(place).astype(np.int64)
    part = (place - node).reshape(-1, *[1] * (field.ndim - 1))
    found: Array = (1.0 - part) * field[node % len(field)] + part * field[(node + 1) % len(field)]
    return found
