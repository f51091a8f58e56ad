"""One case of the belt-length study: what is chosen, and the models that follow from it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache

from thermal import Belt, Contact, Ice, ThermalParameters
from thermal.constants import GRAVITY
from thermal.footprint import Footprint
from thermal.ice import Ice as IceField
from thermal.single_pass import SinglePass
from thermal.steady_sliding import SteadySliding, standing_ice


class StudyError(ValueError):
    """A case that cannot be; one line: what, value, what is allowed."""


#: Resolution of the belt: 0.2 % of the rise, a tenth of the time of the model's own.
ELEMENTS, STRIPS, WAVES_PER_METRE, COARSENESS = 3, 8, 150, 2.0
#: Fewest and most waves of the series along the loop.
FEWEST_WAVES, MOST_WAVES = 40, 3000
#: Length of belt that the study lets be heated in a pass, m.
CONTACT_LENGTH = 0.08


@dataclass(frozen=True)
class Case:
    """SI units; h on both faces of the belt, W/m2K; conductance of the contact, W/m2K."""

    length: float
    speed: float
    mass: float = 1.371
    h: float = 15.0
    conductivity: float = 0.5
    friction: float = 0.3
    ambient_degC: float = -8.0
    conductance: float = 1e4
    thickness: float = 1e-3

    def __post_init__(self) -> None:
        for name in ("speed", "mass", "friction"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise StudyError(f"{name} = {value:g}: must be above 0")

    @property
    def force(self) -> float:
        """Friction force of steady sliding, N."""
        return self.friction * self.mass * GRAVITY

    def with_length(self, length: float) -> Case:
        """The same on another belt."""
        return replace(self, length=length)

    def thermal(self, *, fine: bool = False) -> ThermalParameters:
        """Parameters of the thermal model; fine: at the model's own resolution."""
        belt = {
            "length": self.length, "air_heat_transfer": self.h, "thickness": self.thickness,
            "conductivity": self.conductivity,
        }
        contact: dict[str, float] = {"conductance": self.conductance}
        if not fine:
            belt["elements"], contact["strips"] = ELEMENTS, STRIPS
        return ThermalParameters.checked(
            {"ambient": {"temperature_degC": self.ambient_degC}, "belt": belt, "contact": contact})

    def sliding(self, sensitivity: float = 0.0) -> SteadySliding:
        """The belt in steady sliding, cold at the start.

        sensitivity: part of the friction lost for each kelvin of the interface's rise, 1/K.
        """
        parameters = self.thermal()
        waves = min(max(FEWEST_WAVES, round(WAVES_PER_METRE * self.length)), MOST_WAVES)
        return SteadySliding(
            parameters, self.speed, self.force, waves,
            _ice(parameters.ice, parameters.contact.radius, parameters.belt.width), sensitivity)

    def as_the_study(self) -> SinglePass:
        """The study's check: all heat to the belt, one pass, kappa as a rate."""
        return SinglePass(friction_force=self.force, speed=self.speed,
                          ambient_degC=self.ambient_degC)

    def single_pass(self) -> SinglePass:
        """The same with its faults mended: the belt's mass per length, cooled by h on two faces."""
        belt = self.thermal().belt
        contact = Contact()
        length = Footprint(contact.radius, belt.width, 1).length
        capacity = belt.capacity_per_area
        return SinglePass(
            friction_force=self.force, contact_length=length, speed=self.speed,
            heated_mass=capacity / belt.heat_capacity * belt.width * length,
            heat_capacity=belt.heat_capacity, cooling_rate=2.0 * self.h / capacity,
            ambient_degC=self.ambient_degC)


@lru_cache(maxsize=8)
def _ice(ice: Ice, radius: float, width: float) -> IceField:
    """One block of ice for all belts of its width: its modes take longer than a belt's."""
    contact = Contact(radius=radius)
    parameters = ThermalParameters(belt=Belt(width=width), ice=ice, contact=contact)
    return standing_ice(parameters, Footprint(radius, width, contact.strips))
