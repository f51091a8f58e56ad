"""The belt with what touches it: the ice on the contact face, railing and rollers at the back."""

from collections.abc import Callable
from dataclasses import dataclass

from numpy.fft import rfft

from thermal.arrays import Array
from thermal.contact.footprint import Footprint, strip_loads

from .material_frame import BeltField, FluxPatch
from .parameters import Belt
from .supports import CONTACT, Eliminated, Places


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
