"""Belt and ice while the belt runs at a constant speed: long steps, and the steady state directly.

Seen from the ice, the belt's temperature obeys u_t + v u_x = ..., and a flux that stands still
loads it. In the Fourier series along the loop, and in the modes through the thickness, each
coefficient then has the complex rate

    lambda_m + k^2 along_m + i k v,

so that a step of any length is exact for fluxes that are constant in the contact's frame, however
many loops the belt makes in it. A step of endless length is the steady state: its fixed point, the
same for every step. What has to be resolved in time is only how the fluxes themselves change:
quickly at the start, then from loop to loop.

The strips of the contact, the supports and the heat exchange with the ice are those of
`BeltIceModel`; here the loads are exact Fourier coefficients, there they are hat functions that
travel with the belt.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .block import standing_block
from .constants import MELTING_POINT_DEGC
from .contact import Fluxes, IceFace, exchange
from .footprint import Footprint
from .ice import Ice
from .parameters import ThermalParameters
from .relaxation import LastDurations, decay, mean_decay, mean_response
from .sinks import eliminate, supports
from .steady import FOREVER, check_gives_heat
from .thickness import thickness_of

Array = NDArray[np.float64]
Spectrum = NDArray[np.complex128]

#: First steps of a transient: parts of the usual one, since fluxes start like the root of time.
_START = (1 / 32, 1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2)

#: Usual steps in a loop, and the most in a transient: 0.03 % of the rise; half as many 0.2 %.
_STEPS_IN_A_LOOP, _MOST_STEPS = 8, 240


class SlidingState(NamedTuple):
    """Temperatures as rises above the air, K; belt_share of the friction heat of the last step.

    mean_interface: mean of the two faces over the contact; flash_interface: over the hottest
    strip of it. melting: W/m2 of contact, above 0 where the ice face melts.
    """

    time: float
    entry: float
    exit: float
    mean_interface: float
    flash_interface: float
    ice_face: float
    belt_mean: float
    belt_share: float
    belt_share_so_far: float
    melting: float


class _Response(NamedTuple):
    """What a step of given duration does; (modes, numbers) unless said."""

    decay: Spectrum
    mean: Spectrum            # step-mean of the decay
    forced: Spectrum          # amplitude at the end for load 1 on the mode
    rows: Array               # (rows, rows) step-mean of the rows for 1 W/m2 on the rows, K


class SteadySliding:
    """Belt at a constant speed (m/s, > 0) under friction (force when cold, N), from a cold start.

    waves: of the Fourier series along the loop; left out, two cells of the belt make the shortest.
    sensitivity: part of the friction lost for each kelvin of the interface's rise, 1/K.
    `state` tells the present temperatures; ValueError for a speed or force that cannot be.
    """

    def __init__(self, parameters: ThermalParameters, speed: float, force: float,
                 waves: int | None = None, ice: Ice | None = None,
                 sensitivity: float = 0.0) -> None:
        if not (math.isfinite(speed) and speed > 0.0):
            raise ValueError(f"speed = {speed:g} m/s must be above 0: the belt slides steadily")
        if not (math.isfinite(force) and force >= 0.0):
            raise ValueError(f"force = {force:g} N must not be negative: friction produces heat")
        belt, contact = parameters.belt, parameters.contact
        self.parameters, self.speed, self.force = parameters, speed, force
        if ice is None:
            self.footprint, self.ice = standing_block(parameters)
        else:
            self.ice = ice
            self.footprint = Footprint(contact.radius, belt.width, contact.strips, contact.length)
        self._modes = thickness_of(belt, self.footprint.lane)
        self.ice.amplitudes[:] = 0.0
        number = np.arange((belt.cells // 2 if waves is None else waves) + 1)
        self._wave = 2.0 * np.pi / belt.length * number
        self._weight = np.where(number == 0, 1.0, 2.0)
        self._rates = (self._modes.rates[:, None] + self._modes.along[:, None] * self._wave**2
                       + 1j * speed * self._wave)
        self._place_rows()
        self.amplitudes: Spectrum = np.zeros(self._rates.shape, dtype=np.complex128)
        self._response = LastDurations(self._respond)
        self.sensitivity, self._left = sensitivity, 1.0
        self._time = self._into_belt = self._produced = 0.0
        self._fluxes: Fluxes | None = None

    def _place_rows(self) -> None:
        """Faces, areas and Fourier coefficients of all places with a flux of their own."""
        belt, footprint = self.parameters.belt, self.footprint
        beneath = supports(belt, footprint.length / footprint.strips)
        edges = [footprint.edges, *(s.behind + s.edges for s in beneath)]
        middles = np.concatenate([0.5 * (e[1:] + e[:-1]) for e in edges])
        lengths = np.concatenate([np.diff(e) for e in edges])
        self._areas = lengths * footprint.lane
        on = np.repeat([0] + [1] * len(beneath), [e.size - 1 for e in edges])
        self._on = [on == face for face in (0, 1) if np.any(on == face)]
        self._faces = self._modes.faces[:len(self._on)]
        self._excess = np.concatenate([np.zeros(0)] + [
            np.full(s.edges.size - 1, s.conductance - belt.film) for s in beneath])
        self._rows = self._areas[:, None] * (
            np.sinc(np.outer(lengths, self._wave) / (2.0 * np.pi))
            * np.exp(-1j * np.outer(middles, self._wave)))

    def _respond(self, duration: float) -> _Response:
        x, length, faces = self._rates * duration, self.parameters.belt.length, self._faces
        mean = mean_decay(x)
        held = mean_response(x) * (duration / length * self._weight)
        rows = np.empty((self._areas.size, self._areas.size))
        for on_a, face_a in zip(self._on, faces, strict=True):
            for on_b, face_b in zip(self._on, faces, strict=True):
                # Re(conj(r) g s) summed, by a real product: half the work of a complex one.
                right = self._rows[on_b] * ((face_a * face_b) @ held)
                rows[np.ix_(on_a, on_b)] = (
                    self._rows[on_a].view(np.float64) @ right.view(np.float64).T)
        return _Response(decay(x), mean, mean * (duration / length), rows / self._areas[:, None])

    def _means(self, amplitudes: Spectrum) -> Array:
        """Means over the rows' areas of a field's faces, K: (rows,)."""
        means = np.empty(self._areas.size)
        for on, face in zip(self._on, self._faces, strict=True):
            series = self._weight * (face @ amplitudes)
            means[on] = self._rows[on].view(np.float64) @ series.view(np.float64)
        return means / self._areas

    def _ice_face(self, duration: float) -> IceFace:
        mean, end = self.ice.free_face(duration)
        response, area = self.ice.response(duration), self.footprint.area
        return IceFace(mean, end, response.face_mean * area, response.face_end * area,
                       MELTING_POINT_DEGC - self.parameters.ambient.temperature_degC)

    def step(self, duration: float) -> None:
        """Advance by duration (s, > 0) with constant fluxes."""
        if not duration > 0.0:
            raise ValueError(f"duration = {duration:g} s must be positive")
        response, belt = self._response(duration), self.parameters.belt
        means = self._means(response.mean * self.amplitudes)
        contact = eliminate(means, response.rows, self._excess)
        friction = self._friction()
        self._fluxes = exchange(
            contact.face, self._ice_face(duration), self.parameters.contact.conductance,
            belt.film, friction)
        powers = contact.fluxes(self._fluxes.belt)
        self.amplitudes *= response.decay
        load = sum(np.outer(face, powers[on] @ self._rows[on])
                   for on, face in zip(self._on, self._faces, strict=True))
        self.amplitudes += response.forced * load
        self.ice.advance(duration, self._fluxes.ice * self.footprint.area)
        self._into_belt += float(self._fluxes.from_contact.mean()) * duration
        self._produced += friction * duration
        self._time += duration
        self._left = max(0.0, 1.0 - self.sensitivity * self._interface())

    def _friction(self) -> float:
        """Friction heat, W/m2 of contact."""
        return self._left * self.force * self.speed / self.footprint.area

    def _interface(self) -> float:
        """Mean rise of the two faces over the contact, K."""
        return 0.5 * (float(self.strip_means().mean()) + self.ice.face())

    def until(self, time: float, coarseness: float = 1.0) -> SlidingState:
        """Advance to a time (s), in steps that follow the loops; the state there.

        coarseness: factor of the steps; 2 changes the temperatures by 0.2 % of their rise.
        """
        remaining = time - self._time
        if remaining > 0.0:
            usual = coarseness * max(self.parameters.belt.length / (self.speed * _STEPS_IN_A_LOOP),
                                     remaining / _MOST_STEPS)
            usual = remaining / math.ceil(remaining / usual)
            start = _START if self._time == 0.0 else (1.0,)
            parts = [*start, *[1.0] * (round(remaining / usual) - 1)]
            for part in parts:
                self.step(part * usual)
        return self.state()

    def settle(self) -> SlidingState:
        """Go to the steady state; NoSteadyState when the belt gives no heat to anything."""
        takes = any(s.conductance > 0.0 for s in supports(self.parameters.belt, 1.0))
        check_gives_heat(float(self._modes.rates[0]), takes)
        self._left = 1.0
        self.step(FOREVER)
        if self.sensitivity > 0.0:
            # The rises are proportional to the friction, so what it must be follows from one.
            self._left = 1.0 / (1.0 + self.sensitivity * self._interface())
            self.step(FOREVER)
        return self.state()

    def state(self) -> SlidingState:
        """The present temperatures."""
        probe = 0.5 * min(1.25 * self.footprint.length, self.parameters.belt.length)
        entry, exit_ = self.face(np.array([-probe, probe]))
        strips = self.strip_means()
        ice = self.ice.face()
        share = so_far = melting = 0.0
        if self._fluxes is not None and self._produced > 0.0:
            produced = self._fluxes.ice + self._fluxes.melting + self._fluxes.from_contact.mean()
            share = float(self._fluxes.from_contact.mean() / produced) if produced > 0.0 else 0.0
            so_far = self._into_belt / self._produced
            melting = self._fluxes.melting
        slow = self.amplitudes[:, 0].real
        stored = float(self._modes.heat @ slow)
        return SlidingState(
            time=self._time, entry=float(entry), exit=float(exit_),
            mean_interface=self._interface(),
            flash_interface=0.5 * (float(strips.max()) + ice), ice_face=ice,
            belt_mean=stored / (self.parameters.belt.capacity_per_area * self.footprint.lane),
            belt_share=share, belt_share_so_far=so_far, melting=melting)

    def strip_means(self) -> Array:
        """Belt face under the strips of the contact, from entry to exit, K: (strips,)."""
        return self._means(self.amplitudes)[:self.footprint.strips]

    def face(self, x: Array) -> Array:
        """Contact face at places (n,) m behind the contact's middle, K above the air."""
        # Lanczos' factors: the series is cut off, which would ripple near the contact's edges.
        smooth = np.sinc(np.arange(self._wave.size) / self._wave.size)
        series = smooth * self._weight * (self._faces[0] @ self.amplitudes)
        return (np.exp(1j * np.outer(x, self._wave)) @ series).real


def standing_ice(parameters: ThermalParameters, footprint: Footprint) -> Ice:
    """The cylinder of ice, cold; to be used again for other belts, since its modes take time."""
    return Ice(parameters.ice, parameters.contact.radius, footprint.arc_share,
               touching=footprint.touching)
