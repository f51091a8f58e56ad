"""Ice that melts: the fluxes at a face that recedes, or grows from the film, and its water.

A face that recedes draws colder ice near, which takes up heat on its way to melting: a kilogram
that melts costs the latent heat and the heat from the air's temperature to the melting point,

    L + c (T_m - T_air),

and a face that melts steadily under a flux q recedes at q / (rho (L + c (T_m - T_air))). The rate
and the sinking of the ice that it causes depend on each other: both are found by fixed-point
iteration within the step.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from thermal.arrays import Array
from thermal.belt.material_frame import BeltField
from thermal.contact import BeltWater, Fluxes, Footprint, IceFace, MeltFilm
from thermal.materials import GRAVITY
from thermal.parameters import ThermalParameters

from .body import IceBody
from .parameters import Ice

#: Largest recession of the face in an internal step, m: the iteration then contracts.
LONGEST_RECESSION = 2e-5

_MOST_ITERATIONS = 60
#: Two iterates that differ by less, relative and in m, are the same: the sinking, and only that,
#: is that of the one before.
_RELATIVE, _ABSOLUTE = 1e-11, 1e-17


def melt_heat(ice: Ice, melting: float) -> float:
    """Heat that melting takes from ice of the air's temperature, J/kg; melting: K above the air.

    Of what never melts, whose melting point is infinite, none is ever taken: the latent heat.
    """
    return ice.latent_heat + (ice.heat_capacity * melting if math.isfinite(melting) else 0.0)


class Receding(NamedTuple):
    """A step's fluxes; load on the ice's modes, None for none; recession of the face, m."""

    fluxes: Fluxes
    sinking: Array | None
    recession: float


class Ablation:
    """The melting face of an ice body; area: of the contact, m2; melting: K above the air.

    `speed`: of the face in the last step, m/s, where the next iteration starts; `melt_heat` J/kg.
    """

    def __init__(self, ice: IceBody, parameters: Ice, area: float, melting: float) -> None:
        self._ice, self._area, self._melting = ice, area, melting
        self.melt_heat: float = melt_heat(parameters, melting)
        self._volume_heat = parameters.density * self.melt_heat
        self.speed: float = 0.0

    def parts(self, heat: float) -> int:
        """Internal steps that keep each recession short, should all the heat (J) melt ice."""
        if not math.isfinite(self._melting):
            return 1
        return max(1, int(np.ceil(heat / (self._area * self._volume_heat * LONGEST_RECESSION))))

    def exchange(
        self, duration: float, available: float, solve: Callable[[IceFace], Fluxes]
    ) -> Receding:
        """Fluxes of a step of some duration (s).

        available: water that may freeze to the face, kg; solve: fluxes for an ice face.
        """
        ice, area = self._ice, self._area
        refreezing = available * self.melt_heat / (area * duration)
        recession, load, sinking = self.speed * duration, 0.0, None
        for _ in range(_MOST_ITERATIONS):
            if recession != 0.0:
                sinking = ice.sinking(duration, recession, load, sinking)
            mean, end = ice.free_face(duration, sinking, recession)
            mean_response, end_response = ice.face_response(duration, recession)
            fluxes = solve(
                IceFace(
                    mean, end, mean_response * area, end_response * area, self._melting, refreezing
                )
            )
            before, recession = recession, fluxes.melting * duration / self._volume_heat
            load = fluxes.ice * area
            if abs(recession - before) <= _ABSOLUTE + _RELATIVE * abs(recession):
                self.speed = recession / duration
                return Receding(fluxes, sinking if recession != 0.0 else None, recession)
        raise ArithmeticError(
            f"melting {before:g} m of ice in {duration:g} s: the iteration for the melt rate did"
            f" not settle in {_MOST_ITERATIONS} passes; take a shorter step"
        )


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
        masses = [self.film.mass, self.film.squeezed, self.melted, self.wiped, self.wiped_ice]
        on_belt = self.on_belt.water, self.on_belt.frozen
        return np.concatenate(([self.ablation.speed, *masses], *on_belt))

    def restore(self, state: Array) -> None:
        """Take a state that `state` returned."""
        self.ablation.speed, self.film.mass, self.film.squeezed = map(float, state[:3])
        self.melted, self.wiped, self.wiped_ice = map(float, state[3:6])
        self.on_belt.water[:], self.on_belt.frozen[:] = state[6:].reshape(2, -1)
