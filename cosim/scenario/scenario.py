"""A scenario: everything that a run needs, as one TOML file holds it.

The tables of a file are the blocks of the mechanical parameters (`stickslip.Parameters`), those
of the thermal ones (`thermal.ThermalParameters`), `[run]` and `[coupling]`; every key has a
default. What both models know has one key: the contact's radius is `rig.contact_radius`, and the
turn of a slab follows from `rig.slab_radius`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from importlib import resources
from pathlib import Path
from typing import Any, Literal, Self

import tomli_w
from pydantic import Field, PrivateAttr, create_model, model_validator
from stickslip import Parameters
from stickslip.packing import GRAVITY
from stickslip.quantity import Table, quantity

from cosim.names import nearest
from cosim.scenario.faults import ScenarioError, checked
from cosim.scenario.method import Method
from cosim.scenario.toml_file import parsed, text_of
from thermal import Ambient, Belt, Contact, Ice, ParameterError, ThermalParameters

SUFFIX = ".toml"
#: More output times or macro steps than this are a slip of the unit, and would fill the memory.
MOST_STEPS = 10_000_000
#: Two intervals that differ by less than this part of themselves are the same: 0.3 / 0.1.
ROUNDING = 1e-9
#: An hour of computing, s: longer is meant seldom, and then said.
PATIENCE = 3600.0
#: What the contact has of the block.
FROM_BLOCK = ("radius", "load")
_HEAT_OF_CONTACT: dict[str, Any] = {
    key: (field.annotation, field)
    for key, field in Contact.model_fields.items()
    if key not in FROM_BLOCK
}
ContactHeat = create_model(
    "ContactHeat",
    __base__=Table,
    __doc__="Contact conductance, and how finely the contact's heat flux is resolved.",
    **_HEAT_OF_CONTACT,
)


class Run(Table):
    """How long a run is and how often it is looked at."""

    duration: float = quantity(30.0, "s", "length of the run", gt=0)
    output_interval: float = quantity(0.01, "s", "time between two rows of the results", gt=0)
    snapshot_interval: float = quantity(
        1.0, "s", "time between two pictures of the temperature fields", gt=0
    )
    checkpoint_seconds: float = quantity(
        30.0,
        "s",
        "wall time between two checkpoints of a coupled run, from which --resume goes on; 0: none",
        ge=0,
    )
    checkpoint_steps: int = quantity(
        0, "1", "the same in macro steps, whichever is first; 0: by wall time alone", ge=0
    )
    patience: float = quantity(
        PATIENCE,
        "s",
        "longest that computing the run may take, as it is estimated before the run starts; what "
        "would take longer is refused",
        gt=0,
    )


class Coupling(Method):
    """How the coupled models talk to each other."""

    step_control: Literal["fixed", "doubling", "defect"] = Field(
        "fixed", description="steps of one length, or as long as their error allows"
    )
    macro_step: float = quantity(
        0.01, "s", "time between two exchanges; of a step control, the first step", gt=0
    )


class Scenario(Parameters):
    """Mechanical and thermal parameters, the run and the coupling, checked together.

    Construct it from blocks, or from a file by `read_scenario`; `changed` gives a variant.
    Raises pydantic's ValidationError from the constructor, ScenarioError from everything else.
    """

    name: str = Field(
        "unnamed",
        description="name of the case, and of the folder of its results",
        min_length=1,
        max_length=100,
        # what every file system takes as the name of a folder
        pattern=r'^[^\s./\\:*?"<>|\x00-\x1f][^/\\:*?"<>|\x00-\x1f]*$',
    )
    ambient: Ambient = Ambient()
    belt: Belt = Belt()
    ice: Ice = Ice()
    contact: ContactHeat = ContactHeat()
    run: Run = Run()
    coupling: Coupling = Coupling()

    _thermal: ThermalParameters = PrivateAttr()

    @model_validator(mode="after")
    def _join_with_heat(self) -> Self:
        if self.rig.surface == "slab":
            self._take_length_from_slab()
        if fault := self._too_fine("run.output_interval", self.run.output_interval):
            raise ValueError(fault)
        contact = {"radius": self.rig.contact_radius, "load": GRAVITY * self.rig.mass}
        contact |= self.contact.model_dump()
        try:
            self._thermal = ThermalParameters.checked(
                {
                    "ambient": self.ambient,
                    "belt": self._belt_under_block(),
                    "ice": self.ice,
                    "contact": contact,
                }
            )
        except ParameterError as error:
            raise ValueError(str(error).replace("contact.radius", "rig.contact_radius")) from None
        return self

    def _belt_under_block(self) -> Belt:
        """The belt as the thermal model sees it: a railing carries the block's weight."""
        if self.belt.railing_friction == 0.0 or self.belt.railing_load > 0.0:
            return self.belt
        return self.belt.model_copy(update={"railing_load": self.rig.mass * GRAVITY})

    def _take_length_from_slab(self) -> None:
        """What the contact travels on a slab before it comes round: one turn."""
        turn = 2.0 * math.pi * abs(self.rig.slab_radius)
        if "length" in self.belt.model_fields_set:
            raise ValueError(
                f"belt.length = {self.belt.length:g} m cannot be given for a slab: one turn is "
                f"2 pi rig.slab_radius = {turn:g} m; leave it out"
            )
        given = {key: getattr(self.belt, key) for key in self.belt.model_fields_set}
        # not model_copy: the length stays "not given", and is not written back
        belt = self.belt.model_construct(**given)
        belt.__dict__["length"] = turn
        self.__dict__["belt"] = belt

    @property
    def mechanics(self) -> Parameters:
        """The mechanical model's part."""
        blocks = {name: getattr(self, name) for name in Parameters.model_fields}
        return Parameters.model_construct(**blocks)

    @property
    def thermal(self) -> ThermalParameters:
        """The thermal model's part."""
        return self._thermal

    def _too_fine(self, key: str, interval: float) -> str:
        """What is wrong with an interval (s) that cuts the run into too many steps, or nothing."""
        if self.run.duration / interval <= MOST_STEPS:
            return ""
        return (
            f"{key}: {interval:g} s cuts run.duration = {self.run.duration:g} s into more than "
            f"{MOST_STEPS} steps, allowed is at least {self.run.duration / MOST_STEPS:g} s"
        )

    @property
    def record_every(self) -> int:
        """Macro steps from one row of the results to the next.

        An interval that was not given gives way to the macro step where the two do not fit; for one
        that was, and for more macro steps than can be made, ScenarioError: the mechanics alone has
        no use for them.
        """
        if fault := self._too_fine("coupling.macro_step", self.coupling.macro_step):
            raise ScenarioError(fault)
        if self.coupling.step_control != "fixed":
            return 1
        ratio = self.run.output_interval / self.coupling.macro_step
        if round(ratio) < 1 or abs(ratio - round(ratio)) > ROUNDING * ratio:
            if "output_interval" not in self.run.model_fields_set:
                return 1
            raise ScenarioError(
                f"run.output_interval: {self.run.output_interval:g} s does not fall on the macro "
                "steps of a coupled run, allowed is a whole multiple of coupling.macro_step = "
                f"{self.coupling.macro_step:g} s"
            )
        return round(ratio)

    def changed(self, changes: Mapping[str, Any]) -> Self:
        """A variant, `block.key` -> value; ScenarioError in one line when it cannot be.

        >>> Scenario().changed({"rig.mass": 1.2, "run.duration": 5.0}).rig.mass
        1.2
        """
        tables = self.to_tables()
        for key, value in changes.items():
            block, _, entry = key.rpartition(".")
            (tables.setdefault(block, {}) if block else tables)[entry] = value
        return type(self).from_tables(tables)

    @classmethod
    def from_tables(cls, tables: Mapping[str, Any]) -> Self:
        """A scenario from the tables of a TOML file; ScenarioError in one line."""
        return checked(cls, tables)

    def to_tables(self) -> dict[str, Any]:
        """All keys that a file can hold, with their values, less those that follow from others."""
        follows = {}
        if self.rig.surface == "slab":
            follows["belt"] = {"length"}
        if "output_interval" not in self.run.model_fields_set:
            follows["run"] = {"output_interval"}
        tables = self.model_dump(exclude=follows)
        return {"name": tables.pop("name")} | tables

    def to_toml(self) -> str:
        """The text of a file that `read_scenario` reads as this scenario."""
        return tomli_w.dumps(self.to_tables())


