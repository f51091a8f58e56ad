"""Railing and rollers: what touches the back of the belt and stays at a temperature of its own.

They stand still while the belt runs over them, like the ice. Each is cut into strips, in each of
which the flux into the belt is uniform over a step,

    p = -(h - h_air) T + h T_s + d v,

T the step-mean of the back over the strip and T_s the support's temperature (rises above the air),
d v the friction heat of a belt that rubs on the support at its speed v: the belt's modes lose heat
to the air over the whole back, which a support covers. The strips of all supports are eliminated
before the contact is solved, so that the contact sees a belt that knows its supports.

`SupportedBelt` is the belt with all that touches it: also the ice, on the contact face.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.fft import rfft

from thermal.arrays import Array
from thermal.contact import BeltFace, Footprint, strip_loads

from .material_frame import BACK, CONTACT, BeltField, FluxPatch
from .parameters import Belt


@dataclass(frozen=True)
class Support:
    """A railing or a roller: its middle, m behind the contact's; strip edges, m from its middle.

    conductance to it, W/m2K; rise: its temperature above the air, K; drag: friction heat that
    enters the belt, W/m2 for 1 m/s.
    """

    behind: float
    edges: Array
    conductance: float
    rise: float = 0.0
    drag: float = 0.0


def supports(belt: Belt, strip: float, lane: float) -> list[Support]:
    """All supports of a belt, cut into strips not longer than `strip` (m); lane: its width, m."""

    def cut(length: float) -> Array:
        return np.linspace(-0.5 * length, 0.5 * length, int(np.ceil(length / strip)) + 1)

    found = []
    if belt.railing_length > 0.0:
        heat = belt.railing_share * belt.railing_friction * belt.railing_load
        found.append(
            Support(
                0.0,
                cut(belt.railing_length),
                belt.railing_conductance,
                drag=heat / (belt.railing_length * lane),
            )
        )
    spacing = belt.length / max(1, belt.rollers)
    found += [
        Support(
            (n + 0.5) * spacing, cut(belt.roller_arc), belt.roller_conductance, belt.roller_rise
        )
        for n in range(belt.rollers)
    ]
    return found


@dataclass(frozen=True)
class Eliminated:
    """The belt seen from the contact, and how the supports answer what happens there."""

    face: BeltFace
    _own: Array
    _answer: Array

    def fluxes(self, contact: Array) -> Array:
        """Fluxes into the belt of all strips, W/m2: the contact's, then the supports'."""
        return np.concatenate((contact, -self._own - self._answer @ contact))


class Places:
    """Places on a belt with a flux of their own: the contact's strips, then those of its supports.

    faces, edges: of each row of strips the face of the belt, and the strips' edges, m behind the
    contact's middle. lengths m and areas m2 of all strips; conductances W/m2K, rises K and drags
    (W/m2 for 1 m/s) of those of the supports.
    """

    conductances: Array
    rises: Array
    drags: Array

    def __init__(self, belt: Belt, footprint: Footprint) -> None:
        found = supports(belt, footprint.length / footprint.strips, footprint.lane)
        self.faces: list[int] = [CONTACT] + [BACK] * len(found)
        self.edges: list[Array] = [footprint.edges, *(s.behind + s.edges for s in found)]
        self.lengths: Array = np.concatenate([np.diff(edges) for edges in self.edges])
        self.areas: Array = self.lengths * footprint.lane
        strips = np.array([s.edges.size - 1 for s in found], dtype=np.intp)
        self.conductances, self.rises, self.drags = (
            np.repeat(np.array([getattr(s, name) for s in found], dtype=np.float64), strips)
            for name in ("conductance", "rise", "drag")
        )

    @property
    def take_heat(self) -> bool:
        """Does a support take heat?"""
        return bool(np.any(self.conductances > 0.0))

    def eliminate(self, free: Array, response: Array, film: float, given: Array) -> Eliminated:
        """Solve for the supports' strips in terms of the contact's.

        free (strips,) K, response (strips, strips) K m2/W of all strips; film: to the air, W/m2K;
        given: what the supports give to a belt at the air's temperature, W/m2.
        """
        excess = self.conductances - film
        contact = free.size - excess.size
        if excess.size == 0:
            return Eliminated(BeltFace(free, response), np.zeros(0), np.zeros((0, contact)))
        matrix = np.eye(excess.size) + excess[:, None] * response[contact:, contact:]
        right = excess[:, None] * np.column_stack((free[contact:], response[contact:, :contact]))
        right[:, 0] -= given
        solved = np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
        own, answer = solved[:, 0], solved[:, 1:]
        across = response[:contact, contact:]
        face = BeltFace(
            free[:contact] - across @ own, response[:contact, :contact] - across @ answer
        )
        return Eliminated(face, own, answer)


@dataclass(frozen=True)
class StepResponse:
    """The belt as a step finds it: places, their step-means without flux, their response.

    rubbed: friction heat that enters the belt from its railing in the step, J.
    """

    patches: list[FluxPatch]
    free: Array
    response: Array
    contact: Eliminated
    rubbed: float


class SupportedBelt:
    """`belt` and its supports; all of them stand still while the belt runs."""

    def __init__(self, parameters: Belt, footprint: Footprint) -> None:
        self.belt: BeltField = BeltField(parameters, footprint.lane)
        self.places: Places = Places(parameters, footprint)
        self._lane, self._strips = footprint.lane, footprint.strips
        self._air = parameters.film

    def step_response(
        self, duration: float, centre: float, movement: float, travel: float
    ) -> StepResponse:
        """What a step of some duration (s) finds, the contact moving from `centre` (m).

        travel: of the belt over its supports, m, signed.
        """
        places, cell = self.places, self.belt.cell
        patches = [
            FluxPatch(face, *strip_loads(edges, self._lane, centre, movement, cell))
            for face, edges in zip(places.faces, places.edges, strict=True)
        ]
        means, response = self.belt.face_means(duration, patches)
        free, response = means / places.areas, response / places.areas[:, None]
        rubbing = places.drags * (abs(travel) / duration)
        given = places.conductances * places.rises + rubbing
        contact = places.eliminate(free, response, self._air, given)
        rubbed = duration * float(rubbing @ places.areas[self._strips :])
        return StepResponse(patches, free, response, contact, rubbed)

    def advance(
        self,
        duration: float,
        found: StepResponse,
        contact: Array,
        freezing: Callable[[Array, float], Array] | None = None,
    ) -> tuple[float, float]:
        """Advance by a step that was `found`, with the fluxes of the contact's strips, W/m2.

        freezing: power into the contact face (cells,) W per node, from what that face would be
        at the step's end without it, K (cells,), and its rise for 1 W on every node, K/W.
        Returns the heat that the belt gave to the air, and to its supports, J. What warm rollers
        give to the belt counts as negative; what the belt's rubbing makes does not count.
        """
        fluxes = found.contact.fluxes(contact)
        loads = self.belt.load(found.patches, fluxes)
        if freezing is not None:
            power = freezing(*self.belt.face_after(duration, loads))
            loads[CONTACT] = loads[CONTACT] + rfft(power)
        everywhere = self.belt.advance(duration, loads)
        places = self.places
        areas = duration * places.areas
        times = areas * (found.free + found.response @ fluxes)
        warmer = times[self._strips :] - areas[self._strips :] * places.rises
        return everywhere - self._air * float(times.sum()), float(places.conductances @ warmer)
