"""The standing cylinder of ice: axisymmetric (r, z), z upwards from the contact face.

P2 on a graded tensor mesh of quadrilaterals (scikit-fem), volume element 2 pi r dr dz; Newton
cooling on side and top, a flux on the part of the bottom that lies on the belt, nothing on the
rest of the bottom. All eigenmodes are kept. Temperatures are rises above the air.
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from skfem import CellBasis, ElementQuad2, FacetBasis, MeshQuad

from thermal.arrays import Array, graded, grid_points, quadrilaterals
from thermal.assembly import Body
from thermal.materials import Medium

from .body import IceBody
from .parameters import Ice

#: Largest element over smallest: the smallest lie at the contact (height), at the side (radius).
_AXIAL_STRETCH = 500.0
_RADIAL_STRETCH = 8.0


def _around(x: Array) -> Array:
    found: Array = 2.0 * np.pi * x[0]
    return found


def _with_midpoints(boundaries: Array) -> Array:
    """Nodes of P2 elements from the elements' boundaries."""
    return np.sort(np.concatenate((boundaries, 0.5 * (boundaries[1:] + boundaries[:-1]))))


def _nearest(nodes: Array, places: Array) -> NDArray[np.intp]:
    """Number of the nearest node to each place."""
    return np.searchsorted(0.5 * (nodes[1:] + nodes[:-1]), places)


def _radii(radius: float, elements: int, touching: float | None) -> Array:
    """Element boundaries along the radius, m; `touching` becomes one of them."""
    r = radius - graded(radius, elements, _RADIAL_STRETCH)[::-1]
    r[0] = 0.0
    if touching is None or touching >= radius:
        return r
    far = np.abs(r - touching) > 1e-3 * radius
    far[[0, -1]] = True
    return np.union1d(r[far], touching)


def assembled(
    parameters: Ice, r: Array, z: Array, arc_share: Callable[[Array], Array] = np.ones_like
) -> Body:
    """P2 elements between the radii r and the heights z (m)."""
    mesh = MeshQuad.init_tensor(r, z).with_boundaries(
        {
            "bottom": lambda x: x[1] < 0.5 * z[1],
            "side": lambda x: x[0] > 0.5 * (r[-2] + r[-1]),
            "top": lambda x: x[1] > 0.5 * (z[-2] + z[-1]),
        }
    )
    return Body(
        basis=CellBasis(mesh, ElementQuad2()),
        medium=Medium(parameters.density, parameters.heat_capacity, parameters.conductivity),
        h=parameters.air_heat_transfer,
        side=FacetBasis(mesh, ElementQuad2(), facets="side"),
        top=FacetBasis(mesh, ElementQuad2(), facets="top"),
        bottom=FacetBasis(mesh, ElementQuad2(), facets="bottom", intorder=12),
        share=lambda x: arc_share(x[0]),
        measure=_around,
        height=float(z[-1]),
    )


class Cylinder(IceBody):
    """Temperature field of the cylinder; `amplitudes` (modes,).

    arc_share: share of the circle of radius r on which the ice touches the belt; `touching`: its
    kink, a radius that becomes an element boundary so that the quadrature sees smooth pieces.
    Melting takes ice away where it touches; the mesh is lowered as a whole, so a groove that leaves
    a rim standing is resolved up to its depth over the height.
    """

    def __init__(
        self,
        parameters: Ice,
        radius: float,
        arc_share: Callable[[Array], Array] = np.ones_like,
        touching: float | None = None,
    ) -> None:
        r = _radii(radius, parameters.radial_elements, touching)
        z = graded(parameters.height, parameters.axial_elements, _AXIAL_STRETCH)
        body = assembled(parameters, r, z, arc_share)
        basis = body.basis
        super().__init__(body.space(np.eye(basis.N)))
        self.basis = basis
        self.r: Array = _with_midpoints(r)
        self._z = _with_midpoints(z)
        self._grid = np.empty((self.r.size, self._z.size), dtype=np.intp)
        self._grid[_nearest(self.r, basis.doflocs[0]), _nearest(self._z, basis.doflocs[1])] = (
            np.arange(basis.N)
        )
        self.cells: NDArray[np.int64] = quadrilaterals(2 * self.r.size - 1, self._z.size)

    #: What `cells` are, in meshio's words.
    cell_type = "quad"

    @property
    def z(self) -> Array:
        """Heights of the nodes above the face, m: (heights,)."""
        return self._z * self.height_ratio

    def field(self) -> Array:
        """Temperature rise at all nodes, K: (radii, heights) on the grid `r` x `z`."""
        return self.nodal()[self._grid]

    def section(self) -> tuple[Array, Array, Array]:
        """Section through the axis: x (n,) m, z (heights,) m, temperature rise (n, heights) K."""
        field = self.field()
        return (
            np.concatenate((-self.r[:0:-1], self.r)),
            self.z,
            np.concatenate((field[:0:-1], field)),
        )

    @property
    def points(self) -> Array:
        """Nodes of the section through the axis, which `cells` refer to, m: (nodes, 3)."""
        return grid_points(np.concatenate((-self.r[:0:-1], self.r)), self.z)

    def at_points(self) -> Array:
        """Temperature rise at `points`, K: (nodes,)."""
        return self.section()[2].ravel()
