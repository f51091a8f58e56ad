"""Constants that every part of the heat model shares, and what a conducting medium is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
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


#: The block's material that melts.
ICE = "ice"


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


#: Materials of a block beside ice, near 20 degC: density, heat capacity, conductivity (Incropera et
#: al., Fundamentals of Heat and Mass Transfer, 6th ed., tables A.1 and A.3; PTFE, PMMA and rubber
#: differ from make to make by a tenth and more, wood with its kind and moisture by a half).
MATERIALS = {
    "steel": Medium(7854.0, 434.0, 60.5),
    "stainless steel": Medium(7900.0, 477.0, 14.9),
    "aluminium": Medium(2702.0, 903.0, 237.0),
    "copper": Medium(8933.0, 385.0, 401.0),
    "glass": Medium(2500.0, 750.0, 1.4),
    "granite": Medium(2630.0, 775.0, 2.79),
    "rubber": Medium(1190.0, 2010.0, 0.16),
    "PTFE": Medium(2200.0, 1050.0, 0.35),
    "PMMA": Medium(1190.0, 1470.0, 0.19),
    "oak": Medium(545.0, 2385.0, 0.17),
}