def packaged_scenarios() -> list[str]:
    """Names of the scenarios that ship with the package."""
    files = (resources.files("cosim.scenario") / "packaged").iterdir()
    return sorted(file.name.removesuffix(SUFFIX) for file in files if file.name.endswith(SUFFIX))


def read_scenario(source: str | Path = "reference") -> Scenario:
    """The scenario in a TOML file, or a packaged one by its name.

    Raises ScenarioError, in one line: file, key, what is wrong, what is allowed. A case without
    a name takes that of its file.

    >>> read_scenario("reference").springs.stiffness
    20.17
    """
    tables = parsed(_read_text(source), source)
    _find_files(tables, Path(source).parent)
    if "name" not in tables:
        tables["name"] = Path(source).name.removesuffix(SUFFIX)
    try:
        return Scenario.from_tables(tables)
    except ScenarioError as fault:
        raise ScenarioError(f"{source}: {fault}") from None


#: Keys that name a file.
FILE_KEYS = (("ice", "mesh"), ("friction", "table"))


def _find_files(tables: dict[str, Any], folder: Path) -> None:
    """A file is named from where the scenario is, and found from everywhere."""
    for table, key in FILE_KEYS:
        entries = tables.get(table)
        if isinstance(entries, dict) and isinstance(entries.get(key), str) and entries[key]:
            entries[key] = str((folder / entries[key]).resolve())


def _read_text(source: str | Path) -> str:
    if str(source) in packaged_scenarios() and not Path(source).is_file():
        file = resources.files("cosim.scenario") / "packaged" / f"{source}{SUFFIX}"
        return file.read_text(encoding="utf-8")
    if not Path(source).exists():
        known = packaged_scenarios()
        near = nearest(str(source), known)
        hint = f"did you mean {near}?" if near else f"packaged: {', '.join(known)}"
        raise ScenarioError(
            f"{source}: no such file, allowed is a TOML file or a packaged scenario ({hint})"
        )
    return text_of(source)
