"""Constants that every part of the heat model shares, and what a conducting medium is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: m/s2
GRAVITY = 9.81
#: 0 degC in K.
ZERO_DEGC = 273.15
#: Highest temperature at which the block is still ice, degC.
MELTING_POINT_DEGC = 0.0
#: Water at 0 degC: density kg/m3, viscosity Pa s (IAPWS).
WATER_DENSITY = 999.8
WATER_VISCOSITY = 1.79e-3


@dataclass(frozen=True)
class Medium:
    """Density kg/m3, heat capacity J/kgK, conductivity W/mK; where it varies, (elements, 1)."""

    density: float | Array
    heat_capacity: float | Array
    conductivity: float | Array

    @property
    def capacity(self) -> float | Array:
        """Heat capacity of a volume, J/m3K."""
        return self.density * self.heat_capacity
