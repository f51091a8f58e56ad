"""What a rig, its springs, a friction law and a surface are: named, bounded, with units.

Each block is a table of a scenario file and a group of FMU parameters (`block.parameter`); the
unit, the bounds and the description given here are the ones that both show.
"""

from __future__ import annotations

import math
import warnings
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from .packing import pack


def quantity(default: float, unit: str, description: str, **bounds: Any) -> Any:
    """A field with unit and description; ``bounds`` are pydantic's gt, ge, lt, le."""
    return Field(default, description=description, json_schema_extra={"unit": unit}, **bounds)


class Block(BaseModel):
    """A table of parameters: unknown keys, NaN and infinities are refused."""

    model_config = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False, strict=True)


class Rig(Block):
    """Block, spring geometry and guides."""

    mass: float = quantity(0.67, "kg", "mass of the block", gt=0)
    inertia: Literal["disc", "ring"] | Annotated[float, Field(gt=0)] = Field(
        "disc",
        description='moment of inertia about the vertical: "disc" (m a^2/2, a the contact radius), '
        '"ring" (m r^2, r the attachment radius) or a number',
        json_schema_extra={"unit": "kg.m2"},
    )
    contact_radius: float = quantity(0.04, "m", "radius of the contact disc", gt=0)
    attachment_radius: float = quantity(
        0.05, "m", "distance of the spring attachments from the block's centre", gt=0
    )
    attachment_angles_deg: tuple[float, float, float, float] = Field(
        (160.0, 20.0, 200.0, 340.0),
        description="direction of each attachment from the block's centre, degrees from x",
        json_schema_extra={"unit": "deg"},
        strict=False,  # TOML gives a list
    )
    spring_length: float = quantity(0.20, "m", "length of a spring as installed", gt=0)
    spring_natural_length: float = quantity(
        0.20, "m", "length of a spring without load; shorter than installed is pretension", gt=0
    )
    surface: Literal["belt", "slab"] = Field(
        "belt", description="belt: translation; slab: turning about a centre at slab_radius"
    )
    slab_radius: float = quantity(
        0.5, "m", "slab only: distance of its centre from the block, along +y (negative: -y)"
    )
    degrees_of_freedom: tuple[Literal["x", "y", "phi"], ...] = Field(
        ("x", "y", "phi"), description="motions that the rig allows", strict=False
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        longest = 2.0 * self.spring_length
        if self.spring_natural_length > longest:
            raise ValueError(
                f"spring_natural_length = {self.spring_natural_length:g} m is more than twice "
                f"spring_length = {self.spring_length:g} m: a spring pressed below half its "
                f"length lies coil on coil; allowed is at most {longest:g} m"
            )
        if "x" not in self.degrees_of_freedom:
            raise ValueError('degrees_of_freedom must contain "x"')
        if self.surface == "slab" and abs(self.slab_radius) <= self.contact_radius:
            raise ValueError(
                f"slab_radius = {self.slab_radius:g} m puts the slab's centre under the block; "
                f"allowed is a distance above contact_radius = {self.contact_radius:g} m"
            )
        return self


class Springs(Block):
    """The four equal springs."""

    stiffness: float = quantity(20.17, "N/m", "stiffness of one of the four springs", ge=0)


class Friction(Block):
    """Coulomb friction between block and surface."""

    mu_s: float = quantity(0.2815, "1", "static friction coefficient", ge=0)
    mu_k: float = quantity(0.2086, "1", "kinetic friction coefficient", ge=0)


class LateralFriction(Block):
    """Friction across the motion: lateral and spin components."""

    ratio: float = quantity(
        0.0,
        "1",
        "friction across the motion relative to that along x: 0 along x only, 1 along the local "
        "relative velocity",
        ge=0,
        le=1,
    )


class TurningSurface(Block):
    """A slab instead of a belt."""

    curvature: float = quantity(
        0.0, "1/m", "1/R of a surface that turns about (0, R); 0 is a belt", ge=-20, le=20
    )


class TemperatureDependence(Block):
    """Kinetic friction that falls as the interface warms, up to the melting point (0 degC)."""

    sensitivity: float = quantity(
        0.0, "1/K", "fraction of mu_k lost per kelvin above reference_degC; 0 is off", ge=0
    )
    reference_degC: float = quantity(
        -8.0, "degC", "interface temperature at which mu_k holds", ge=-273.15, le=0
    )


class Surface(Block):
    """Drive of the surface under the block."""

    speed: float = quantity(0.15, "m/s", "speed of the surface; negative runs backwards")
    run_up_time: float = quantity(
        0.0, "s", "time in which the speed grows linearly from standstill", ge=0
    )


class Initial(Block):
    """State of the block at the start, in the frame of the rig."""

    x: float = quantity(0.0, "m", "position along the motion of the surface")
    y: float = quantity(0.0, "m", "position across it")
    phi: float = quantity(0.0, "rad", "rotation, counter-clockwise")
    vx: float = quantity(0.0, "m/s", "velocity along x")
    vy: float = quantity(0.0, "m/s", "velocity along y")
    omega: float = quantity(0.0, "rad/s", "angular velocity")


class Solver(Block):
    """Internal integrator."""

    tolerance: float = quantity(
        1e-11, "1", "error of one internal step, relative to the motion's own scale",
        ge=1e-13, le=1e-3,
    )


class Parameters(Block):
    """Everything that the mechanical model needs, the drive included."""

    rig: Rig = Rig()
    springs: Springs = Springs()
    friction: Friction = Friction()
    lateral_friction: LateralFriction = LateralFriction()
    turning_surface: TurningSurface = TurningSurface()
    temperature_dependence: TemperatureDependence = TemperatureDependence()
    surface: Surface = Surface()
    initial: Initial = Initial()
    solver: Solver = Solver()

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.rig.surface == "slab" and self.turning_surface.curvature != 0.0:
            raise ValueError(
                'rig.surface = "slab" already sets turning_surface.curvature to 1/slab_radius; '
                "give one of the two"
            )
        if self.friction.mu_k > self.friction.mu_s:
            warnings.warn(
                f"friction.mu_k = {self.friction.mu_k:g} exceeds friction.mu_s = "
                f"{self.friction.mu_s:g}: the contact then holds up to mu_k",
                stacklevel=2,
            )
        if self.rig.spring_natural_length > self.rig.spring_length and self._can_swerve():
            warnings.warn(
                f"rig.spring_natural_length = {self.rig.spring_natural_length:g} m exceeds "
                f"rig.spring_length = {self.rig.spring_length:g} m: the springs push, and the "
                "rest position is unstable sideways",
                stacklevel=2,
            )
        return self

    def _can_swerve(self) -> bool:
        return len(self.rig.degrees_of_freedom) > 1

    def flat(self) -> dict[str, float]:
        """The FMU's parameters: ``block.parameter`` -> number (see `packing.pack`)."""
        values = {
            f"{block}.{name}": float(value)
            for block in Parameters.model_fields
            for name, value in getattr(self, block).model_dump().items()
            if isinstance(value, (int, float))
        }
        rig = self.rig
        del values["rig.slab_radius"], values["surface.speed"]
        values["rig.inertia"] = self._inertia()
        for i, angle in enumerate(rig.attachment_angles_deg):
            values[f"rig.attachment_angles_deg[{i + 1}]"] = angle
        values["rig.free_y"] = float("y" in rig.degrees_of_freedom)
        values["rig.free_phi"] = float("phi" in rig.degrees_of_freedom)
        if rig.surface == "slab":
            values["turning_surface.curvature"] = 1.0 / rig.slab_radius
        return values

    def _inertia(self) -> float:
        if self.rig.inertia == "disc":
            return 0.0  # the kernel's own rule: m a^2 / 2
        if self.rig.inertia == "ring":
            return self.rig.mass * self.rig.attachment_radius**2
        return self.rig.inertia

    def pack(self) -> list[float]:
        """The kernel's parameter vector ``p``."""
        return pack(self.flat())

    @property
    def natural_frequency(self) -> float:
        """Frequency of the free vibration along x, sqrt(4 k / m) / (2 pi), Hz."""
        return math.sqrt(4.0 * self.springs.stiffness / self.rig.mass) / (2.0 * math.pi)
