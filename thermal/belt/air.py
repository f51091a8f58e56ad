"""Heat from a belt that runs through still air, and what frost on the belt could add to it.

A belt drags its own boundary layer along (Sakiadis 1961, AIChE Journal 7, 26-28): with
eta = y sqrt(U / (nu x)),

    f''' + f f''/2 = 0,    f(0) = 0, f'(0) = 1, f'(inf) = 0,
    theta'' + Pr f theta'/2 = 0,    theta(0) = 1, theta(inf) = 0,

x from where the belt leaves a roller, and Nu_x = -theta'(0) sqrt(Re_x): 0.349 sqrt(Re_x) at the
0.7 of air (0.444 at Pr = 1), measured by Tsou, Sparrow and Goldstein 1967 (Int. J. Heat Mass
Transfer 10, 219-235), who found laminar flow up to Re_x of about 5e5. The mean over a span is
twice the value at its end. A slow belt has natural convection on its two faces, taken as the mean
of a warm plate that looks up and one that looks down, Nu = 0.54 Ra^1/4 and 0.27 Ra^1/4 with
area over perimeter as length (McAdams 1954; Ra from 1e4, used below it, where it adds less than
1 W/m2K); the two are joined as (h1^3 + h2^3)^(1/3). Radiation to walls at the temperature of the
air adds 4 epsilon sigma T^3, epsilon 0.9 for paper, cloth and grit: 3.8 W/m2K at -8 degC.

What frost and moisture move are bounds, not a model (`frost`). Vapour crosses the same boundary
layer as heat does. By the analogy of Chilton and Colburn (1934) its mass flux over its density
difference is h_c/(rho c_p Le^(2/3)), so that a face wet or frosted all over gives the latent heat

    q = h_c s (T - T_air) + h_c (L M_v)/(c_p M_a p Le^(2/3)) (1 - RH) p_s(T_air),
    s = (L M_v)/(c_p M_a p Le^(2/3)) dp_s/dT,

beside h_c (T - T_air): the first term acts like more heat transfer, the second keeps such a face
below the air (the ice bulb's depression) whether it is rubbed or not, so that it is no drift. Over
ice at -8 degC s is about a half. A dry belt has neither.
"""

import math
from typing import NamedTuple

from thermal.materials import GRAVITY, ZERO_DEGC

#: Nu_x / sqrt(Re_x) on a continuous moving belt, air (Pr = 0.7).
SAKIADIS_AIR = 0.3492

#: Largest Reynolds number over a span for which the boundary layer is known to be laminar.
LAMINAR = 5e5

#: Part of the friction heat that the belt takes, for the rise in natural convection alone: with the
#: 0.2 to 0.8 that belts of 0.2 to 4 m were computed to take, h is 1 % another.
_BELT_PART = 0.5
#: Rounds from h to the rise and back: each leaves less than a quarter of the error.
_ROUNDS = 8

_STEFAN_BOLTZMANN = 5.670374e-8
_EMISSIVITY = 0.9


class NotLaminar(ValueError):
    """Outside the range in which the correlation was measured."""


def _air(temperature: float) -> tuple[float, float]:
    """Kinematic viscosity m2/s and conductivity W/mK of dry air at 1 atm, temperature K.

    Power laws through the values at 0 degC, within 1 % of tables from -50 to 50 degC.
    """
    ratio = temperature / ZERO_DEGC
    return 1.33e-5 * ratio**1.76, 0.0241 * ratio**0.82


def moving_belt(
    speed: float,
    span: float,
    temperature_degC: float = -8.0,
    width: float = 0.075,
    rise: float = 1.0,
) -> float:
    """Mean heat transfer coefficient of a belt's faces, convection and radiation, W/m2K.

    speed m/s, either way; span m of belt from one roller to the next, about half a loop; air
    temperature degC; width m and rise K of the belt matter for natural convection alone.
    NotLaminar above Re = 5e5.
    """
    return convection(speed, span, temperature_degC, width, rise) + radiation(temperature_degC)


def heated_belt(
    speed: float,
    span: float,
    heating: float,
    capacity: float,
    duration: float,
    temperature_degC: float = -8.0,
    width: float = 0.075,
) -> float:
    """`moving_belt` at the mean rise that friction gives the belt at the end of a run, W/m2K.

    heating: friction heat over the area of the whole belt, W/m2; capacity: of the belt, J/m2K;
    duration: of the run, s. The belt is one body that takes half of the heat, s q, and gives some
    to the air on both faces: rise = s q (1 - exp(-2 h t / C)) / (2 h), with the h at that rise.
    """
    h = moving_belt(speed, span, temperature_degC, width)
    for _ in range(_ROUNDS):
        rise = -_BELT_PART * heating / (2.0 * h) * math.expm1(-2.0 * h * duration / capacity)
        h = moving_belt(speed, span, temperature_degC, width, rise)
    return h


def convection(
    speed: float,
    span: float,
    temperature_degC: float = -8.0,
    width: float = 0.075,
    rise: float = 1.0,
) -> float:
    """The convective part of `moving_belt`, W/m2K."""
    if not (span > 0.0 and width > 0.0 and rise >= 0.0 and temperature_degC > -ZERO_DEGC):
        raise ValueError(
            f"span = {span:g} m, width = {width:g} m, rise = {rise:g} K at {temperature_degC:g}"
            " degC: span and width must be positive, the rise not negative"
        )
    temperature = temperature_degC + ZERO_DEGC
    viscosity, conductivity = _air(temperature)
    reynolds = abs(speed) * span / viscosity
    if not reynolds <= LAMINAR:
        raise NotLaminar(
            f"speed = {speed:g} m/s over a span of {span:g} m: Re = {reynolds:.2g}, but the"
            f" correlation for a moving belt is laminar, up to {LAMINAR:g}; give a number"
        )
    forced = 2.0 * SAKIADIS_AIR * math.sqrt(reynolds) * conductivity / span
    size = span * width / (2.0 * (span + width))
    rayleigh = 0.7 * GRAVITY / temperature * rise * size**3 / viscosity**2
    natural = 0.5 * (0.54 + 0.27) * rayleigh**0.25 * conductivity / size
    found: float = (forced**3 + natural**3) ** (1.0 / 3.0)
    return found


def radiation(temperature_degC: float) -> float:
    """The radiative part, to walls as cold as the air, W/m2K."""
    temperature = temperature_degC + ZERO_DEGC
    return 4.0 * _EMISSIVITY * _STEFAN_BOLTZMANN * temperature**3


def laminar_span(speed: float, temperature_degC: float) -> float:
    """Longest span over which the air along a belt is known to be laminar, m."""
    viscosity, _ = _air(temperature_degC + ZERO_DEGC)
    return LAMINAR * viscosity / abs(speed) if speed != 0.0 else math.inf


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
