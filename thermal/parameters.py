"""What belt, ice, contact and ambient air are: checked numbers with units and sources."""

from __future__ import annotations

import math
from collections.abc import Mapping
from difflib import get_close_matches
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from .air import NotLaminar, moving_belt
from .constants import MELTING_POINT_DEGC, ZERO_DEGC

#: Most cells along the belt: a slip of the unit must not exhaust the memory.
MOST_CELLS = 200_000


def quantity(default: float, unit: str, description: str, **bounds: Any) -> Any:
    """A number with its unit (`1` for none) in the JSON schema and in its description."""
    return Field(
        default, description=f"{description} [{unit}]", json_schema_extra={"unit": unit}, **bounds
    )


class ParameterError(ValueError):
    """A parameter is unknown or out of bounds; one line: key, value, what is allowed."""


class Block(BaseModel):
    """A block of parameters: unknown keys, NaN and infinity are refused; nothing changes later."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, frozen=True)


class Ambient(Block):
    """The air of the cold room: also the temperature that belt and ice start from."""

    temperature_degC: float = quantity(
        -8.0,
        "degC",
        "air temperature; the first of the test rig's two, -8 and -16",
        ge=-100.0,
        lt=MELTING_POINT_DEGC,
    )


class Layer(Block):
    """One layer of a belt."""

    thickness: float = quantity(..., "m", "thickness", gt=0.0, le=0.1)
    density: float = quantity(..., "kg/m3", "density", gt=0.0, le=3e4)
    heat_capacity: float = quantity(..., "J/(kg.K)", "specific heat capacity", gt=0.0, le=1e5)
    conductivity: float = quantity(..., "W/(m.K)", "thermal conductivity", gt=0.0, le=1e4)


class Belt(Block):
    """An endless belt, one homogeneous layer unless `layers` says otherwise.

    Length, width and mass per length (0.0525 kg/m at 75 mm) are those of the sanding belt of
    the test rig; 840 J/kgK is the source study's figure. Conductivity of paper and cloth
    backed abrasive lies in 0.25 ... 2 W/mK and was not measured. 5 ... 25 W/m2K is still air
    to a light draught; the study's rate of 0.25 1/s would need 73.5 W/m2K.

    A railing carries the belt below the ice, rollers turn it: where they touch the back, they
    take the place of the air, at the air's temperature unless the rollers are warmer. A railing of
    conductance 0 only covers. The belt rubs on its railing under the block's weight; the part of
    that heat that enters the belt does so evenly along the railing, the rest is the railing's.
    """

    length: float = quantity(1.0, "m", "length of the loop", gt=0.0, le=100.0)
    width: float = quantity(0.075, "m", "width", gt=0.0, le=10.0)
    thickness: float = quantity(1e-3, "m", "thickness", gt=0.0, le=0.1)
    density: float = quantity(700.0, "kg/m3", "density", gt=0.0, le=3e4)
    heat_capacity: float = quantity(840.0, "J/(kg.K)", "specific heat capacity", gt=0.0, le=1e5)
    conductivity: float = quantity(0.5, "W/(m.K)", "thermal conductivity", gt=0.0, le=1e4)
    air_heat_transfer: float = quantity(
        15.0, "W/(m2.K)", "heat transfer to the air, on each free face", ge=0.0, le=1e4
    )
    still_air_speed: float = quantity(
        0.0,
        "m/s",
        "speed of the belt through still air, from which its heat transfer then follows"
        " in place of air_heat_transfer; 0: that number holds",
        ge=0.0,
        le=1e3,
    )
    layers: tuple[Layer, ...] = Field(
        (),
        max_length=10,
        description="layers from the contact face to the back, in place of thickness, density,"
        " heat_capacity and conductivity",
    )
    railing_length: float = quantity(
        0.0,
        "m",
        "length of the railing along the belt, its middle below the contact's; 0: none",
        ge=0.0,
        le=100.0,
    )
    railing_conductance: float = quantity(
        0.0, "W/(m2.K)", "from the back of the belt to the railing", ge=0.0, le=1e12
    )
    railing_friction: float = quantity(
        0.0,
        "1",
        "coefficient of friction of the belt on its railing; 0: none; PTFE 0.04 to 0.2",
        ge=0.0,
        le=10.0,
    )
    railing_load: float = quantity(
        0.0,
        "N",
        "load of the belt on its railing; 0: the block's weight in a scenario, none where"
        " there is no block",
        ge=0.0,
        le=1e6,
    )
    railing_share: float = quantity(
        0.5, "1", "share of the railing's friction heat that enters the belt", ge=0.0, le=1.0
    )
    rollers: int = Field(
        0, ge=0, le=20, description="rollers, evenly spread from half a spacing after the contact"
    )
    roller_arc: float = quantity(
        0.1,
        "m",
        "length of belt that touches a roller; half the circumference of a 64 mm one",
        gt=0.0,
        le=100.0,
    )
    roller_conductance: float = quantity(
        100.0, "W/(m2.K)", "from the back of the belt to a roller", ge=0.0, le=1e12
    )
    roller_rise: float = quantity(
        0.0,
        "K",
        "rollers above the air, warmed by their drive and by flexing the belt",
        ge=-100.0,
        le=100.0,
    )
    elements: int = Field(
        6, ge=1, le=40, description="P2 elements through the thickness, finest at the contact"
    )
    cell_length: float = quantity(
        1e-3, "m", "length of a cell along the belt; rounded to fit the loop", gt=0.0, le=1.0
    )

    @property
    def cells(self) -> int:
        """Cells along the loop, at least eight."""
        return max(8, round(self.length / self.cell_length))

    @property
    def film(self) -> float:
        """Heat transfer to the air on each free face, W/m2K: given, or of a moving belt.

        The belt's spans between its rollers are half a loop; air at -8 degC, since 8 K change
        it by 3 %.
        """
        if self.still_air_speed == 0.0:
            return self.air_heat_transfer
        return moving_belt(self.still_air_speed, 0.5 * self.length, width=self.width)

    @property
    def stack(self) -> tuple[Layer, ...]:
        """The layers, one of the belt's own properties when none are given."""
        return self.layers or (
            Layer(
                thickness=self.thickness,
                density=self.density,
                heat_capacity=self.heat_capacity,
                conductivity=self.conductivity,
            ),
        )

    @property
    def capacity_per_area(self) -> float:
        """Heat capacity of the belt per area, J/m2K."""
        return sum(layer.thickness * layer.density * layer.heat_capacity for layer in self.stack)


