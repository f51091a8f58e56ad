"""A sample's mesh: tetrahedra on the plane z = 0 from a file, in metres, cut thin at the base.

Any format that meshio reads (Gmsh .msh, VTK .vtk and .vtu, Abaqus, Nastran, ...). Of curved
tetrahedra the corners are taken. What would give wrong temperatures is refused: what is not one
piece, is folded or flat somewhere, has a hollow inside, or is in another unit.

Why `layered` cuts them: heat that enters the base is first only tenths of a millimetre deep, less
than any element of a mesh that somebody made for its shape. So the elements at the base are cut
parallel to it: every edge from a node of the base to one above is cut at 0.4 of its length, five
cuts make a layer 1/98 as high. The sample's shape stays exactly what it is. Under a constant flux
such layers of P2 elements err by 0.07 % of the face's rise, layers cut at a third by 0.16 %, at a
half by 0.02 %.
"""

import contextlib
import io
from collections.abc import Sequence
from pathlib import Path

import meshio
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from skfem import MeshTet

from thermal.arrays import Array
from thermal.parameters import ParameterError

Cells = NDArray[np.int64]

#: Largest and smallest extent of a sample, m: outside lies a slip of the unit.
LARGEST, SMALLEST = 2.0, 2e-3

#: Heights, relative to the sample's, that are the same.
FLAT = 1e-6

#: Volume of an element over the cube of its longest edge, below which it counts as flat.
THINNEST = 1e-9

_TETRAHEDRA = {"tetra", "tetra10"}

#: Of a mesh file: ten times what the most unknowns take.
MOST_BYTES = 256 * 2**20


class MeshError(ParameterError):
    """A mesh that cannot be a sample of ice; one line: file, what is wrong, what is allowed."""


def read_sample(file: str | Path) -> tuple[Array, Cells]:
    """Nodes (nodes, 3) m and tetrahedra (cells, 4) of a sample that stands on z = 0.

    MeshError when the file is none, or not such a mesh.
    """
    file = Path(file)
    points, cells = _volume(file, _read(file))
    fault = (
        _fault_of_size(points)
        or _fault_of_elements(points, cells)
        or _fault_of_surface(points, cells)
    )
    if fault:
        raise MeshError(f"{file}: {fault}")
    return points, cells


def _read(file: Path) -> meshio.Mesh:
    if not file.is_file():
        raise MeshError(f"{file}: no such file, allowed is a mesh of tetrahedra")
    if (size := file.stat().st_size) > MOST_BYTES:
        raise MeshError(f"{file}: {size >> 20} MiB, allowed are {MOST_BYTES >> 20} MiB")
    said = io.StringIO()
    try:
        # meshio prints what it finds wrong and ends the process for some files
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            return meshio.read(file)
    except (SystemExit, Exception) as error:  # readers of forty formats, each with its own errors
        told = said.getvalue() if isinstance(error, SystemExit) else str(error)
        why = " ".join(told.split())[:120] or type(error).__name__
        raise MeshError(
            f"{file}: cannot be read as a mesh ({why}), allowed is a file that meshio"
            " reads, such as .msh, .vtk or .vtu"
        ) from error


def _volume(file: Path, mesh: meshio.Mesh) -> tuple[Array, Cells]:
    """Tetrahedra and their nodes, without those that no tetrahedron uses."""
    blocks = [block.data[:, :4] for block in mesh.cells if block.type in _TETRAHEDRA]
    others = {block.type for block in mesh.cells if block.dim == 3} - _TETRAHEDRA
    if not blocks or others:
        found = ", ".join(sorted(others or {block.type for block in mesh.cells})) or "nothing"
        what = "has other volume cells" if others else "has no volume cells"
        raise MeshError(f"{file}: {what} ({found}), allowed are tetrahedra")
    points = np.asarray(mesh.points, dtype=np.float64)
    cells = np.concatenate(blocks).astype(np.int64)
    if cells.size == 0 or cells.min() < 0 or cells.max() >= len(points):
        raise MeshError(f"{file}: its tetrahedra name nodes that are not there")
    used, cells = np.unique(cells, return_inverse=True)
    if points.shape[1] != 3 or not np.isfinite(points[used]).all():
        raise MeshError(f"{file}: has nodes without three finite coordinates")
    return points[used], cells.reshape(-1, 4)


