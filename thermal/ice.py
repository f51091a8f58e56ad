"""The standing cylinder of ice: axisymmetric (r, z), z upwards from the contact face.

P2 on a graded tensor mesh of quadrilaterals (scikit-fem), volume element 2 pi r dr dz; Newton
cooling on side and top, a flux on the part of the bottom that lies on the belt, nothing on the
rest of the bottom. All eigenmodes are kept, so the assembled problem is advanced exactly for a
constant flux. Temperatures are rises above the air.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from skfem import CellBasis, ElementQuad2, FacetBasis, LinearForm, MeshQuad

from .belt import graded
from .eigenmodes import Medium, eigenmodes
from .parameters import Ice as IceParameters
from .relaxation import LastDurations, decay, mean_decay, mean_response

Array = NDArray[np.float64]

#: Largest element over smallest: the smallest lie at the contact (height), at the side (radius).
_AXIAL_STRETCH = 500.0
_RADIAL_STRETCH = 8.0


def _around(x: Array) -> Array:
    return 2.0 * np.pi * x[0]


def _with_midpoints(boundaries: Array) -> Array:
    """Nodes of P2 elements from the elements' boundaries."""
    return np.sort(np.concatenate((boundaries, 0.5 * (boundaries[1:] + boundaries[:-1]))))


def _nearest(nodes: Array, places: Array) -> NDArray[np.intp]:
    """Number of the nearest node to each place."""
    return np.searchsorted(0.5 * (nodes[1:] + nodes[:-1]), places)


class Response(NamedTuple):
    """What a step of given duration does, per mode unless said."""

    decay: Array
    mean: Array               # mean of the decay
    forced: Array             # amplitude at the end for load 1 W
    face_mean: float          # step-mean of the face for 1 W, K/W
    face_end: float           # end of the face for 1 W, K/W
    loss_free: Array          # J lost to the air per amplitude
    loss_forced: float        # J lost to the air for load 1 W


class Ice:
    """Temperature field of the ice; `amplitudes` (modes,).

    arc_share: share of the circle of radius r on which the ice touches the belt; `touching`: its
    kink, a radius that becomes an element boundary so that the quadrature sees smooth pieces.
    """

    def __init__(self, parameters: IceParameters, radius: float,
                 arc_share: Callable[[Array], Array] = np.ones_like,
                 touching: float | None = None) -> None:
        r = radius - graded(radius, parameters.radial_elements, _RADIAL_STRETCH)[::-1]
        r[0] = 0.0
        if touching is not None and touching < radius:
            far = np.abs(r - touching) > 1e-3 * radius
            far[[0, -1]] = True
            r = np.union1d(r[far], touching)
        z = graded(parameters.height, parameters.axial_elements, _AXIAL_STRETCH)
        mesh = MeshQuad.init_tensor(r, z).with_boundaries({
            "bottom": lambda x: x[1] < 0.5 * z[1],
            "free": lambda x: (x[0] > 0.5 * (r[-2] + r[-1])) | (x[1] > 0.5 * (z[-2] + z[-1])),
        })
        basis = CellBasis(mesh, ElementQuad2())
        films = [(FacetBasis(mesh, ElementQuad2(), facets="free"), parameters.air_heat_transfer)]
        medium = Medium(parameters.density, parameters.heat_capacity, parameters.conductivity)
        modes = eigenmodes(basis, films, medium, _around)
        bottom = FacetBasis(mesh, ElementQuad2(), facets="bottom", intorder=12)
        weight = LinearForm(lambda v, w: _around(w.x) * arc_share(w.x[0]) * v).assemble(bottom)
        self._face = (weight / weight.sum()) @ modes.shapes
        self.rates, self._heat, self._air = modes.rates, modes.heat, modes.air
        self.r, self.z = _with_midpoints(r), _with_midpoints(z)
        self._grid = np.empty((self.r.size, self.z.size), dtype=np.intp)
        self._grid[_nearest(self.r, basis.doflocs[0]), _nearest(self.z, basis.doflocs[1])] = (
            np.arange(basis.N))
        self._shapes = modes.shapes
        self.amplitudes: Array = np.zeros(self.rates.size)
        self.response = LastDurations(self._response)

    def _response(self, duration: float) -> Response:
        x = self.rates * duration
        mean, response = mean_decay(x), mean_response(x)
        forced = self._face * duration * mean
        return Response(
            decay=decay(x), mean=mean, forced=forced,
            face_mean=float(np.sum(self._face**2 * response) * duration),
            face_end=float(self._face @ forced),
            loss_free=self._air * duration * mean,
            loss_forced=float(np.sum(self._air * self._face * response) * duration**2))

    def free_face(self, duration: float) -> tuple[float, float]:
        """Mean contact face without load, K: mean over the step and at its end."""
        response = self.response(duration)
        weighted = self._face * self.amplitudes
        return float(weighted @ response.mean), float(weighted @ response.decay)

    def advance(self, duration: float, load: float) -> float:
        """Advance by duration (s) under a load (W) on the contact; heat to the air, J."""
        response = self.response(duration)
        loss = self.amplitudes @ response.loss_free + load * response.loss_forced
        self.amplitudes *= response.decay
        self.amplitudes += response.forced * load
        return float(loss)

    def heat(self) -> float:
        """Heat stored above ambient, J."""
        return float(self._heat @ self.amplitudes)

    def face(self) -> float:
        """Mean temperature rise of the contact face, K."""
        return float(self._face @ self.amplitudes)

    def field(self) -> Array:
        """Temperature rise at all nodes, K: (radii, heights) on the grid `r` x `z`."""
        return (self._shapes @ self.amplitudes)[self._grid]
