"""Meshes of tetrahedra that stand on z = 0, made as somebody with a mesher would make them."""

import meshio
import numpy as np
from skfem import MeshTet


def box(cells, extent):
    """Box of given extent (m) on z = 0: nodes (nodes, 3), tetrahedra (cells, 4)."""
    x, y, z = (np.linspace(0.0, length, n + 1) for n, length in zip(cells, extent, strict=True))
    mesh = MeshTet.init_tensor(x - 0.5 * extent[0], y - 0.5 * extent[1], z)
    return mesh.p.T.copy(), mesh.t.T.copy()


def cylinder(across, up, radius=0.04, height=0.1):
    """Cylinder with `across` cells on a diameter; its boundary is a polygon on the circle."""
    points, cells = box((across, across, up), (2.0, 2.0, height))
    x, y = points[:, 0].copy(), points[:, 1].copy()
    points[:, 0] = radius * x * np.sqrt(1.0 - 0.5 * y**2)
    points[:, 1] = radius * y * np.sqrt(1.0 - 0.5 * x**2)
    return points, cells


def write(path, points, cells, kind="tetra"):
    """A mesh file in the format of its suffix."""
    meshio.Mesh(points, [(kind, cells)]).write(path)
    return path
