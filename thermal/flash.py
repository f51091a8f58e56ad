"""Flash temperature: what an asperity in contact adds to the temperature of the nominal face.

A grain of the belt touches the ice over a square of side 2 b and presses on it with p, so the
friction heat of that spot is q = mu p v, far above the mean over the contact. For the grain the
source stands still, for the ice it moves. The mean excess over the square, for a flux q into a
half-space of conductivity k, effusivity e and diffusivity alpha (Carslaw and Jaeger 1959, 10.5;
Jaeger 1942), is

    standing           0.9464 q b/k,
    fast               (4/3) q sqrt(2 b/(pi v))/e,
    between            1/T^2 = 1/T_standing^2 + 1/T_fast^2     (Greenwood 1991, Wear 150, 153-158),

and the heat divides so that both sides have the same mean (Blok 1937).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .parameters import ThermalParameters

#: Mean over a square source of half-side b on a half-space at rest: T k/(q b).
STANDING_SQUARE = 0.9464


@dataclass(frozen=True)
class Flash:
    """excess: over the nominal faces, K; belt_share: of the asperity's heat."""

    excess: float
    belt_share: float


def standing_response(half_side: float, conductivity: float) -> float:
    """Mean excess for 1 W/m2 into a body that the asperity belongs to, K m2/W."""
    return STANDING_SQUARE * half_side / conductivity


def moving_response(half_side: float, speed: float, conductivity: float, capacity: float) -> float:
    """The same for a body along which it moves (m/s); capacity J/m3K."""
    standing = standing_response(half_side, conductivity)
    if speed == 0.0:
        return standing
    fast = (4.0 / 3.0) * math.sqrt(
        2.0 * half_side / (math.pi * abs(speed) * conductivity * capacity))
    return 1.0 / math.hypot(1.0 / standing, 1.0 / fast)


def asperity_flash(parameters: ThermalParameters, half_side: float, pressure: float,
                   friction: float, speed: float) -> Flash:
    """Excess at a grain of the belt's first layer on the ice.

    half_side: of the touching square, m; pressure: on it, Pa, at most the hardness of ice (some
    2e7); friction: its coefficient; speed: of sliding, m/s. Not bounded by melting, which a
    caller sees by adding the nominal temperature. ValueError for what cannot be.
    """
    for name, value in (("half_side", half_side), ("pressure", pressure)):
        if not (math.isfinite(value) and value > 0.0):
            raise ValueError(f"{name} = {value:g}: must be above 0")
    if not (math.isfinite(friction * speed) and friction >= 0.0):
        raise ValueError(f"friction = {friction:g}, speed = {speed:g} m/s: must be finite, the"
                         " friction not negative")
    grain, ice = parameters.belt.stack[0], parameters.ice
    of_belt = standing_response(half_side, grain.conductivity)
    of_ice = moving_response(
        half_side, speed, ice.conductivity, ice.density * ice.heat_capacity)
    together = 1.0 / (1.0 / of_belt + 1.0 / of_ice)
    return Flash(friction * pressure * abs(speed) * together, together / of_belt)