class Ice(Block):
    """A standing cylinder of ice on the belt; its radius is the contact's.

    The sample of the test rig: diameter 8 cm, height 10 cm. Properties of ice Ih near -8 degC,
    constant: between -16 and 0 degC conductivity falls by 9 % while capacity grows by 6 %, so the
    face's rise under a given flux is 1.0 % low for rises below 1 K from -8 degC (0.2 % from -16),
    and 1.8 % low for one up to melting. With `Ice.at` the temperature that the face comes to it
    errs by 0.1 %. 10 W/m2K on side and top: natural convection and radiation, about 5 each.
    """

    mesh: str = Field(
        "",
        max_length=1000,
        description="file with the sample's shape as tetrahedra in metres, standing on z = 0 with"
        " the belt along x (.msh, .vtk, .vtu, ...); in place of height, elements and"
        " the contact's radius and length",
    )
    height: float = quantity(0.10, "m", "height", gt=0.0, le=10.0)
    density: float = quantity(917.0, "kg/m3", "density", gt=0.0, le=3e4)
    heat_capacity: float = quantity(2050.0, "J/(kg.K)", "specific heat capacity", gt=0.0, le=1e5)
    conductivity: float = quantity(2.2, "W/(m.K)", "thermal conductivity", gt=0.0, le=1e4)
    latent_heat: float = quantity(334e3, "J/kg", "latent heat of melting", gt=0.0, le=1e7)
    air_heat_transfer: float = quantity(
        10.0, "W/(m2.K)", "heat transfer to the air, on side and top", ge=0.0, le=1e4
    )
    radial_elements: int = Field(
        6, ge=1, le=40, description="P2 elements along the radius, finest at the side"
    )
    axial_elements: int = Field(
        10, ge=1, le=40, description="P2 elements along the height, finest at the contact"
    )

    @classmethod
    def at(cls, temperature_degC: float, **others: Any) -> Self:
        """Ice with the conductivity and capacity that it has at a temperature; others: any keys.

        k = 9.828 exp(-0.0057 T) W/mK, c = 152.5 + 7.122 T J/kgK, T in K (Yen, Review of thermal
        properties of snow, ice and sea ice, CRREL 81-10, 1981).

        >>> round(Ice.at(-4.0).conductivity, 3), round(Ice.at(-4.0).heat_capacity)
        (2.119, 2069)
        """
        kelvin = temperature_degC + ZERO_DEGC
        return cls(
            conductivity=9.828 * math.exp(-0.0057 * kelvin),
            heat_capacity=152.5 + 7.122 * kelvin,
            **others,
        )


