"""The source study's check of the belt length: one pass under the ice, then Newton cooling.

The friction heat of one contact length warms the stretch of belt that passed, evenly and with
nothing into the ice; on its way round the loop the stretch cools towards the air,

    T2 = T_air + F l / (m c) exp(-kappa t),    t = (L - l) / v.

It counts a single pass; a belt that runs for 20 s passes again and again and keeps a part of the
heat each time. The rate kappa = 0.25 1/s is, in the study, a conductivity in W/mK used as a rate.
"""

import math
from dataclasses import dataclass

from thermal.materials import GRAVITY


@dataclass(frozen=True)
class SinglePass:
    """Inputs of the check; SI units, temperatures in degC.

    friction_force N; contact_length m; heated_mass kg of belt; heat_capacity J/kgK; speed m/s;
    cooling_rate 1/s; ambient_degC degC.
    """

    friction_force: float
    contact_length: float = 0.08
    heated_mass: float = 0.028 * 10.0 / 53.3
    heat_capacity: float = 840.0
    speed: float = 0.82
    cooling_rate: float = 0.25
    ambient_degC: float = -8.0

    def __post_init__(self) -> None:
        positive = ("contact_length", "heated_mass", "heat_capacity", "speed")
        for name in ("friction_force", "cooling_rate", "ambient_degC", *positive):
            value = getattr(self, name)
            if not math.isfinite(value) or (name in positive and value <= 0.0):
                raise ValueError(
                    f"{name} = {value:g}: must be finite"
                    f"{' and positive' if name in positive else ''}"
                )

    @property
    def rise(self) -> float:
        """Temperature rise of the belt in the pass, K."""
        return self.friction_force * self.contact_length / (self.heated_mass * self.heat_capacity)

    def temperature_degC(self, belt_length: float) -> float:
        """Temperature of the stretch when it meets the ice again, degC; belt_length in m."""
        if not belt_length >= self.contact_length:
            raise ValueError(
                f"belt_length = {belt_length:g} m: must be at least the contact's"
                f" {self.contact_length:g} m"
            )
        time = (belt_length - self.contact_length) / self.speed
        return self.ambient_degC + self.rise * math.exp(-self.cooling_rate * time)


#: The friction force as the study prints it, N: its table of temperatures follows from this one.
PRINTED = SinglePass(friction_force=4.1261)

#: The friction force as the study's own factors give it: 4.0349 N, 2.2 % less.
FROM_FACTORS = SinglePass(friction_force=0.3 * 1.371 * GRAVITY)
