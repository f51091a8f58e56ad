"""What becomes of ice that melts: film under the block, water and ice on the belt."""

from collections.abc import Callable

import numpy as np

from thermal.arrays import Array
from thermal.belt.material_frame import BeltField
from thermal.contact.belt_water import BeltWater
from thermal.contact.exchange import Fluxes, IceFace
from thermal.contact.footprint import Footprint
from thermal.contact.melt_film import MeltFilm
from thermal.materials import GRAVITY
from thermal.parameters import ThermalParameters

from .ablation import Ablation, Receding
from .body import IceBody


class Meltwater:
    """`melted`: ice that the block has lost, kg; `film` under it; `on_belt`; taken off that by a
    wiper, `wiped` water and `wiped_ice`, kg.
    """

    def __init__(
        self, parameters: ThermalParameters, footprint: Footprint, ice: IceBody, belt: BeltField
    ) -> None:
        of_ice, contact = parameters.ice, parameters.contact
        melting = parameters.melting_rise
        self._footprint = footprint
        self._latent = of_ice.latent_heat
        self._wiper = contact.wiper
        self.ablation: Ablation = Ablation(ice, of_ice, footprint.area, melting)
        self.melt_heat: float = self.ablation.melt_heat
        load = contact.load or GRAVITY * ice.space.whole_capacity / of_ice.heat_capacity
        self.film: MeltFilm = MeltFilm(footprint.area, footprint.length, load / footprint.area)
        self.on_belt: BeltWater = BeltWater(belt.cells, belt.cell, self.melt_heat, melting)
        self.melted: float = 0.0
        self.wiped: float = 0.0
        self.wiped_ice: float = 0.0

    def exchange(
        self, duration: float, displacement: float, solve: Callable[[IceFace], Fluxes]
    ) -> Receding:
        """Fluxes of a step in which the belt moves (m), from those for an ice face."""
        return self.ablation.exchange(duration, self.film.available(displacement), solve)

    def freezing(self, duration: float) -> Callable[[Array, float], Array] | None:
        """Power (cells,) W into the belt's nodes from its face at the step's end and its response.

        None when the belt is dry.
        """
        if not self.on_belt.wet:
            return None
        return lambda face, response: self.on_belt.freeze(duration, face, response)

    def advance(self, duration: float, displacement: float, centre: float, flux: float) -> None:
        """Move the water of a step: flux of melting, W/m2; centre of the contact before it, m."""
        length = self._footprint.length
        melted = flux * self._footprint.area * duration / self.melt_heat
        left = self.film.advance(duration, displacement, melted)
        self.melted += melted
        if displacement != 0.0:
            exit_edge = centre + 0.5 * np.copysign(length, displacement)
            self.on_belt.lay(left, exit_edge, -displacement)
        if self.on_belt.wet:
            self._wipe(displacement, centre)
            self.film.mass += self.on_belt.pick_up(centre - displacement, length)

    def _wipe(self, displacement: float, centre: float) -> None:
        """Take water and ice off the belt that comes under the block."""
        if self._wiper == 0.0 or displacement == 0.0:
            return
        entry_edge = centre - 0.5 * np.copysign(self._footprint.length, displacement)
        water, ice = self.on_belt.wipe(entry_edge, -displacement, self._wiper)
        self.wiped += water
        self.wiped_ice += ice

    @property
    def water(self) -> float:
        """All water that there is, kg: under the block, beside it, on the belt, off it."""
        return self.film.mass + self.film.squeezed + self.wiped + float(self.on_belt.water.sum())

    @property
    def heat(self) -> float:
        """Heat that the water holds above ice of the air's temperature, J."""
        return self.melt_heat * self.water

    @property
    def latent_heat(self) -> float:
        """The latent part of it, J."""
        return self._latent * self.water

    def state(self) -> Array:
        """Everything that a continuation needs, as a copy."""
        return np.concatenate(
            (
                [
                    self.ablation.speed,
                    self.film.mass,
                    self.film.squeezed,
                    self.melted,
                    self.wiped,
                    self.wiped_ice,
                ],
                self.on_belt.water,
                self.on_belt.frozen,
            )
        )

    def restore(self, state: Array) -> None:
        """Take a state that `state` returned."""
        (
            self.ablation.speed,
            self.film.mass,
            self.film.squeezed,
            self.melted,
            self.wiped,
            self.wiped_ice,
        ) = (float(x) for x in state[:6])
        self.on_belt.water[:], self.on_belt.frozen[:] = state[6:].reshape(2, -1)
