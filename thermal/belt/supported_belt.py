"""The belt with what touches it: the ice on the contact face, railing and rollers at the back."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.fft import rfft
from numpy.typing import NDArray

from thermal.contact.footprint import Footprint, strip_loads

from .material_frame import BACK, CONTACT, BeltField, FluxPatch, Response
from .parameters import Belt
from .supports import Eliminated, each_strip, eliminate, supports, take_heat

Array = NDArray[np.float64]


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


@dataclass(frozen=True)
class HeatGiven:
    """Heat that the belt gave away in a step, J: to the air and to its supports.

    What warm rollers give to the belt counts as negative; what the belt's rubbing makes does not
    count.
    """

    to_air: float
    to_supports: float


class SupportedBelt:
    """`belt` and its supports; all of them stand still while the belt runs."""

    def __init__(self, parameters: Belt, footprint: Footprint) -> None:
        self.belt: BeltField = BeltField(parameters, footprint.lane)
        self._footprint = footprint
        self._supports = supports(parameters, footprint.length / footprint.strips, footprint.lane)
        self._air = parameters.film
        strips = [np.diff(support.edges) for support in self._supports]
        self._conductances = each_strip(self._supports, lambda support: support.conductance)
        self._rises = each_strip(self._supports, lambda support: support.rise)
        self._drags = each_strip(self._supports, lambda support: support.drag)
        #: Areas of all places with a flux of their own, m2: the contact's strips come first.
        self._areas = np.concatenate(
            [np.full(footprint.strips, footprint.strip_area)]
            + [lengths * footprint.lane for lengths in strips]
        )

    @property
    def takes_heat(self) -> bool:
        """Does a support take heat?"""
        return take_heat(self._conductances)

    def step_response(
        self,
        duration: float,
        centre: float,
        movement: float,
        travel: float,
        belt: Response | None = None,
    ) -> StepResponse:
        """What a step of some duration (s) finds, the contact moving from `centre` (m).

        travel: of the belt over its supports, m, signed. belt: how it responds, when not as to
        a step.
        """
        cell = self.belt.cell
        patches = [FluxPatch(CONTACT, *self._footprint.loads(centre, movement, cell))]
        patches += [
            FluxPatch(
                BACK,
                *strip_loads(
                    support.edges, self._footprint.lane, centre + support.behind, movement, cell
                ),
            )
            for support in self._supports
        ]
        means, response = self.belt.face_means(duration, patches, belt)
        free, response = means / self._areas, response / self._areas[:, None]
        rubbing = self._drags * (abs(travel) / duration)
        contact = eliminate(
            free,
            response,
            self._conductances - self._air,
            self._conductances * self._rises + rubbing,
        )
        rubbed = duration * float(rubbing @ self._areas[self._footprint.strips :])
        return StepResponse(patches, free, response, contact, rubbed)

    def advance(
        self,
        duration: float,
        found: StepResponse,
        contact: Array,
        freezing: Callable[[Array, float], Array] | None = None,
    ) -> HeatGiven:
        """Advance by a step that was `found`, with the fluxes of the contact's strips, W/m2.

        freezing: power into the contact face (cells,) W per node, from what that face would be
        at the step's end without it, K (cells,), and its rise for 1 W on every node, K/W.
        """
        fluxes = found.contact.fluxes(contact)
        loads = self.belt.load(found.patches, fluxes)
        if freezing is not None:
            power = freezing(*self.belt.face_after(duration, loads))
            loads[CONTACT] = loads[CONTACT] + rfft(power)
        everywhere = self.belt.advance(duration, loads)
        times = duration * self._areas * (found.free + found.response @ fluxes)
        own = self._footprint.strips
        return HeatGiven(
            everywhere - self._air * float(times.sum()),
            float(self._conductances @ (times[own:] - duration * self._areas[own:] * self._rises)),
        )
