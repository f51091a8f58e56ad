"""A sample of ice of any shape, from a mesh of tetrahedra: three-dimensional P2 (scikit-fem).

The belt runs along x below the base z = 0 and covers |y| <= half its width; the part of the base
on it is the contact. Newton cooling on all of the surface but the base. The elements at the base
are cut into thin layers, and the assembled problem is reduced to the space of its answers to a flux
on the contact (`response_space`), whose eigenmodes are advanced exactly.

How exact: between 0.1 ms and a day the face's answer to a constant flux is that of the assembled
mesh to 1e-6. The mesh's own error remains, as does that of a base facet that the belt's edge
crosses: it counts by quadrature.

That space is a small one, and right for a body of any shape. Heat conduction C u' + K u = b p(t)
with one load b and the mean over the same contact as what is asked for has the transfer function
b^T (s C + K)^-1 b. The Galerkin space of the solutions of (s C + K) u = b for shifts s interpolates
it, with its derivative, at every shift, and stays symmetric and dissipative (rational Krylov space;
Antoulas, Approximation of Large-Scale Dynamical Systems, 2005). The error falls geometrically with
the number of shifts in a decade. With the constant in the space, heat is conserved to rounding.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_matrix, diags
from scipy.sparse.linalg import cg
from skfem import CellBasis, ElementTetP2, FacetBasis

from thermal.arrays import Array, graded
from thermal.assembly import Body
from thermal.materials import Medium

from .body import IceBody
from .mesh_file import FLAT, MeshError, layered, mesh_of, read_sample
from .parameters import Ice

#: Most elements; more would take minutes and the memory.
MOST_CELLS = 400_000

#: Of the elements; the quadrature of degree 4 has a negative weight.
_QUADRATURE = 5

#: Places across and upwards at which the section is seen, and how they crowd at the base.
_ACROSS, _UP, _CROWDED = 81, 40, 300.0

#: Barycentric coordinates that are negative by rounding are zero.
_ROUNDING = 1e-9

#: A facet whose normal has more than this upwards counts as top.
_UPWARDS = np.sqrt(0.5)


class Sample(IceBody):
    """Temperature field of a sample from a mesh file; `amplitudes` (modes,).

    belt_width: m. `area` m2 of the contact, `breadth` m of the base across the belt. `points`
    (nodes, 3) m and `cells` (cells, 4): the mesh with its layers. `r`: places x of the section, m.
    MeshError: see `mesh_file`.
    """

    def __init__(self, parameters: Ice, file: str | Path, belt_width: float) -> None:
        points, cells = layered(*read_sample(file))
        if len(cells) > MOST_CELLS:
            raise MeshError(
                f"{file}: has {len(cells)} tetrahedra with the layers at its base,"
                f" allowed are up to {MOST_CELLS}: make it coarser"
            )
        body = assembled(parameters, points, cells, 0.5 * belt_width)
        load, area = body.contact()
        if not area > 0.0:
            raise MeshError(
                f"{file}: its base does not lie on the belt, |y| <= {0.5 * belt_width:g} m"
            )
        try:
            trial = response_space(body.capacity().tocsr(), body.conduction().tocsr(), load)
        except ArithmeticError as error:
            raise MeshError(f"{file}: {error}") from error
        super().__init__(body.space(trial))
        low, high = points[:, 2].min(), points[:, 2].max()
        on_base = points[points[:, 2] <= low + FLAT * high]
        self.area = area
        self.breadth: float = min(belt_width, float(np.ptp(on_base[:, 1])))
        self.basis = body.basis
        self.cells: NDArray[np.int64] = cells
        self._points = points
        self.r: Array = np.linspace(points[:, 0].min(), points[:, 0].max(), _ACROSS)
        self._z = graded(float(high), _UP, _CROWDED)
        self._section = _evaluation(body.basis, self.r, self._z)

    #: What `cells` are, in meshio's words.
    cell_type = "tetra"

    @property
    def points(self) -> Array:
        """Nodes of the mesh at its present height, m: (nodes, 3)."""
        return self._points * [1.0, 1.0, self.height_ratio]

    @property
    def z(self) -> Array:
        """Heights above the face at which the section is seen, m: (heights,)."""
        return self._z * self.height_ratio

    def field(self) -> Array:
        """Temperature rise in the plane y = 0 at `r` by `z`, K; NaN outside: (n, heights)."""
        inside = np.diff(self._section.indptr) > 0
        seen = np.where(inside, self._section @ self.nodal(), np.nan)
        return seen.reshape(self.r.size, self._z.size)

    def section(self) -> tuple[Array, Array, Array]:
        """The plane y = 0: x (n,) m, z (heights,) m, temperature rise (n, heights) K."""
        return self.r, self.z, self.field()

    def at_points(self) -> Array:
        """Temperature rise at `points`, K: (nodes,)."""
        found: Array = self.nodal()[self.basis.nodal_dofs[0]]
        return found


def assembled(parameters: Ice, points: Array, cells: NDArray[np.int64], half: float) -> Body:
    """P2 elements of a mesh on a belt that covers |y| <= half (m)."""
    height = float(points[:, 2].max())
    mesh = mesh_of(points, cells).with_boundaries({"base": lambda x: x[2] <= FLAT * height})
    free = np.setdiff1d(mesh.boundary_facets(), mesh.boundaries["base"])
    normals = FacetBasis(mesh, ElementTetP2(), facets=free, intorder=1).normals
    flat = np.abs(normals[2, :, 0]) > _UPWARDS

    def films(facets: NDArray[np.int64]) -> FacetBasis | None:
        return FacetBasis(mesh, ElementTetP2(), facets=facets) if facets.size else None

    return Body(
        basis=CellBasis(mesh, ElementTetP2(), intorder=_QUADRATURE),
        medium=Medium(parameters.density, parameters.heat_capacity, parameters.conductivity),
        h=parameters.air_heat_transfer,
        side=films(free[~flat]),
        top=films(free[flat]),
        bottom=FacetBasis(mesh, ElementTetP2(), facets="base", intorder=6),
        share=lambda x: np.where(np.abs(x[1]) <= half, 1.0, 0.0),
        measure=lambda x: 1.0 + 0.0 * x[0],
        height=height,
    )


def _evaluation(basis: CellBasis, x: Array, z: Array) -> csr_matrix:
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


#: Shifts, 1/s: from the first tenths of a millisecond to days, 2.5 in a decade.
SHIFTS = np.geomspace(1e4, 1e-6, 26)

#: A solution need not be exact to span the space: this changes the response by 1e-7 of itself.
_TOLERANCE = 1e-6
_MOST_ITERATIONS = 20_000

#: Directions that are the same but for this part are left out.
_DEPENDENT = 1e-11


def response_space(capacity: csr_matrix, conduction: csr_matrix, load: Array) -> Array:
    """Trial functions (N, n), orthonormal in the capacity; the first is constant.

    ArithmeticError when the equations cannot be solved.
    """
    ones = np.ones(load.size)
    space: Array = (ones / np.sqrt(ones @ (capacity @ ones)))[:, None]
    for shift in SHIFTS:
        system = (shift * capacity + conduction).tocsr()
        guess = space @ np.linalg.solve(space.T @ (system @ space), space.T @ load)
        found, failed = cg(
            system,
            load,
            x0=guess,
            rtol=_TOLERANCE,
            maxiter=_MOST_ITERATIONS,
            M=diags(1.0 / system.diagonal()),
        )
        if failed:
            raise ArithmeticError(
                f"its answer to heat at {shift:g} 1/s did not converge in {_MOST_ITERATIONS}"
                " iterations: are some of its elements very flat?"
            )
        space = _extended(space, found, capacity)
    return space


def _extended(space: Array, vector: Array, capacity: csr_matrix) -> Array:
    """Add a direction, unless it lies in the space; twice is enough."""
    size = np.sqrt(vector @ (capacity @ vector))
    for _ in range(2):
        vector = vector - space @ (space.T @ (capacity @ vector))
    left = np.sqrt(vector @ (capacity @ vector))
    return space if left <= _DEPENDENT * size else np.column_stack((space, vector / left))
