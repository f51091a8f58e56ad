"""What a rig, its springs, a friction law and a surface are: named, bounded, with units.

Each `Table` is a table of a scenario file and a group of FMU parameters (`table.parameter`); the
unit, the bounds and the description given here are the ones that both show.
"""

import math
import warnings
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self, TypeVar

from pydantic import Field, create_model, model_validator

from .catalogue import CATALOGUE, Catalogue
from .effects import EFFECTS
from .friction.parameters import Friction
from .kernel.layout import CURVE_LIMIT, TABLE_LIMIT, TEMPERATURE_LIMIT
from .quantity import Table, quantity

#: m/s; nothing that ice lies on moves as fast: a slip of the unit.
FASTEST_SURFACE = 1e3


#: deg, of a direction.
Angle = Annotated[float, Field(ge=-360, le=360)]


class Rig(Table):
    """Block, spring geometry and guides.

    mass : mass of the block
    inertia : moment of inertia about the vertical: "disc" (m a^2/2, a the contact radius), "ring"
        (m r^2, r the attachment radius) or a number
    contact_radius : radius of the contact disc
    attachment_radius : distance of the spring attachments from the block's centre
    attachment_angles_deg : direction of each attachment from the block's centre, degrees from x
    spring_length : length of a spring as installed
    spring_natural_length : length of a spring without load; shorter than installed is pretension
    surface : belt: translation; slab: turning about a centre at slab_radius
    slab_radius : slab only: distance of its centre from the block, along +y (negative: -y)
    degrees_of_freedom : motions that the rig allows
    """

    mass: float = quantity(0.67, "kg", gt=0)
    inertia: Literal["disc", "ring"] | Annotated[float, Field(gt=0)] = quantity("disc", "kg.m2")
    contact_radius: float = quantity(0.04, "m", gt=0)
    attachment_radius: float = quantity(0.05, "m", gt=0)
    attachment_angles_deg: tuple[Angle, Angle, Angle, Angle] = quantity(
        (160.0, 20.0, 200.0, 340.0),
        "deg",
        strict=False,  # TOML gives a list
    )
    spring_length: float = quantity(0.20, "m", gt=0)
    spring_natural_length: float = quantity(0.20, "m", gt=0)
    surface: Literal["belt", "slab"] = quantity("belt", None)
    slab_radius: float = quantity(0.5, "m")
    degrees_of_freedom: tuple[Literal["x", "y", "phi"], ...] = quantity(
        ("x", "y", "phi"), None, strict=False
    )

    @model_validator(mode="after")
    def _check(self) -> Self:
        if "x" not in self.degrees_of_freedom:
            raise ValueError('degrees_of_freedom must contain "x"')
        if self.surface == "slab" and abs(self.slab_radius) <= self.contact_radius:
            raise ValueError(
                f"slab_radius = {self.slab_radius:g} m puts the slab's centre under the block; "
                f"allowed is a distance above contact_radius = {self.contact_radius:g} m"
            )
        return self


class Springs(Table):
    """The four equal springs.

    stiffness : stiffness of one of the four springs
    force_curve_extension : extensions of a measured force-length curve of one spring, growing, at
        most 16; the curve replaces stiffness, which then only sets the time scale
    force_curve_force : forces of the curve, not falling; joined by a monotone cubic
    """

    stiffness: float = quantity(20.17, "N/m", ge=0)
    force_curve_extension: tuple[float, ...] = quantity(
        (), "m", strict=False, max_length=CURVE_LIMIT
    )
    force_curve_force: tuple[float, ...] = quantity((), "N", strict=False, max_length=CURVE_LIMIT)

    @property
    def mean_stiffness(self) -> float:
        """N/m: `stiffness`, or the mean slope of the force-length curve that replaces it."""
        extension, force = self.force_curve_extension, self.force_curve_force
        if not extension:
            return self.stiffness
        return (force[-1] - force[0]) / (extension[-1] - extension[0])

    @model_validator(mode="after")
    def _check(self) -> Self:
        extension, force = self.force_curve_extension, self.force_curve_force
        if len(extension) != len(force):
            raise ValueError(
                f"force_curve_extension has {len(extension)} values and force_curve_force has "
                f"{len(force)}: allowed is the same number"
            )
        if len(extension) == 1:
            raise ValueError("a force curve of one point: allowed are none or 2 to 16")
        if any(b <= a for a, b in pairwise(extension)):
            raise ValueError("force_curve_extension must grow from value to value")
        return self


class Surface(Table):
    """Drive of the surface under the block.

    speed : speed of the surface; negative runs backwards
    run_up_time : time in which the speed grows linearly from standstill
    """

    speed: float = quantity(0.15, "m/s", ge=-FASTEST_SURFACE, le=FASTEST_SURFACE)
    run_up_time: float = quantity(0.0, "s", ge=0)


