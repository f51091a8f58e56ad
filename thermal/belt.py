"""The belt in its own frame: x along the loop (periodic), z from the contact face inwards.

The mesh is a tensor product: P1 hat functions on a uniform periodic mesh along x, P2 elements
through the thickness. Its operators are Kronecker products of two factors, both assembled by
scikit-fem; the factors along x are circulant, so FFT in x and eigenmodes in z diagonalise the
whole two-dimensional operator. The mass along x is lumped: with the consistent mass, the edges of
the contact leave places colder than the air. Every coefficient then obeys a' = -rate a + load,
which is advanced exactly for loads that are constant over a step. Temperatures are rises above
the air.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft, rfft
from scipy.sparse import coo_matrix
from skfem import BilinearForm, CellBasis, ElementLineP1, ElementLineP2, FacetBasis, MeshLine

from .eigenmodes import Medium, eigenmodes
from .parameters import Belt as BeltParameters
from .relaxation import LastDurations, decay, mean_decay, mean_response

Array = NDArray[np.float64]
Spectrum = NDArray[np.complex128]

#: Last element through the thickness over the first, which lies at the contact face.
_STRETCH = 10.0


def graded(length: float, elements: int, stretch: float) -> Array:
    """Element boundaries from 0 to length, m; a geometric row, last over first is `stretch`."""
    sizes = stretch ** (np.arange(elements) / max(1, elements - 1))
    return np.concatenate(([0.0], np.cumsum(sizes) * (length / sizes.sum())))


def periodic_stiffness(cells: int, cell: float) -> Array:
    """Symbol (cells // 2 + 1,) of the P1 stiffness on a periodic mesh, 1/m.

    scikit-fem assembles the open mesh; its end nodes are then identified by a projection, which
    makes the matrix circulant: the real FFT of its first column is its spectrum.
    """
    basis = CellBasis(MeshLine(np.linspace(0.0, cells * cell, cells + 1)), ElementLineP1())
    nodes = np.arange(cells + 1)
    identify = coo_matrix((np.ones(cells + 1), (nodes, nodes % cells))).tocsr()
    stiffness = BilinearForm(lambda u, v, w: u.grad[0] * v.grad[0]).assemble(basis)
    circulant = identify.T @ stiffness @ identify
    symbol = rfft(circulant[:, [0]].toarray().ravel()).real
    # The stiffness of a constant is zero; assembly leaves rounding.
    symbol[0] = 0.0
    return symbol


class Response(NamedTuple):
    """What a step of given duration does; `modes` x `wave numbers` unless said."""

    decay: Array
    free_mean: Array          # weights of the amplitudes in the contact face's mean over the step
    forced: Array             # amplitude at the end for load 1
    face: Array               # (wave numbers,) share in the contact face's mean for load 1
    loss_free: Array          # (modes,) J lost to the air per amplitude of wave number 0
    loss_forced: float        # J lost to the air per load of wave number 0


class Belt:
    """Temperature field of the lane (width m) of a belt that runs under the ice.

    `rates` (modes, wave numbers), 1/s. `amplitudes` (modes, wave numbers), complex: real FFT
    along x of the nodes' modal amplitudes. A load is the real FFT of nodal loads in W at the
    contact face.
    """

    def __init__(self, parameters: BeltParameters, lane: float) -> None:
        self.cells = parameters.cells
        self.cell = parameters.length / self.cells
        self.position = np.arange(self.cells) * self.cell
        basis = CellBasis(
            MeshLine(graded(parameters.thickness, parameters.elements, _STRETCH)), ElementLineP2())
        self._order = np.argsort(basis.doflocs[0])
        self.depth = basis.doflocs[0][self._order]
        medium = Medium(parameters.density, parameters.heat_capacity, parameters.conductivity)
        films = [(FacetBasis(basis.mesh, ElementLineP2(), facets=basis.mesh.boundary_facets()),
                  parameters.air_heat_transfer)]
        modes = eigenmodes(basis, films, medium, lambda x: lane + 0.0 * x[0])
        self._shapes = modes.shapes[self._order]
        self._face = self._shapes[0]
        diffusivity = medium.conductivity / medium.capacity
        self.rates = modes.rates[:, None] + diffusivity * (
            periodic_stiffness(self.cells, self.cell) / self.cell)
        self._heat = modes.heat * self.cell
        self._air = modes.air * self.cell
        #: Weights that turn a sum over half the wave numbers into one over the nodes.
        self._parseval = np.full(self.cells // 2 + 1, 2.0 / self.cells)
        self._parseval[0] = 1.0 / self.cells
        if self.cells % 2 == 0:
            self._parseval[-1] = 1.0 / self.cells
        self.amplitudes: Spectrum = np.zeros(self.rates.shape, dtype=np.complex128)
        self.response = LastDurations(self._response)

    def _response(self, duration: float) -> Response:
        x = self.rates * duration
        mean, response = mean_decay(x), mean_response(x)
        entering = self._face[:, None] / self.cell
        slow = duration * mean[:, 0]
        return Response(
            decay=decay(x),
            free_mean=self._face[:, None] * mean,
            forced=entering * duration * mean,
            face=self._parseval * duration * np.sum(
                self._face[:, None] * entering * response, axis=0),
            loss_free=self._air * slow,
            loss_forced=float(np.sum(self._air * entering[:, 0] * response[:, 0]) * duration**2))

    def spectrum(self, first: int, loads: Array) -> Spectrum:
        """Real FFT of loads on consecutive nodes from `first` on (wrapped): (rows, numbers)."""
        rows, count = loads.shape
        nodal = np.zeros((rows, self.cells))
        for start in range(0, count, self.cells):
            piece = loads[:, start:start + self.cells]
            nodal[:, (first + start + np.arange(piece.shape[1])) % self.cells] += piece
        return rfft(nodal, axis=1)

    def face_means(self, duration: float, weights: Spectrum) -> tuple[Array, Array]:
        """Step-means of the contact face, summed over the nodes with weights.

        weights (rows, wave numbers): real FFT of nodal weights. Returns the means (rows,)
        without load, K times the weights' unit, and their response (rows, rows) to loads that
        are distributed as the weights. Sums by einsum: BLAS would start threads for so little.
        """
        response = self.response(duration)
        free = np.einsum("mk,mk->k", response.free_mean, self.amplitudes)
        free *= self._parseval
        parts = weights.view(np.float64)
        means = np.einsum("rk,k->r", parts, free.view(np.float64))
        spread = (weights * response.face).view(np.float64)
        return means, np.einsum("rk,sk->rs", parts, spread)

    def advance(self, duration: float, load: Spectrum) -> float:
        """Advance by duration (s) under a load (real FFT of W per node); heat to the air, J."""
        response = self.response(duration)
        loss = (self.amplitudes[:, 0].real @ response.loss_free
                + load[0].real * response.loss_forced)
        self.amplitudes *= response.decay
        self.amplitudes += response.forced * load
        return float(loss)

    def heat(self) -> float:
        """Heat stored above ambient, J."""
        return float(self._heat @ self.amplitudes[:, 0].real)

    def face(self) -> Array:
        """Contact face at the nodes, K above the air: (cells,)."""
        return irfft(np.einsum("m,mk->k", self._face, self.amplitudes), self.cells)

    def field(self) -> Array:
        """Temperature rise at all nodes, K: (cells, depths)."""
        return irfft(self._shapes @ self.amplitudes, self.cells, axis=1).T
