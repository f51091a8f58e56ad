"""The belt in its own frame: x along the loop (periodic), z from the contact face inwards.

The mesh is a tensor product: P1 hat functions on a uniform periodic mesh along x, P2 elements
through the thickness (scikit-fem). Its operators are Kronecker products of two factors; those along
x are circulant, so FFT in x and eigenmodes in z diagonalise the whole two-dimensional operator. The
mass along x is lumped: with the consistent mass, the edges of the contact leave places colder than
the air. Every coefficient then obeys a' = -rate a + load, which is advanced exactly for loads that
are constant over a step. Temperatures are rises above the air.
"""

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.fft import irfft, rfft
from numpy.typing import NDArray

from thermal.arrays import Array
from thermal.relaxation import STEP_SIZES, step

from .parameters import Belt
from .thickness import thickness_of

#: The faces of the belt.
CONTACT, BACK = 0, 1

Spectrum = NDArray[np.complex128]


def periodic_stiffness(cells: int, cell: float) -> Array:
    """Symbol (cells // 2 + 1,) of the P1 stiffness on a periodic mesh, 1/m.

    That of the circulant matrix of (-1, 2, -1) / cell, by its half angles: without cancelling.
    """
    found: Array = 4.0 / cell * np.sin(np.pi / cells * np.arange(cells // 2 + 1)) ** 2
    return found


class FluxPatch(NamedTuple):
    """Loads on consecutive nodes of one face: every row a place with a flux of its own.

    first: number of the first node, unwrapped; loads (rows, nodes), m2.
    """

    face: int
    first: int
    loads: Array


class Response(NamedTuple):
    """What a step of given duration does; `modes` x `wave numbers` unless said."""

    decay: Array
    free_mean: Array  # (2, modes, numbers) weights of the amplitudes in the faces' means
    forced: Array  # (2, modes, numbers) amplitude at the end for load 1 on a face
    kernels: Array  # (2, 2, cells) step-mean of a face at a node for 1 W at node 0
    loss_free: Array  # (modes,) J lost to the air per amplitude of wave number 0
    loss_forced: Array  # (2,) J lost to the air per load of wave number 0 on a face


class BeltField:
    """Temperature field of the lane (width m) of a belt that runs under the ice.

    `rates` (modes, wave numbers), 1/s. `amplitudes` (modes, wave numbers), complex: real FFT
    along x of the nodes' modal amplitudes. A load is the real FFT of nodal loads in W on a face.
    """

    def __init__(self, parameters: Belt, lane: float) -> None:
        self.cells: int = parameters.cells
        self.cell: float = parameters.length / self.cells
        self.position: Array = np.arange(self.cells, dtype=np.float64) * self.cell
        modes = thickness_of(parameters, lane)
        self.depth: Array = modes.depth
        self._shapes, self._faces = modes.shapes, modes.faces
        self.rates: Array = modes.rates[:, None] + modes.along[:, None] * (
            periodic_stiffness(self.cells, self.cell) / self.cell
        )
        self._heat = modes.heat * self.cell
        self._air = modes.air * self.cell
        self.amplitudes: Spectrum = np.zeros(self.rates.shape, dtype=np.complex128)
        self.response: Callable[[float], Response] = lru_cache(STEP_SIZES)(self._response)

    def _response(self, duration: float) -> Response:
        decay, mean, held, held_mean = step(self.rates, duration)
        entering = self._faces[:, :, None] / self.cell
        pairs = np.einsum("am,bm,mk->abk", self._faces, entering[..., 0], held_mean)
        return Response(
            decay=decay,
            free_mean=self._faces[:, :, None] * mean,
            forced=entering * held,
            kernels=irfft(pairs, self.cells, axis=-1),
            loss_free=self._air * held[:, 0],
            loss_forced=duration * np.sum(self._air * entering[..., 0] * held_mean[:, 0], axis=1),
        )

    def nodal(self, first: int, loads: Array) -> Array:
        """Loads (nodes,) on consecutive nodes from `first` on, wrapped onto the loop: (cells,)."""
        nodal = np.zeros(self.cells)
        for start in range(0, loads.size, self.cells):
            piece = loads[start : start + self.cells]
            nodal[(first + start + np.arange(piece.size)) % self.cells] += piece
        return nodal

    def face_means(self, duration: float, patches: Sequence[FluxPatch]) -> tuple[Array, Array]:
        """Step-means of the faces under the patches, summed over the nodes with their loads.

        Returns the means (rows,) without load, K m2, and their response (rows, rows), to fluxes
        of 1 W/m2 on the rows; rows of all patches in a row.
        """
        response = self.response(duration)
        free = {}
        for face in {patch.face for patch in patches}:
            weighted = np.einsum("mk,mk->k", response.free_mean[face], self.amplitudes)
            free[face] = irfft(weighted, self.cells)
        nodes = [patch.first + np.arange(patch.loads.shape[1]) for patch in patches]
        means = [
            patch.loads @ free[patch.face][node % self.cells]
            for patch, node in zip(patches, nodes, strict=True)
        ]
        blocks = [
            [
                a.loads
                @ response.kernels[a.face, b.face][(i[:, None] - j[None, :]) % self.cells]
                @ b.loads.T
                for b, j in zip(patches, nodes, strict=True)
            ]
            for a, i in zip(patches, nodes, strict=True)
        ]
        return np.concatenate(means), np.block(blocks)

    def load(self, patches: Sequence[FluxPatch], fluxes: Array) -> dict[int, Spectrum]:
        """Load of each face under fluxes (rows,) W/m2 on the rows of the patches."""
        nodal: dict[int, Array] = {}
        row = 0
        for patch in patches:
            rows = len(patch.loads)
            loads = self.nodal(patch.first, fluxes[row : row + rows] @ patch.loads)
            nodal[patch.face] = nodal.get(patch.face, 0.0) + loads
            row += rows
        return {face: rfft(loads) for face, loads in nodal.items()}

    def face_after(self, duration: float, loads: dict[int, Spectrum]) -> tuple[Array, float]:
        """Contact face after a step (s) under loads, K (cells,); its rise for 1 W a node, K/W."""
        response = self.response(duration)
        after = response.decay * self.amplitudes
        for face, load in loads.items():
            after += response.forced[face] * load
        return (
            irfft(np.einsum("m,mk->k", self._faces[CONTACT], after), self.cells),
            float(self._faces[CONTACT] @ response.forced[CONTACT, :, 0]),
        )

    def advance(self, duration: float, loads: dict[int, Spectrum]) -> float:
        """Advance by duration (s) under loads of the faces; heat to the air, J."""
        response = self.response(duration)
        loss = self.amplitudes[:, 0].real @ response.loss_free
        self.amplitudes *= response.decay
        for face, load in loads.items():
            loss += load[0].real * response.loss_forced[face]
            self.amplitudes += response.forced[face] * load
        return float(loss)

    def heat(self) -> float:
        """Heat stored above ambient, J."""
        return float(self._heat @ self.amplitudes[:, 0].real)

    def face(self, which: int = CONTACT) -> Array:
        """A face at the nodes, K above the air: (cells,)."""
        found: Array = irfft(np.einsum("m,mk->k", self._faces[which], self.amplitudes), self.cells)
        return found

    def field(self) -> Array:
        """Temperature rise at all nodes, K: (cells, depths)."""
        found: Array = irfft(self._shapes @ self.amplitudes, self.cells, axis=1).T
        return found