class Initial(Table):
    """State of the block at the start, in the frame of the rig.

    x : position along the motion of the surface
    y : position across it
    phi : rotation, counter-clockwise
    vx : velocity along x
    vy : velocity along y
    omega : angular velocity
    """

    x: float = quantity(0.0, "m")
    y: float = quantity(0.0, "m")
    phi: float = quantity(0.0, "rad")
    vx: float = quantity(0.0, "m/s")
    vy: float = quantity(0.0, "m/s")
    omega: float = quantity(0.0, "rad/s")


class Imperfections(Table):
    """What a real rig departs by from its drawing: drawn at random, the same for the same seed.

    Each is the standard deviation of a normal distribution that is cut at three of them.

    seed : which rig it is: the same seed, the same departures
    mass : standard deviation of the block's mass, part of it
    spring_stiffness : standard deviation of the stiffness of each of the four springs, part of it
    anchor_position : standard deviation of the place, in x and in y, of each anchor
    start_position : standard deviation of x and of y at the start, on top of initial.x and
        initial.y
    start_angle_deg : standard deviation of the rotation at the start, on top of initial.phi
    """

    seed: int = quantity(1, "1", ge=0, le=2**31 - 1)
    mass: float = quantity(0.0, "1", ge=0, le=0.1)
    spring_stiffness: float = quantity(0.0, "1", ge=0, le=0.2)
    anchor_position: float = quantity(0.0, "m", ge=0, le=0.02)
    start_position: float = quantity(0.0, "m", ge=0, le=0.02)
    start_angle_deg: float = quantity(0.0, "deg", ge=0, le=10)


class Solver(Table):
    """Internal integrator.

    tolerance : error of one internal step, relative to the motion's own scale
    """

    tolerance: float = quantity(1e-11, "1", ge=1e-13, le=1e-3)


#: Parameters of several numbers, which the FMU has at their full length, and that length.
CURVES = {
    ("springs", "force_curve_extension"): CURVE_LIMIT,
    ("springs", "force_curve_force"): CURVE_LIMIT,
    ("friction", "table_speed"): CURVE_LIMIT,
    ("friction", "table_mu"): TABLE_LIMIT,
    ("friction", "table_temperature_degC"): TEMPERATURE_LIMIT,
}

if TYPE_CHECKING:

    class EffectTables(Table):
        """One table for each effect, all off."""

        def __getattr__(self, name: str) -> Any: ...

else:
    EffectTables = create_model(
        "EffectTables",
        __base__=Table,
        __doc__="One table for each effect, all off.",
        **{effect.id: (effect.table, effect.table()) for effect in EFFECTS},
    )