def _fault_of_size(points: Array) -> str | None:
    low, high = points.min(axis=0), points.max(axis=0)
    extent = high - low
    size = " x ".join(f"{x:g}" for x in extent)
    if extent.max() > LARGEST:
        unit = "mm" if extent.max() > 10.0 * LARGEST else "cm"
        return (
            f"the sample is {size} m, allowed is up to {LARGEST:g} m: is the file in {unit}?"
            f" Coordinates are in metres"
        )
    if extent.min() < SMALLEST:
        return f"the sample is {size} m, allowed is at least {SMALLEST:g} m each way"
    if abs(low[2]) > FLAT * extent[2]:
        return f"its lowest node is at z = {low[2]:g} m, allowed is a base at z = 0"
    return None


def _fault_of_elements(points: Array, cells: Cells) -> str | None:
    corners = points[cells]
    edges = corners[:, 1:] - corners[:, :1]
    volume = np.abs(np.linalg.det(edges)) / 6.0
    longest = np.linalg.norm(
        np.concatenate(
            (edges, np.diff(corners[:, 1:], axis=1), corners[:, 1:2] - corners[:, 3:]), axis=1
        ),
        axis=2,
    ).max(axis=1)
    flat = int(np.count_nonzero(volume <= THINNEST * longest**3))
    if flat:
        return f"{flat} of its {len(cells)} tetrahedra have no volume"
    return None


def mesh_of(points: Array, cells: Cells) -> MeshTet:
    """Nodes (nodes, 3) and tetrahedra (cells, 4) as scikit-fem has them."""
    return MeshTet(np.ascontiguousarray(points.T), np.ascontiguousarray(cells.T))


def _fault_of_surface(points: Array, cells: Cells) -> str | None:
    mesh = mesh_of(points, cells)
    count = np.bincount(mesh.t2f.ravel())
    if count.max() > 2:
        return f"{np.count_nonzero(count > 2)} facets belong to more than two tetrahedra"
    surface = mesh.facets[:, count == 1].T
    return _fault_of_neighbours(mesh, count == 2) or _fault_of_boundary(points, surface)


def _fault_of_neighbours(mesh: MeshTet, inner: NDArray[np.bool_]) -> str | None:
    """Tetrahedra hang together, and lie on opposite sides of the facet between them."""
    facets, (one, two) = mesh.facets[:, inner], mesh.f2t[:, inner]
    graph = coo_matrix((np.ones(one.size), (one, two)), shape=(mesh.nelements,) * 2)
    pieces = connected_components(graph, directed=False)[0]
    if pieces > 1:
        return (
            f"it falls into {pieces} pieces that share no facet, allowed is one: merge nodes at"
            " the same place, keep one body"
        )
    a, b, c = (mesh.p[:, nodes].T for nodes in facets)
    normal = np.cross(b - a, c - a)
    # of each tetrahedron the corner that is not on the facet
    apexes = [mesh.t[:, cells].sum(axis=0) - facets.sum(axis=0) for cells in (one, two)]
    heights = [np.einsum("ij,ij->i", mesh.p[:, apex].T - a, normal) for apex in apexes]
    folded = int(np.count_nonzero(heights[0] * heights[1] >= 0.0))
    return f"{folded} pairs of tetrahedra overlap: the mesh is folded" if folded else None


def _fault_of_boundary(points: Array, surface: Cells) -> str | None:
    """The surface is closed and in one piece, and a part of it is the base."""
    edges = np.sort(
        np.concatenate([surface[:, [0, 1]], surface[:, [1, 2]], surface[:, [0, 2]]]), axis=1
    )
    _, number, count = np.unique(edges, axis=0, return_inverse=True, return_counts=True)
    if np.any(count != 2):
        return (
            f"its surface is not closed: {np.count_nonzero(count != 2)} edges do not lie"
            " between two facets"
        )
    belongs = coo_matrix(
        (np.ones(number.size), (np.tile(np.arange(len(surface)), 3), number.ravel()))
    )
    shells = connected_components(belongs @ belongs.T, directed=False)[0]
    if shells > 1:
        return f"it has {shells - 1} hollows inside, allowed is solid ice"
    if not base_of(points, surface).any():
        return "it has no flat base at z = 0, allowed is a face of the sample on that plane"
    return None


