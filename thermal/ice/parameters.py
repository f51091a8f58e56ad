"""What the block is, of ice or of another material: its shape and its properties."""

import math
from typing import Any, Self

from pydantic import Field, model_validator
from stickslip.quantity import Table, quantity

from thermal.materials import ICE, MATERIALS, MELTING_POINT_DEGC, ZERO_DEGC

#: What a material is told by.
_PROPERTIES = ("density", "heat_capacity", "conductivity")


class Ice(Table, strict=False):
    """A standing cylinder on the belt, of ice unless given otherwise; its radius is the contact's.

    A material of `thermal.materials` brings its density, heat capacity and conductivity where they
    are not given; one with another name must have all three. Ice alone melts.

    The sample of the test rig: diameter 8 cm, height 10 cm. Properties of ice Ih near -8 degC,
    constant: between -16 and 0 degC conductivity falls by 9 % while capacity grows by 6 %, so the
    face's rise under a given flux is 1.0 % low for rises below 1 K from -8 degC (0.2 % from -16),
    and 1.8 % low for one up to melting. With `Ice.at` the temperature that the face comes to it
    errs by 0.1 %. 10 W/m2K on side and top: natural convection and radiation, about 5 each.

    mesh : file with the sample's shape as tetrahedra in metres, standing on z = 0 with the belt
        along x (.msh, .vtk, .vtu, ...); in place of height, elements and the contact's radius and
        length
    height : height
    density : density
    heat_capacity : specific heat capacity
    conductivity : thermal conductivity
    latent_heat : latent heat of melting
    air_heat_transfer : heat transfer to the air, on side and top
    radial_elements : P2 elements along the radius, finest at the side
    axial_elements : P2 elements along the height, finest at the contact
    """

    material: str = Field(
        ICE,
        min_length=1,
        max_length=40,
        pattern=r"^[^\s<>&][^<>&]*$",
        description="what it is of, which alone melts if it is ice: "
        f"{', '.join((ICE, *MATERIALS))}, or another name, and then density, heat_capacity and"
        " conductivity are to be given",
    )
    mesh: str = quantity("", None, max_length=1000)
    height: float = quantity(0.10, "m", gt=0.0, le=10.0)
    density: float = quantity(917.0, "kg/m3", gt=0.0, le=3e4)
    heat_capacity: float = quantity(2050.0, "J/(kg.K)", gt=0.0, le=1e5)
    conductivity: float = quantity(2.2, "W/(m.K)", gt=0.0, le=1e4)
    latent_heat: float = quantity(334e3, "J/kg", gt=0.0, le=1e7)
    air_heat_transfer: float = quantity(10.0, "W/(m2.K)", ge=0.0, le=1e4)
    radial_elements: int = quantity(6, None, ge=1, le=40)
    axial_elements: int = quantity(10, None, ge=1, le=40)

    @model_validator(mode="after")
    def _of_its_material(self) -> Self:
        if self.material == ICE:
            return self
        known = MATERIALS.get(self.material)
        for key in _PROPERTIES:
            if key in self.model_fields_set:
                continue
            if known is None:
                raise ValueError(
                    f"material = {self.material!r} is not among {', '.join((ICE, *MATERIALS))},"
                    f" so {key} is to be given"
                )
            # not set: what was not given stays so, and follows another material
            self.__dict__[key] = getattr(known, key)
        return self

    @property
    def melting_point_degC(self) -> float:
        """Of ice 0 degC; nothing else melts here."""
        return MELTING_POINT_DEGC if self.material == ICE else math.inf

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
