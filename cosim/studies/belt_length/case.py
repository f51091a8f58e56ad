"""One case: what is chosen, how it is run, and the thermal models that follow from it."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, NamedTuple, Self

from cosim.coupling.case.thermal_participant import prepared_block
from cosim.scenario.toml_file import changed_tables
from thermal import Belt, Contact, Ice, SlidingState, SteadySliding, ThermalParameters
from thermal.belt.air import Frost, convection, frost, heated_belt, laminar_span, radiation
from thermal.belt.single_pass import SinglePass
from thermal.contact import Footprint
from thermal.ice.body import IceBody
from thermal.materials import GRAVITY, MELTING_POINT_DEGC


class StudyError(ValueError):
    """A case that cannot be; one line: what, value, what is allowed."""


#: Most runs in a row: each is followed.
_MOST_RUNS = 100


@dataclass(frozen=True)
class Protocol:
    """One or more runs, the first from belt and ice as cold as the air.

    ramp: from standstill to the speed, evenly, s; run: at constant speed, s; pause: between two
    runs, s, the belt stands still and the ice rests on it, or is lifted off. The study: 10 s and
    20 s; it tells no pause.
    """

    ramp: float = 10.0
    run: float = 20.0
    pause: float = 0.0
    runs: int = 1
    lifted: bool = False

    def __post_init__(self) -> None:
        for name, value in (("ramp", self.ramp), ("pause", self.pause)):
            if not 0.0 <= value < math.inf:
                raise StudyError(f"--{name} = {value:g} s: must be at least 0")
        if not 0.0 < self.run < math.inf:
            raise StudyError(f"--run = {self.run:g} s: must be above 0")
        if not 1 <= self.runs <= _MOST_RUNS:
            raise StudyError(f"--runs = {self.runs}: must be 1 to {_MOST_RUNS}")

    @property
    def moving(self) -> float:
        """Time at full speed in which the belt goes as far as in one run with its ramp, s."""
        return 0.5 * self.ramp + self.run

    def in_words(self) -> str:
        """As verdicts and figures say it."""
        ramp = f"{self.ramp:g} s of ramp and " if self.ramp > 0.0 else ""
        each = f"{ramp}{self.run:g} s at constant speed"
        if self.runs == 1:
            return each
        return f"{self.runs} runs of {each}, {self.pause:g} s between two"


class Range(NamedTuple):
    """Between what an unknown (`unknowns`) lies, where that is not usual; basis: why."""

    key: str
    low: float
    high: float
    basis: str


#: Resolution of the study: 0.2 % of the rise, a tenth of the time of the model's own.
RESOLUTION = {
    "belt.elements": 3,
    "contact.strips": 8,
    "ice.radial_elements": 4,
    "ice.axial_elements": 8,
}
COARSENESS = 2.0
#: Elements where rollers conduct: they take heat from the back within a fraction of a second, and
#: with half as many a rise was up to 5 % off (1000 W/m2K, three layers), so it is 2 %. What a
#: roller left comes round as a front, which the steps smear: 11 % where one enters just as the run
#: ends, 2 % with steps of a quarter, which would take four times as long.
ELEMENTS_ON_ROLLERS = 6
#: Waves of the series along the loop in a metre, and in the length of a contact: one that is
#: shorter than the shortest wave would be smeared into the place where the belt enters.
WAVES_PER_METRE, WAVES_PER_CONTACT = 150, 9.0
#: Fewest and most waves of the series.
FEWEST_WAVES, MOST_WAVES = 40, 7500
#: Length of belt that the study lets be heated in a pass, m.
CONTACT_LENGTH = 0.08
AIR = "belt.air_heat_transfer"
#: Thermal key -> field of a case that stands in its place.
OWN_KEYS = {
    "belt.length": "length",
    "belt.conductivity": "conductivity",
    "belt.thickness": "thickness",
    AIR: "h",
    "contact.conductance": "conductance",
    "ambient.temperature_degC": "ambient_degC",
}


@dataclass(frozen=True)
class Case:
    """SI units; conductance of the contact, W/m2K.

    h: on both faces of the belt, W/m2K; None: that of a belt moving through still air, which
    follows speed and length. rig: everything else that the thermal model knows; conductivity,
    thickness, conductance: None where they are the rig's. ice_rise: of the ice above the air at the
    start, K. ranges: of what is not known of this rig, where they are not the usual ones.
    static_over_kinetic friction and stiffness of one of four springs, N/m, make the
    stick-slip motion; those of the study's rig. drawn: one of the many rigs of a doubt, which is
    computed as if its rollers did not conduct, that is more coarsely.
    """

    length: float
    speed: float
    mass: float = 1.371
    h: float | None = None
    conductivity: float | None = None
    friction: float = 0.3
    ambient_degC: float = -8.0
    conductance: float | None = None
    thickness: float | None = None
    protocol: Protocol = Protocol()
    rig: ThermalParameters = ThermalParameters()
    ice_rise: float = 0.0
    static_over_kinetic: float = 0.2815 / 0.2086
    stiffness: float = 20.17
    ranges: tuple[Range, ...] = ()
    drawn: bool = False

    def __post_init__(self) -> None:
        for name in ("speed", "mass", "friction"):
            value = getattr(self, name)
            if not 0.0 < value < math.inf:
                raise StudyError(f"{name} = {value:g}: must be above 0")

    @property
    def force(self) -> float:
        """Friction force of sliding, N; the mean over stick-slip, too, where mu_s only adds."""
        return self.friction * self.mass * GRAVITY

    @property
    def travel(self) -> float:
        """How far the belt goes in all runs, m."""
        return self.protocol.runs * self.protocol.moving * self.speed

    @property
    def film(self) -> float:
        """Heat transfer on each face of the running belt, W/m2K.

        In the ramp, too: the still air of a slower belt would change the drift by less than 0.3 %.
        """
        return self._film(self.speed, self.protocol.moving)

    @property
    def pause_film(self) -> float:
        """The same while the belt stands still: a draught stays, air dragged along does not."""
        return self._film(0.0, self.protocol.moving)

    @property
    def lasting(self) -> Self:
        """The same for ever, when the belt is warmer and still air takes more."""
        return replace(self, h=self._film(self.speed, math.inf))

    def _film(self, speed: float, duration: float) -> float:
        """As given, or by still air at a belt as warm as friction makes it in a time, s."""
        if self.h is not None:
            return self.h
        belt = self.rig.belt
        if self.thickness is not None:
            belt = belt.model_copy(update={"thickness": self.thickness})
        heating = self.force * self.speed / (self.length * min(belt.width, self._diameter))
        capacity, air = belt.capacity_per_area, self.ambient_degC
        return heated_belt(speed, self._span, heating, capacity, duration, air, belt.width)

    @property
    def _diameter(self) -> float:
        return 2.0 * self.rig.contact.radius

    @property
    def _span(self) -> float:
        """Of belt from roller to roller, m: half a loop, as far as the air stays laminar.

        Farther on more heat is transferred than by laminar air, so the drift is not more than told.
        """
        # the last digits keep the Reynolds number from exceeding its bound by rounding
        return min(0.5 * self.length, 0.999999 * laminar_span(self.speed, self.ambient_degC))

    @property
    def shortest(self) -> float:
        """Shortest belt on which contact, railing and rollers have room, m."""
        belt, touching = self.rig.belt, _block(self.rig)[0].length
        one = belt.railing_length + (belt.roller_arc if belt.rollers else 0.0)
        return 1.05 * max(self._diameter, touching, one * max(1, belt.rollers))

    @property
    def frost(self) -> Frost | None:
        """What frost on the belt can do at most; None in air in which there is none."""
        if self.ambient_degC >= MELTING_POINT_DEGC:
            return None
        carried = convection(self.speed, self._span, self.ambient_degC, self.rig.belt.width)
        return frost(carried, radiation(self.ambient_degC), self.ambient_degC)

    @property
    def drive(self) -> Self:
        """What cases have in common that differ in length alone: the same on 1 m."""
        return self.with_length(1.0)

    def with_length(self, length: float) -> Self:
        """The same on another belt."""
        return replace(self, length=length)

    def changed(self, keys: Mapping[str, float]) -> Self:
        """The same with other numbers of the thermal model, `block.key` -> value."""
        own: Any = {OWN_KEYS[key]: value for key, value in keys.items() if key in OWN_KEYS}
        others = {key: value for key, value in keys.items() if key not in OWN_KEYS}
        # railing and rollers must find room on this belt
        rig = changed_tables(self.rig.model_dump(), {"belt.length": self.length} | others)
        return replace(self, rig=ThermalParameters.checked(rig), **own)

    def thermal(self) -> ThermalParameters:
        """Parameters of the thermal model, at the resolution of the study."""
        keys = {key: getattr(self, field) for key, field in OWN_KEYS.items()}
        keys = {key: value for key, value in keys.items() if value is not None}
        keys |= RESOLUTION | {"belt.still_air_speed": 0.0}
        belt = self.rig.belt
        if belt.railing_load == 0.0:
            keys["belt.railing_load"] = self.mass * GRAVITY
        # rollers that take more heat than the air in their place
        if not self.drawn and belt.rollers > 0 and belt.roller_conductance > self.film:
            keys["belt.elements"] = ELEMENTS_ON_ROLLERS
        tables = changed_tables(self.rig.model_dump(), keys)
        if self.h is None:
            # the length is checked first, for the air's number needs one that can be
            ThermalParameters.checked(changed_tables(tables, {AIR: 1.0}))
            tables = changed_tables(tables, {AIR: self.film})
        return ThermalParameters.checked(tables)

    def sliding(self, sensitivity: float = 0.0) -> SteadySliding:
        """Belt and ice before the first run.

        sensitivity: part of the friction lost for each kelvin of the interface's rise, 1/K.
        """
        parameters = self.thermal()
        block = _block(parameters)
        per_metre = max(WAVES_PER_METRE, WAVES_PER_CONTACT / block[0].length)
        waves = min(max(FEWEST_WAVES, round(per_metre * self.length)), MOST_WAVES)
        return SteadySliding(
            parameters, self.speed, self.force, waves, block, sensitivity, self.ice_rise
        )

    def follow(self, sliding: SteadySliding) -> tuple[SlidingState, SlidingState]:
        """Through all runs of the protocol: the state where the last ramp ends, and at the end."""
        for run in range(self.protocol.runs):
            if run > 0:
                self.rest(sliding, self.protocol.pause)
            started = sliding.ramp(self.protocol.ramp, COARSENESS)
            ended = sliding.run(self.protocol.run, COARSENESS)
        return started, ended

    def rest(self, sliding: SteadySliding, duration: float) -> SlidingState:
        """A pause of some duration, s."""
        return sliding.pause(duration, self.pause_film, self.protocol.lifted)

    def as_the_study(self) -> SinglePass:
        """The study's check: all heat to the belt, one pass, kappa as a rate."""
        return SinglePass(
            friction_force=self.force, speed=self.speed, ambient_degC=self.ambient_degC
        )

    def single_pass(self) -> SinglePass:
        """The same with its faults mended: the belt's mass per length, cooled by h on two faces."""
        parameters = self.thermal()
        belt, footprint = parameters.belt, _block(parameters)[0]
        capacity = belt.capacity_per_area
        return SinglePass(
            friction_force=self.force,
            contact_length=footprint.length,
            speed=self.speed,
            heated_mass=capacity / belt.heat_capacity * footprint.lane * footprint.length,
            heat_capacity=belt.heat_capacity,
            cooling_rate=2.0 * self.film / capacity,
            ambient_degC=self.ambient_degC,
        )


def _block(rig: ThermalParameters) -> tuple[Footprint, IceBody]:
    """One block for all belts of its width, in turn: its modes take longer than a belt's."""
    contact = rig.contact.model_copy(update={"conductance": 1.0, "belt_side": 0.5})
    return _standing(rig.ice, contact, rig.belt.width)


@lru_cache(maxsize=128)
def _standing(ice: Ice, contact: Contact, width: float) -> tuple[Footprint, IceBody]:
    long_enough = Belt(width=width, length=100.0)
    return prepared_block(ThermalParameters(belt=long_enough, ice=ice, contact=contact))
