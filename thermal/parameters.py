"""What belt, ice, contact and ambient air are together: checked numbers with units and sources."""

import math
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from typing import Any, Self

from pydantic import ValidationError, model_validator
from stickslip.quantity import Table, quantity

from .belt.air import NotLaminar, heated_belt
from .belt.parameters import Belt, Layer
from .contact import Contact
from .ice.parameters import Ice

#: Most cells along the belt: a slip of the unit must not exhaust the memory.
MOST_CELLS = 200_000


class ParameterError(ValueError):
    """A parameter is unknown or out of bounds; one line: key, value, what is allowed."""


class Ambient(Table, strict=False):
    """The air of the cold room: also the temperature that belt and ice start from.

    temperature_degC : air temperature, below 0 where the block is of ice; the source study's runs
        were at -8 and at -16
    """

    temperature_degC: float = quantity(-8.0, "degC", ge=-100.0, le=500.0)


class ThermalParameters(Table, strict=False):
    """Everything that the thermal model needs; each table has defaults."""

    ambient: Ambient = Ambient()
    belt: Belt = Belt()
    ice: Ice = Ice()
    contact: Contact = Contact()

    @model_validator(mode="after")
    def _check_together(self) -> Self:
        for fault in self._faults():
            raise ValueError(fault)
        return self

    def _faults(self) -> Iterator[str]:
        """What the tables contradict each other in, a line each."""
        belt, contact, air = self.belt, self.contact, self.ambient.temperature_degC
        if air >= self.ice.melting_point_degC:
            yield (
                f"ambient.temperature_degC = {air}: ice melts in air of"
                f" {self.ice.melting_point_degC:g} degC and more, allowed is less, or a block of"
                " another material: block.material"
            )
        diameter = 2.0 * contact.radius
        if belt.length <= diameter:
            yield (
                f"belt.length = {belt.length:g} m is shorter than the contact: it must"
                f" exceed 2 contact.radius = {diameter:g} m"
            )
        if belt.length / belt.cell_length > MOST_CELLS:
            yield (
                f"belt.cell_length = {belt.cell_length:g} m cuts the belt into more than"
                f" {MOST_CELLS} cells"
            )
        if self.ice.mesh and contact.length:
            yield (
                f"contact.length = {contact.length:g} m and ice.mesh are both given: the mesh's"
                " base is the contact, leave contact.length out"
            )
        area = contact.length * min(belt.width, diameter)
        face = math.pi * contact.radius**2
        if area > face * (1.0 + 1e-9):
            yield (
                f"contact.length = {contact.length:g} m makes a contact of {area:g} m2, more than"
                f" the ice's face of {face:g} m2: take a larger contact.radius"
            )
        try:
            _ = belt.film
        except NotLaminar as error:
            yield f"belt.still_air_speed: {error}"
        fields = Belt.model_fields
        given = [key for key in Layer.model_fields if getattr(belt, key) != fields[key].default]
        if belt.layers and given:
            yield (
                f"belt.{given[0]} = {getattr(belt, given[0]):g} and belt.layers are both given:"
                " the layers say it all, leave one of the two out"
            )
        one = belt.railing_length + (belt.roller_arc if belt.rollers else 0.0)
        if one > belt.length / max(1, belt.rollers):
            yield (
                f"belt.length = {belt.length:g} m is too short for a railing of"
                f" {belt.railing_length:g} m and {belt.rollers} rollers that touch"
                f" {belt.roller_arc:g} m each"
            )
        if belt.railing_friction > 0.0 and belt.railing_length == 0.0:
            yield (
                f"belt.railing_friction = {belt.railing_friction:g} and belt.railing_length = 0:"
                " there is no railing to rub on; allowed is a length above 0"
            )

    @property
    def melting_rise(self) -> float:
        """The block's melting point above the air, K; infinite where it does not melt."""
        return self.ice.melting_point_degC - self.ambient.temperature_degC

    def in_still_air(self, force: float, speed: float, duration: float) -> Self:
        """With the heat transfer to still air of a belt as warm as friction makes it.

        force: of friction, N; speed: of the belt under the block, m/s; duration: of the run, s, a
        ramp counting half. Itself where belt.air_heat_transfer holds.
        """
        belt = self.belt
        if belt.still_air_speed == 0.0:
            return self
        lane = min(belt.width, 2.0 * self.contact.radius)
        film = heated_belt(
            belt.still_air_speed,
            0.5 * belt.length,
            force * speed / (belt.length * lane),
            belt.capacity_per_area,
            duration,
            self.ambient.temperature_degC,
            belt.width,
        )
        own = belt.model_copy(update={"air_heat_transfer": film, "still_air_speed": 0.0})
        return self.model_copy(update={"belt": own})

    @classmethod
    def checked(cls, tables: Mapping[str, Any]) -> Self:
        """Parameters from a mapping of tables, as a TOML file holds them.

        ParameterError, one line for the first fault, instead of pydantic's report.
        """
        try:
            return cls.model_validate(tables)
        except ValidationError as report:
            raise ParameterError(_one_line(report.errors()[0])) from None


def _fields_of(owner: tuple[str | int, ...]) -> Mapping[str, Any]:
    """Names that are allowed in a table, in one of its layers, or at the top."""
    tables = ThermalParameters.model_fields
    if not owner:
        return tables
    table = Layer if isinstance(owner[-1], int) else tables[str(owner[0])].annotation
    return dict(getattr(table, "model_fields", {}))


def _one_line(fault: Mapping[str, Any]) -> str:
    """Key, value and what is allowed, from an entry of pydantic's report."""
    key = ".".join(str(part) for part in fault["loc"])
    if fault["type"] == "extra_forbidden":
        owner, name = fault["loc"][:-1], str(fault["loc"][-1])
        known = list(_fields_of(owner))
        near = get_close_matches(name, known, 1)
        hint = f"did you mean {near[0]}?" if near else f"known are {', '.join(known)}"
        return f"{key} is not a parameter: {hint}"
    message = fault["msg"].removeprefix("Value error, ")
    return f"{key} = {fault['input']!r}: {message}" if key else message