class Parameters(EffectTables):
    """Everything that the mechanical model needs, the drive included.

    Those of custom effects are of a class of their own, see `with_effects`.
    """

    catalogue: ClassVar[Catalogue] = CATALOGUE

    rig: Rig = Rig()
    springs: Springs = Springs()
    friction: Friction = Friction()
    surface: Surface = Surface()
    initial: Initial = Initial()
    imperfections: Imperfections = Imperfections()
    solver: Solver = Solver()

    @classmethod
    def with_effects(cls, *files: str | Path) -> type[Self]:
        """The same tables, and one for the effect of each file, which is executed.

        As in ``Parameters.with_effects("brush.py")(brush={"fall": 0.3})``. Raises PluginError in
        one line: file, line, what is wrong, what is allowed.
        """
        return cls.of(cls.catalogue.with_files(*files))

    @classmethod
    def of(cls, catalogue: Catalogue) -> type[Self]:
        """The same tables, with those of a catalogue's effects; one class for each catalogue."""
        # of a class that has custom effects already, the one that was written
        base = cls if cls.catalogue is CATALOGUE else cls.__mro__[1]
        return _made_of(base, catalogue)

    def __reduce__(self) -> tuple[Any, ...]:
        """As what the class is made of: where it is unpickled, there may be none yet."""
        return _blank, (type(self).of(CATALOGUE), self.catalogue), self.__getstate__()

    @model_validator(mode="after")
    def _check_together(self) -> Self:
        if self.rig.surface == "slab" and self.turning_surface.curvature != 0.0:
            raise ValueError(
                'rig.surface = "slab" already sets turning_surface.curvature to 1/slab_radius; '
                "give one of the two"
            )
        if self.friction.has_table:
            self._check_table_alone()
        refusal = self.catalogue.contradiction(self.flat())
        if refusal:
            raise ValueError(refusal)
        speed = abs(self.surface.speed)
        if 0.0 < speed <= self.friction.stick_creep:
            raise ValueError(
                f"friction.stick_creep = {self.friction.stick_creep:g} m/s is not below "
                f"surface.speed = {speed:g} m/s: the contact would creep as fast as the surface, "
                "and stick while it slides; allowed is less than the surface's speed"
            )
        said, at_rest = self.friction.at_rest
        if at_rest > self.friction.mu_s:
            warnings.warn(
                f"friction.{said} = {at_rest:g} exceeds friction.mu_s = "
                f"{self.friction.mu_s:g}: the contact then holds up to {said}",
                stacklevel=2,
            )
        can_swerve = len(self.rig.degrees_of_freedom) > 1
        if self.rig.spring_natural_length > self.rig.spring_length and can_swerve:
            warnings.warn(
                f"rig.spring_natural_length = {self.rig.spring_natural_length:g} m exceeds "
                f"rig.spring_length = {self.rig.spring_length:g} m: the springs push, and the "
                "rest position is unstable sideways",
                stacklevel=2,
            )
        return self

    def _check_table_alone(self) -> None:
        """One law of the sliding speed: the table's, or those of the effects, by its name."""
        for effect in self.catalogue.effects:
            if not any(term.__name__ == "dry_factor" for term in effect.terms):
                continue
            for name in effect.switch:
                value = getattr(getattr(self, effect.id), name)
                if value != 0.0:
                    raise ValueError(
                        f"friction.table_speed beside {effect.id}.{name} = {value:g}, another law "
                        "of the sliding speed; give one of the two"
                    )

    def flat(self) -> dict[str, float]:
        """The FMU's parameters: ``table.parameter`` -> number (see `packing.pack`)."""
        effects = [effect.id for effect in self.catalogue.effects]
        values = {
            f"{table}.{name}": float(value)
            for table in dict.fromkeys([*effects, *Parameters.model_fields])
            for name, value in getattr(self, table).model_dump().items()
            if isinstance(value, (int, float))
        }
        rig = self.rig
        del values["rig.slab_radius"], values["surface.speed"]
        values["rig.inertia"] = self._inertia()
        for i, angle in enumerate(rig.attachment_angles_deg):
            values[f"rig.attachment_angles_deg[{i + 1}]"] = angle
        values |= self._curve_values()
        values["rig.free_y"] = float("y" in rig.degrees_of_freedom)
        values["rig.free_phi"] = float("phi" in rig.degrees_of_freedom)
        if rig.surface == "slab":
            values["turning_surface.curvature"] = 1.0 / rig.slab_radius
        return values

    def _curve_values(self) -> dict[str, float]:
        """The curves at their full length: unused places repeat the last value, which ends them."""
        values: dict[str, float] = {}
        for (table, key), limit in CURVES.items():
            curve = getattr(getattr(self, table), key)
            rest = curve[-1] if curve else 0.0
            padded = [*curve, *[rest] * (limit - len(curve))]
            values |= {f"{table}.{key}[{i + 1}]": value for i, value in enumerate(padded)}
        return values

    def _inertia(self) -> float:
        if self.rig.inertia == "disc":
            return 0.0  # the kernel's own rule: m a^2 / 2
        if self.rig.inertia == "ring":
            return self.rig.mass * self.rig.attachment_radius**2
        return self.rig.inertia

    def with_values(self, table: str, **values: Any) -> Self:
        """The same, but for some values of a table, which are taken as checked."""
        changed = getattr(self, table).model_copy(update=values)
        return self.model_copy(update={table: changed})

    def pack(self) -> list[float]:
        """The kernel's parameter vector ``p``."""
        return self.catalogue.pack(self.flat())

    @property
    def natural_frequency(self) -> float:
        """Frequency of the free vibration along x, sqrt(4 k / m) / (2 pi), Hz.

        k is that of one spring, of a force-length curve its mean slope.
        """
        return math.sqrt(4.0 * self.springs.mean_stiffness / self.rig.mass) / (2.0 * math.pi)

    @property
    def critical_damping(self) -> float:
        """N s/m; with it, the block on its springs comes to rest without swinging."""
        return 4.0 * math.pi * self.natural_frequency * self.rig.mass


Kind = TypeVar("Kind", bound=Parameters)


@cache
def _made_of(base: type[Kind], catalogue: Catalogue) -> type[Kind]:
    if catalogue is CATALOGUE:
        return base
    tables: dict[str, Any] = {each.id: (each.table, each.table()) for each in catalogue.outside}
    made = create_model(
        base.__name__, __base__=base, __module__=base.__module__, __doc__=base.__doc__, **tables
    )
    made.catalogue = catalogue
    return made


def _blank(base: type[Kind], catalogue: Catalogue) -> Kind:
    """For unpickling."""
    kind = base.of(catalogue)
    return kind.__new__(kind)
