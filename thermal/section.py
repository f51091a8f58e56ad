"""The section y = 0 of a mesh of tetrahedra, seen on a grid."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix

Array = NDArray[np.float64]
Cells = NDArray[np.int64]

#: Barycentric coordinates that are negative by rounding are zero.
_ROUNDING = 1e-9


def section(points: Array, cells: Cells, x: Array, z: Array) -> csr_matrix:
    """Linear interpolation (x.size * z.size, nodes) to the grid of x by z (m) in the plane y = 0.

    Rows of grid points outside the mesh are empty.
    """
    grid = np.stack(np.meshgrid(x, [0.0], z, indexing="ij"), axis=-1).reshape(-1, 3)
    y = points[cells][:, :, 1]
    crossing = cells[(y.min(axis=1) <= 0.0) & (y.max(axis=1) >= 0.0)]
    rows, columns, weights = [], [], []
    for cell in crossing:
        corners = points[cell]
        slack = _ROUNDING * (corners.max(axis=0) - corners.min(axis=0))
        near = np.flatnonzero(np.all(
            (grid >= corners.min(axis=0) - slack) & (grid <= corners.max(axis=0) + slack), axis=1))
        inner = np.linalg.solve((corners[1:] - corners[0]).T, (grid[near] - corners[0]).T)
        shares = np.concatenate((1.0 - inner.sum(axis=0, keepdims=True), inner))
        inside = np.all(shares >= -_ROUNDING, axis=0)
        rows.append(np.repeat(near[inside], 4))
        columns.append(np.tile(cell, int(inside.sum())))
        weights.append(shares[:, inside].T.ravel())
    row = np.concatenate([np.zeros(0, dtype=np.int64), *rows])
    column = np.concatenate([np.zeros(0, dtype=np.int64), *columns])
    weight = np.concatenate([np.zeros(0), *weights])
    # a point on a facet is found in both its cells
    found = csr_matrix((weight, (row, column)), shape=(len(grid), len(points)))
    count = np.bincount(row, weight, minlength=len(grid))
    return csr_matrix(found.multiply(1.0 / np.where(count > 0.0, count, 1.0)[:, None]))