class Contact(Block):
    """Where ice and belt touch, and how well heat crosses.

    A conductance above 1e3 W/m2K changes the heat shares by less than 0.005.
    """

    radius: float = quantity(0.04, "m", "radius of the ice cylinder", gt=0.0, le=10.0)
    length: float = quantity(
        0.0,
        "m",
        "length of a rectangular contact along the motion, as wide as the belt or the"
        " cylinder, the narrower; 0: the contact is the part of the cylinder's face on the belt",
        ge=0.0,
        le=20.0,
    )
    conductance: float = quantity(
        1e4, "W/(m2.K)", "contact conductance between the two faces", gt=0.0, le=1e12
    )
    wiper: float = quantity(
        0.0,
        "1",
        "part of the water and of the ice on the belt that a wiper in front of the"
        " contact takes off",
        ge=0.0,
        le=1.0,
    )
    load: float = quantity(
        0.0,
        "N",
        "weight on the contact, which squeezes melt water out; 0: that of the ice",
        ge=0.0,
        le=1e9,
    )
    belt_side: float = quantity(
        0.5,
        "1",
        "share of the friction heat that arises on the belt's face, the rest on the"
        " ice's; what each keeps follows from the conductance and from how both conduct",
        ge=0.0,
        le=1.0,
    )
    strips: int = Field(
        16,
        ge=1,
        le=64,
        description="strips across the belt in each of which the flux is uniform; 1 makes the"
        " flux uniform over the contact",
    )


class ThermalParameters(Block):
    """Everything that the thermal model needs; each block has defaults."""

    ambient: Ambient = Ambient()
    belt: Belt = Belt()
    ice: Ice = Ice()
    contact: Contact = Contact()

    @model_validator(mode="after")
    def _belt_carries_contact(self) -> Self:
        diameter = 2.0 * self.contact.radius
        if self.belt.length <= diameter:
            raise ValueError(
                f"belt.length = {self.belt.length:g} m is shorter than the contact: it must"
                f" exceed 2 contact.radius = {diameter:g} m"
            )
        if self.belt.length / self.belt.cell_length > MOST_CELLS:
            raise ValueError(
                f"belt.cell_length = {self.belt.cell_length:g} m cuts the belt into more than"
                f" {MOST_CELLS} cells"
            )
        return self

    @model_validator(mode="after")
    def _contact_on_ice(self) -> Self:
        contact = self.contact
        if self.ice.mesh and contact.length:
            raise ValueError(
                f"contact.length = {contact.length:g} m and ice.mesh are both given: the mesh's"
                " base is the contact, leave contact.length out"
            )
        area = contact.length * min(self.belt.width, 2.0 * contact.radius)
        face = math.pi * contact.radius**2
        if area > face * (1.0 + 1e-9):
            raise ValueError(
                f"contact.length = {contact.length:g} m makes a contact of {area:g} m2, more than"
                f" the ice's face of {face:g} m2: take a larger contact.radius"
            )
        return self

    @model_validator(mode="after")
    def _air_is_laminar(self) -> Self:
        try:
            _ = self.belt.film
        except NotLaminar as error:
            raise ValueError(f"belt.still_air_speed: {error}") from None
        return self

    @model_validator(mode="after")
    def _layers_or_one(self) -> Self:
        belt = self.belt
        given = [
            key
            for key in Layer.model_fields
            if getattr(belt, key) != Belt.model_fields[key].default
        ]
        if belt.layers and given:
            raise ValueError(
                f"belt.{given[0]} = {getattr(belt, given[0]):g} and belt.layers are both given:"
                " the layers say it all, leave one of the two out"
            )
        return self

    @model_validator(mode="after")
    def _supports_fit(self) -> Self:
        belt = self.belt
        one = belt.railing_length + (belt.roller_arc if belt.rollers else 0.0)
        room = belt.length / max(1, belt.rollers)
        if one > room:
            raise ValueError(
                f"belt.length = {belt.length:g} m is too short for a railing of"
                f" {belt.railing_length:g} m and {belt.rollers} rollers that touch"
                f" {belt.roller_arc:g} m each"
            )
        return self

    @model_validator(mode="after")
    def _railing_to_rub_on(self) -> Self:
        belt = self.belt
        if belt.railing_friction > 0.0 and belt.railing_length == 0.0:
            raise ValueError(
                f"belt.railing_friction = {belt.railing_friction:g} and belt.railing_length = 0:"
                " there is no railing to rub on; allowed is a length above 0"
            )
        return self

    @classmethod
    def checked(cls, blocks: Mapping[str, Any]) -> Self:
        """Parameters from a mapping of blocks, as a TOML file holds them.

        ParameterError, one line for the first fault, instead of pydantic's report.
        """
        try:
            return cls.model_validate(blocks)
        except ValidationError as report:
            raise ParameterError(_one_line(report.errors()[0])) from None


_BLOCKS = {"ambient": Ambient, "belt": Belt, "ice": Ice, "contact": Contact}


def _fields_of(owner: tuple) -> Mapping[str, Any]:
    """Names that are allowed in a block, in one of its layers, or at the top."""
    if not owner:
        return _BLOCKS
    return (Layer if isinstance(owner[-1], int) else _BLOCKS[owner[0]]).model_fields


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
