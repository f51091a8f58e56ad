"""The section y = 0 of finite elements on tetrahedra, seen on a grid."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix
from skfem import CellBasis

Array = NDArray[np.float64]

#: Barycentric coordinates that are negative by rounding are zero.
_ROUNDING = 1e-9


def section(basis: CellBasis, x: Array, z: Array) -> csr_matrix:
    """Evaluation (x.size * z.size, N) on the grid of x by z (m) in the plane y = 0.

    Rows of grid points outside the mesh are empty.
    """
    grid = np.stack(np.meshgrid(x, [0.0], z, indexing="ij"), axis=-1).reshape(-1, 3)
    corners = basis.mesh.p[:, basis.mesh.t].transpose(2, 1, 0)
    y = corners[:, :, 1]
    # from the last to the first: of the cells that share a point, the first one gives its value
    of_point = np.full(len(grid), -1)
    local = np.zeros((3, len(grid)))
    for cell in np.flatnonzero((y.min(axis=1) <= 0.0) & (y.max(axis=1) >= 0.0))[::-1]:
        near, inner = _inside(grid, corners[cell])
        of_point[near], local[:, near] = cell, inner
    found = np.flatnonzero(of_point >= 0)
    dofs = basis.element_dofs[:, of_point[found]]
    weights = [basis.elem.lbasis(local[:, found], i)[0] for i in range(len(dofs))]
    return csr_matrix(
        (np.concatenate(weights), (np.tile(found, len(dofs)), dofs.ravel())),
        shape=(len(grid), basis.N),
    )


def _inside(grid: Array, corners: Array) -> tuple[NDArray[np.intp], Array]:
    """Which grid points lie in a tetrahedron (4, 3), and their local coordinates (3, k)."""
    low, high = corners.min(axis=0), corners.max(axis=0)
    slack = _ROUNDING * (high - low)
    near = np.flatnonzero(np.all((grid >= low - slack) & (grid <= high + slack), axis=1))
    inner = np.linalg.solve((corners[1:] - corners[0]).T, (grid[near] - corners[0]).T)
    inside = (inner.min(axis=0, initial=1.0) >= -_ROUNDING) & (inner.sum(axis=0) <= 1.0 + _ROUNDING)
    return near[inside], inner[:, inside]
