"""What belt, ice, contact and ambient air are: checked numbers with units and sources."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

#: Highest temperature at which the block is still ice, degC.
MELTING_POINT_DEGC = 0.0

#: Most cells along the belt: a slip of the unit must not exhaust the memory.
MOST_CELLS = 200_000


def quantity(default: float, unit: str, description: str, **bounds: Any) -> Any:
    """A number with its unit (`1` for none) in the JSON schema and in its description."""
    return Field(default, description=f"{description} [{unit}]", json_schema_extra={"unit": unit},
                 **bounds)


class ParameterError(ValueError):
    """A parameter is unknown or out of bounds; one line: key, value, what is allowed."""


class Block(BaseModel):
    """A block of parameters: unknown keys, NaN and infinity are refused; nothing changes later."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, frozen=True)


class Ambient(Block):
    """The air of the cold room: also the temperature that belt and ice start from."""

    temperature_degC: float = quantity(
        -8.0, "degC", "air temperature; the first of the test rig's two, -8 and -16",
        ge=-100.0, lt=MELTING_POINT_DEGC)


class Belt(Block):
    """An endless belt, one homogeneous layer.

    Length, width and mass per length (0.0525 kg/m at 75 mm) are those of the sanding belt of
    the test rig; 840 J/kgK is the source study's figure. Conductivity of paper and cloth
    backed abrasive lies in 0.25 ... 2 W/mK and was not measured. 5 ... 25 W/m2K is still air
    to a light draught; the study's rate of 0.25 1/s would need 73.5 W/m2K.
    """

    length: float = quantity(1.0, "m", "length of the loop", gt=0.0, le=100.0)
    width: float = quantity(0.075, "m", "width", gt=0.0, le=10.0)
    thickness: float = quantity(1e-3, "m", "thickness", gt=0.0, le=0.1)
    density: float = quantity(700.0, "kg/m3", "density", gt=0.0, le=3e4)
    heat_capacity: float = quantity(840.0, "J/(kg.K)", "specific heat capacity", gt=0.0, le=1e5)
    conductivity: float = quantity(0.5, "W/(m.K)", "thermal conductivity", gt=0.0, le=1e4)
    air_heat_transfer: float = quantity(
        15.0, "W/(m2.K)", "heat transfer to the air, on each free face", ge=0.0, le=1e4)
    elements: int = Field(
        6, ge=1, le=40, description="P2 elements through the thickness, finest at the contact")
    cell_length: float = quantity(
        1e-3, "m", "length of a cell along the belt; rounded to fit the loop", gt=0.0, le=1.0)

    @property
    def cells(self) -> int:
        """Cells along the loop, at least eight."""
        return max(8, round(self.length / self.cell_length))


class Ice(Block):
    """A standing cylinder of ice on the belt; its radius is the contact's.

    The sample of the test rig: diameter 8 cm, height 10 cm. Properties of ice Ih near -8 degC.
    10 W/m2K on side and top: natural convection and radiation, about 5 each.
    """

    height: float = quantity(0.10, "m", "height", gt=0.0, le=10.0)
    density: float = quantity(917.0, "kg/m3", "density", gt=0.0, le=3e4)
    heat_capacity: float = quantity(2050.0, "J/(kg.K)", "specific heat capacity", gt=0.0, le=1e5)
    conductivity: float = quantity(2.2, "W/(m.K)", "thermal conductivity", gt=0.0, le=1e4)
    latent_heat: float = quantity(334e3, "J/kg", "latent heat of melting", gt=0.0, le=1e7)
    air_heat_transfer: float = quantity(
        10.0, "W/(m2.K)", "heat transfer to the air, on side and top", ge=0.0, le=1e4)
    radial_elements: int = Field(
        6, ge=1, le=40, description="P2 elements along the radius, finest at the side")
    axial_elements: int = Field(
        10, ge=1, le=40, description="P2 elements along the height, finest at the contact")


class Contact(Block):
    """Where ice and belt touch, and how well heat crosses.

    A conductance above 1e3 W/m2K changes the heat shares by less than 0.005.
    """

    radius: float = quantity(0.04, "m", "radius of the ice cylinder", gt=0.0, le=10.0)
    conductance: float = quantity(
        1e4, "W/(m2.K)", "contact conductance between the two faces", gt=0.0, le=1e12)
    strips: int = Field(
        16, ge=1, le=64,
        description="strips across the belt in each of which the flux is uniform; 1 makes the"
                    " flux uniform over the contact")


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
                f" exceed 2 contact.radius = {diameter:g} m")
        if self.belt.length / self.belt.cell_length > MOST_CELLS:
            raise ValueError(
                f"belt.cell_length = {self.belt.cell_length:g} m cuts the belt into more than"
                f" {MOST_CELLS} cells")
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


def _one_line(fault: Mapping[str, Any]) -> str:
    """Key, value and what is allowed, from an entry of pydantic's report."""
    key = ".".join(str(part) for part in fault["loc"])
    if fault["type"] == "extra_forbidden":
        owner, name = fault["loc"][:-1], str(fault["loc"][-1])
        known = list(_BLOCKS[owner[0]].model_fields if owner else _BLOCKS)
        near = get_close_matches(name, known, 1)
        hint = f"did you mean {near[0]}?" if near else f"known are {', '.join(known)}"
        return f"{key} is not a parameter: {hint}"
    message = fault["msg"].removeprefix("Value error, ")
    return f"{key} = {fault['input']!r}: {message}" if key else message
