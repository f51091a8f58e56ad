"""Fluxes at the contact while the ice's face melts away, or grows from the film.

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
from thermal.contact.exchange import Fluxes, IceFace

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
