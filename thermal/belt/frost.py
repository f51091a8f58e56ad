"""Heat that frost and moisture move between the belt and the air: bounds, not a model.

Vapour crosses the same boundary layer as heat does. By the analogy of Chilton and Colburn (1934)
its mass flux over its density difference is h_c/(rho c_p Le^(2/3)), so that a face wet or frosted
all over gives the latent heat

    q = h_c s (T - T_air) + h_c (L M_v)/(c_p M_a p Le^(2/3)) (1 - RH) p_s(T_air),
    s = (L M_v)/(c_p M_a p Le^(2/3)) dp_s/dT,

beside h_c (T - T_air): the first term acts like more heat transfer, the second keeps such a face
below the air (the ice bulb's depression) whether it is rubbed or not, so that it is no drift. Over
ice at -8 degC s is about a half. A dry belt has neither.
"""

import math
from typing import NamedTuple

from thermal.materials import ZERO_DEGC

#: Of ice to vapour, J/kg; gas constant of vapour, J/(kg K).
_SUBLIMATION, _VAPOUR = 2.834e6, 461.5
#: Heat capacity of air, J/(kg K); pressure, Pa; mass of a mole of vapour over one of air; Lewis
#: number, thermal over vapour's diffusivity.
_AIR, _PRESSURE, _MOLES, _LEWIS = 1005.0, 101325.0, 0.622, 0.85
#: Of rime, kg/m3 and J/(kg K).
_RIME = 200.0 * 2050.0


class Frost(NamedTuple):
    """What frost on the belt's faces can do at most.

    added: heat transfer beside h_c, W/m2K, in air saturated or not; depression: of a frosted face
    below air of relative humidity RH, K, for 1 - RH; capacity: of a layer a tenth of a millimetre
    thick on one face, J/m2K.
    """

    added: float
    depression: float
    capacity: float


def saturation_over_ice(temperature_degC: float) -> float:
    """Vapour pressure, Pa, -100 to 0 degC: Murphy and Koop 2005, QJRMS 131, 1539-1565, eq. 7."""
    t = temperature_degC + ZERO_DEGC
    return math.exp(9.550426 - 5723.265 / t + 3.53068 * math.log(t) - 0.00728332 * t)


def frost(convection: float, radiation: float, temperature_degC: float) -> Frost:
    """Bounds for a face with heat transfer by convection and radiation (W/m2K) in air (degC)."""
    t = temperature_degC + ZERO_DEGC
    pressure = saturation_over_ice(temperature_degC)
    moved = _SUBLIMATION * _MOLES / (_AIR * _PRESSURE * _LEWIS ** (2.0 / 3.0))
    added = convection * moved * _SUBLIMATION * pressure / (_VAPOUR * t**2)
    return Frost(
        added, convection * moved * pressure / (convection + radiation + added), 1e-4 * _RIME
    )