def base_of(points: Array, surface: Cells) -> NDArray[np.bool_]:
    """Which facets of the surface lie on the plane z = 0."""
    height = points[:, 2].max()
    found: NDArray[np.bool_] = np.all(np.abs(points[surface][:, :, 2]) <= FLAT * height, axis=1)
    return found


Nodes = NDArray[np.bool_]

#: Where an edge from the base upwards is cut.
CUT = 0.4


#: Highest layer of elements at the base, m: heat is as deep after 40 ms.
THIN = 2e-4


def layered(points: Array, cells: Cells) -> tuple[Array, Cells]:
    """The mesh with layers at the base as thin as `THIN`."""
    while True:
        base = points[:, 2] <= FLAT * points[:, 2].max()
        if layer_height(points, cells, base) <= THIN:
            return points, cells
        points, cells = cut_at_base(points, cells, base)


def layer_height(points: Array, cells: Cells, base: Nodes) -> float:
    """Mean height (m) of the elements with a facet on the base; base: (nodes,)."""
    standing = cells[base[cells].sum(axis=1) == 3]
    return float(points[standing][:, :, 2].max(axis=1).mean())


def cut_at_base(points: Array, cells: Cells, base: Nodes) -> tuple[Array, Cells]:
    """One more layer of elements; base: (nodes,), which nodes lie on the base.

    Nodes (more, 3) m, of which the first are those of before, and tetrahedra (more, 4).
    """
    lower = base[cells]
    below = lower.sum(axis=1)
    # the corners on the base first
    ordered = np.take_along_axis(cells, np.argsort(~lower, axis=1, kind="stable"), axis=1)
    edges = np.concatenate(
        [ordered[below == n][:, [i, j]] for n in (1, 2, 3) for i in range(n) for j in range(n, 4)]
    )
    keys = np.unique(edges[:, 0] * len(points) + edges[:, 1])
    start, end = points[keys // len(points)], points[keys % len(points)]

    def cut(start: Cells, end: Cells) -> Cells:
        """Numbers of the nodes where edges (k,) are cut."""
        return len(points) + np.searchsorted(keys, start * len(points) + end)

    pieces = [ordered[(below == 0) | (below == 4)]]
    a, *tops = ordered[below == 1].T
    middles = [cut(a, top) for top in tops]
    pieces += [np.stack((a, *middles), axis=1), _prisms(middles, tops)]
    a, b, c, d = ordered[below == 2].T
    pieces += [
        _prisms((a, cut(a, c), cut(a, d)), (b, cut(b, c), cut(b, d))),
        _prisms((c, cut(a, c), cut(b, c)), (d, cut(a, d), cut(b, d))),
    ]
    *bottoms, top = ordered[below == 3].T
    middles = [cut(bottom, top) for bottom in bottoms]
    pieces += [_prisms(bottoms, middles), np.stack((*middles, top), axis=1)]
    return np.concatenate((points, start + CUT * (end - start))), np.concatenate(pieces)


def _prisms(one: Sequence[Cells], other: Sequence[Cells]) -> Cells:
    """Prisms between two triangles, each three arrays (k,) of nodes, as tetrahedra (3 k, 4).

    The diagonal of a side leaves from its lowest node, so that neighbours agree (Dompierre,
    Labbe, Vallet and Camarero, How to subdivide pyramids, prisms and hexahedra into tetrahedra,
    1999).
    """
    prisms = np.stack((*one, *other), axis=1)
    lowest = prisms.argmin(axis=1)
    turns = (np.arange(3)[:, None] + np.arange(3)) % 3
    orders = np.concatenate(
        [np.concatenate((turns, turns + 3), axis=1), np.concatenate((turns + 3, turns), axis=1)]
    )
    p = np.take_along_axis(prisms, orders[lowest], axis=1)
    rising = np.minimum(p[:, 1], p[:, 5]) < np.minimum(p[:, 2], p[:, 4])
    first, second = p[rising], p[~rising]
    return np.concatenate(
        (
            first[:, [0, 1, 2, 5]],
            first[:, [0, 1, 5, 4]],
            first[:, [0, 4, 5, 3]],
            second[:, [0, 1, 2, 4]],
            second[:, [0, 4, 2, 5]],
            second[:, [0, 4, 5, 3]],
        )
    )
