"""Through the thickness of the belt: one layer or several, from the contact face to the back.

P2 elements, finest at the contact face, with nodes where layers meet (scikit-fem); Newton cooling
on both faces. The eigenmodes of the assembled problem serve every solver of the belt. Conduction
along the belt adds to the rate of mode m, for the wave number k,

    k^2 phi_m^T K phi_m,    K = int lambda u v over the thickness,

lambda the conductivity of each layer. That is exact for one layer. For several it leaves out how
conduction along the layers couples the modes: second order in a term that itself changes the
temperatures by less than 1 %.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from skfem import CellBasis, ElementLineP2, FacetBasis, MeshLine

from thermal.arrays import Array, graded
from thermal.assembly import Body
from thermal.materials import Medium
from thermal.relaxation import eigenmodes

from .parameters import Belt, Layer

#: Last element through the thickness over the first, which lies at the contact face.
_STRETCH = 10.0


def element_boundaries(layers: tuple[Layer, ...], elements: int) -> tuple[Array, NDArray[np.intp]]:
    """Boundaries (m, from the contact face) and the layer that each element belongs to.

    A single layer takes all elements; of several, each takes half as many, since the heat of a
    pass crosses each of their faces anew.
    """
    if len(layers) == 1:
        return graded(layers[0].thickness, elements, _STRETCH), np.zeros(elements, dtype=np.intp)
    each = (elements + 1) // 2
    pieces, top = [np.zeros(1)], 0.0
    for layer in layers:
        pieces.append(top + graded(layer.thickness, each, _STRETCH)[1:])
        top += layer.thickness
    return np.concatenate(pieces), np.repeat(np.arange(len(layers)), each)


def section(layers: tuple[Layer, ...], h: float, elements: int, lane: float) -> Body:
    """Elements of a metre of a lane (width m) of belt with films h (W/m2K) on its faces."""
    boundaries, of_element = element_boundaries(layers, elements)
    mesh = MeshLine(boundaries)
    # One row per element, to be broadcast over its quadrature points.
    medium = Medium(
        *(
            np.array([getattr(layers[i], name) for i in of_element])[:, None]
            for name in ("density", "heat_capacity", "conductivity")
        )
    )
    return Body(
        basis=CellBasis(mesh, ElementLineP2()),
        medium=medium,
        h=h,
        side=FacetBasis(mesh, ElementLineP2(), facets=mesh.boundary_facets()),
        top=None,
        bottom=FacetBasis(mesh, ElementLineP2(), facets=lambda x: x[0] == 0.0),
        share=lambda x: np.ones_like(x[0]),
        measure=lambda x: np.full_like(x[0], lane),
        height=float(boundaries[-1]),
    )


class Thickness:
    """Modes through the thickness of a lane (width m) of belt with films h (W/m2K) on its faces.

    Per metre of belt where said.

    depth (depths,) m from the contact face; shapes (depths, modes); rates (modes,) 1/s without
    conduction along the belt, `along` (modes,) m2/s what that adds per wave number squared; heat
    (modes,) J/m and air (modes,) W/m given to the air, for amplitude 1. `faces` (2, modes): the
    shapes at the contact face and at the back.
    """

    def __init__(self, layers: tuple[Layer, ...], h: float, elements: int, lane: float) -> None:
        body = section(layers, h, elements, lane)
        space = body.space(np.eye(body.basis.N))
        rates, shapes = eigenmodes(space.factor(1.0), space.capacity)
        along = body.weighted(body.medium.conductivity)
        order = np.argsort(body.basis.doflocs[0])
        self.depth: Array = body.basis.doflocs[0][order]
        self.rates: Array = rates
        self.shapes: Array = shapes[order]
        self.faces: Array = self.shapes[[0, -1]]
        self.heat: Array = space.heat @ shapes
        self.air: Array = space.side_air @ shapes
        self.along: Array = np.sum(shapes * (along @ shapes), axis=0)


@lru_cache(maxsize=32)
def _solved(layers: tuple[Layer, ...], h: float, elements: int, lane: float) -> Thickness:
    return Thickness(layers, h, elements, lane)


def thickness_of(belt: Belt, lane: float, film: float | None = None) -> Thickness:
    """The modes of a belt; those of belts that differ in length alone are solved once.

    film: on its faces, W/m2K, when it is another than the belt's.
    """
    return _solved(belt.stack, belt.film if film is None else film, belt.elements, lane)
