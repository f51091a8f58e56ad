"""The belt seen from the ice: Fourier series along the loop, modes through the thickness.

There the belt's temperature obeys u_t + v u_x = ..., and each coefficient has the complex rate

    lambda_m + k^2 along_m + i k v,

so that a step of any length is exact for fluxes and a speed v that are constant in it, however many
loops the belt makes. The contact's strips and the supports are rows: places with a flux of their
own, whose loads are exact Fourier coefficients. Temperatures are rises above the air.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from thermal.arrays import Array
from thermal.contact import Footprint
from thermal.relaxation import step

from .parameters import Belt
from .supports import Eliminated, Places
from .thickness import thickness_of

Spectrum = NDArray[np.complex128]

#: Steps whose response is kept: those of a ramp, for the next one.
_KEPT = 64


class Response(NamedTuple):
    """What a step of given duration and speed does; (modes, numbers) unless said."""

    decay: Spectrum
    mean: Spectrum  # step-mean of the decay
    forced: Spectrum  # amplitude at the end for load 1 on the mode
    rows: Array  # (rows, rows) step-mean of the rows for 1 W/m2 on the rows, K


class BeltSeries:
    """Temperature of a belt that runs under a contact; `amplitudes` (modes, numbers), complex.

    waves: of the series along the loop; left out, two cells of the belt make the shortest.
    `railing_heat_factor`, `roller_rise_factor`: part of the railing's friction heat, and of the
    rollers' rise, that acts; the temperatures are linear in both.
    """

    def __init__(self, belt: Belt, footprint: Footprint, waves: int | None = None) -> None:
        self._belt, self._lane = belt, footprint.lane
        self.strips: int = footprint.strips
        number = np.arange((belt.cells // 2 if waves is None else waves) + 1)
        self._wave = 2.0 * np.pi / belt.length * number
        self._weight = np.where(number == 0, 1.0, 2.0)
        self.railing_heat_factor: float = 1.0
        self.roller_rise_factor: float = 1.0
        self.places: Places = Places(belt, footprint)
        places = self.places
        of_strips = np.repeat(places.faces, [edges.size - 1 for edges in places.edges])
        self._on = [of_strips == face for face in np.unique(places.faces)]
        middles = np.concatenate([0.5 * (edges[1:] + edges[:-1]) for edges in places.edges])
        #: Fourier coefficients of all places.
        self._rows = places.areas[:, None] * (
            np.sinc(np.outer(places.lengths, self._wave) / (2.0 * np.pi))
            * np.exp(-1j * np.outer(middles, self._wave))
        )
        self._diagonalise(belt.film)
        self.amplitudes: Spectrum = np.zeros(self._rates.shape, dtype=np.complex128)

    def _diagonalise(self, film: float) -> None:
        """Modes for a film (W/m2K) on both faces."""
        self.film = film
        self._modes = modes = thickness_of(self._belt, self._lane, film)
        self._faces = modes.faces[: len(self._on)]
        self._rates = modes.rates[:, None] + modes.along[:, None] * self._wave**2
        self.response = lru_cache(maxsize=_KEPT)(self._respond)

    def set_film(self, film: float) -> None:
        """Another heat transfer to the air, W/m2K; the temperatures stay what they are."""
        if film != self.film:
            nodal = self._modes.shapes @ self.amplitudes
            self._diagonalise(film)
            self.amplitudes[:] = np.linalg.solve(self._modes.shapes, nodal)

    def _respond(self, duration: float, speed: float) -> Response:
        rates = np.asarray(self._rates + 1j * speed * self._wave, dtype=np.complex128)
        of_step, length = step(rates, duration), self._belt.length
        held = of_step.held_mean * (self._weight / length)
        rows = np.empty((self.places.areas.size, self.places.areas.size))
        for on_a, face_a in zip(self._on, self._faces, strict=True):
            for on_b, face_b in zip(self._on, self._faces, strict=True):
                # Re(conj(r) g s) summed, by a real product: half the work of a complex one.
                right = self._rows[on_b] * ((face_a * face_b) @ held)
                rows[np.ix_(on_a, on_b)] = (
                    self._rows[on_a].view(np.float64) @ right.view(np.float64).T
                )
        rows /= self.places.areas[:, None]
        return Response(of_step.decay, of_step.mean, of_step.held / length, rows)

    def step_response(self, duration: float, speed: float) -> Eliminated:
        """The belt as the contact finds it in a step (s) at a speed (m/s)."""
        response = self.response(duration, speed)
        places = self.places
        given = (
            self.roller_rise_factor * places.conductances * places.rises
            + self.railing_heat_factor * places.drags * abs(speed)
        )
        means = self._means(response.mean * self.amplitudes)
        return places.eliminate(means, response.rows, self.film, given)

    def advance(self, duration: float, speed: float, fluxes: Array) -> None:
        """Advance by a step that was seen, under the fluxes of all rows, W/m2."""
        response = self.response(duration, speed)
        self.amplitudes *= response.decay
        load = sum(
            np.outer(face, fluxes[on] @ self._rows[on])
            for on, face in zip(self._on, self._faces, strict=True)
        )
        self.amplitudes += response.forced * load

    def _means(self, amplitudes: Spectrum) -> Array:
        """Means over the rows' areas of a field's faces, K: (rows,)."""
        means = np.empty(self.places.areas.size)
        for on, face in zip(self._on, self._faces, strict=True):
            series = self._weight * (face @ amplitudes)
            means[on] = self._rows[on].view(np.float64) @ series.view(np.float64)
        return means / self.places.areas

    def strip_means(self) -> Array:
        """Face under the strips of the contact, from entry to exit, K: (strips,)."""
        return self._means(self.amplitudes)[: self.strips]

    def face(self, x: Array) -> Array:
        """Contact face at places (n,) m behind the contact's middle, K."""
        # Lanczos' factors: the series is cut off, which would ripple near the contact's edges.
        smooth = np.sinc(np.arange(self._wave.size) / self._wave.size)
        series = smooth * self._weight * (self._faces[0] @ self.amplitudes)
        found: Array = (np.exp(1j * np.outer(x, self._wave)) @ series).real
        return found

    def warm(self, rise: float) -> None:
        """Make the whole belt warmer, K."""
        # as in `ice.body`: the coefficients of 1 are the heat of each mode, of a metre
        self.amplitudes[:, 0] += rise * self._modes.heat

    def mean_rise(self) -> float:
        """Of the whole belt, K: its heat over its capacity."""
        stored = float(self._modes.heat @ self.amplitudes[:, 0].real)
        return stored / (self._belt.capacity_per_area * self._lane)

    @property
    def slowest_rate(self) -> float:
        """1/s, with which a belt cools that gives heat to the air alone."""
        return float(self._modes.rates[0])
