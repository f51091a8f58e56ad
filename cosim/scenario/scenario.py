"""A scenario: everything that a run needs, as one TOML file holds it.

The tables of a file are the blocks of the mechanical parameters (`stickslip.Parameters`), those
of the thermal ones (`thermal.ThermalParameters`), `[run]` and `[coupling]`. What both models know
has one key: the contact's radius is `rig.contact_radius`, and the turn of a slab follows from
`rig.slab_radius`. Every key has a default: in Python that of the plain model, in which every effect
is off; what a file leaves out is as of a rig (`cosim.scenario.defaults`), unless the file says
`defaults = "plain"`.
"""

import logging
import math
import os
from collections.abc import Mapping
from functools import cached_property
from html import escape
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Self

import tomli_w
from pydantic import Field, PrivateAttr, create_model, field_validator, model_validator
from stickslip import Parameters
from stickslip.catalogue import default_catalogue
from stickslip.effects import PluginError
from stickslip.packing import GRAVITY
from stickslip.quantity import Table, quantity

from cosim.names import nearest
from cosim.scenario import defaults as defaults_of_files
from cosim.scenario.method import Method
from cosim.scenario.toml_file import changed_tables, changes_named, is_of_change, parsed, text_of
from cosim.scenario.validation import ScenarioError, checked, known_keys, spaced, unit_of
from thermal import Ambient, Belt, Contact, Ice, ParameterError, ThermalParameters
from thermal.materials import ICE, MATERIALS

LOG = logging.getLogger(__name__)

SUFFIX = ".toml"
#: More output times or macro steps than this are a slip of the unit, and would fill the memory.
MOST_STEPS = 10_000_000
#: Two intervals that differ by less than this part of themselves are the same: 0.3 / 0.1.
ROUNDING = 1e-9
#: Most lines of what a scenario shows of itself where it is looked at, beside its name.
MOST_LINES = 18
#: An hour of computing, s: longer is meant seldom, and then said.
PATIENCE = 3600.0
#: What a material is, and no shape.
OF_MATERIAL = {"material", "density", "heat_capacity", "conductivity", "latent_heat"}
#: What the contact has of the block.
FROM_BLOCK = ("radius", "load")
_HEAT_OF_CONTACT: dict[str, Any] = {
    key: (field.annotation, field)
    for key, field in Contact.model_fields.items()
    if key not in FROM_BLOCK
}
if TYPE_CHECKING:
    ContactHeat = Contact
else:
    ContactHeat = create_model(
        "ContactHeat",
        __base__=Table,
        __doc__="Contact conductance, and how finely the contact's heat flux is resolved.",
        **_HEAT_OF_CONTACT,
    )


class Run(Table):
    """How long a run is and how often it is looked at.

    duration : length of the run
    output_interval : time between two rows of the results
    snapshot_interval : time between two pictures of the temperature fields
    checkpoint_seconds : wall time between two checkpoints of a coupled run, from which --resume
        goes on; 0: none
    checkpoint_steps : the same in macro steps, whichever is first; 0: by wall time alone
    patience : longest that computing the run may take, as it is estimated before the run starts;
        what would take longer is refused
    """

    duration: float = quantity(30.0, "s", gt=0)
    output_interval: float = quantity(0.01, "s", gt=0)
    snapshot_interval: float = quantity(1.0, "s", gt=0)
    checkpoint_seconds: float = quantity(30.0, "s", ge=0)
    checkpoint_steps: int = quantity(0, "1", ge=0)
    patience: float = quantity(PATIENCE, "s", gt=0)


class Coupling(Method):
    """How the coupled models talk to each other."""

    step_control: Literal["fixed", "doubling", "defect"] = Field(
        "fixed", description="steps of one length, or as long as their error allows"
    )
    macro_step: float = quantity(
        0.01, "s", "time between two exchanges; of a step control, the first step", gt=0
    )
    isolate: bool = Field(
        False, description="the mechanical unit in a process of its own, which may crash or hang"
    )
    time_limit: float = quantity(60.0, "s", "of a call of the isolated unit", gt=0)


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
    effects: tuple[str, ...] = Field(
        (), description="files of custom effects, beside the scenario's file: their code is run"
    )
    defaults: Literal["rig", "plain"] = Field(
        "plain",
        description="of a file: where it takes what it leaves out from, a rig as it can be built "
        "(the default of a file), or the plain model, in which every effect is off",
    )
    ambient: Ambient = Ambient()
    belt: Belt = Belt()
    ice: Ice = Ice()
    block: Ice = Field(
        Ice(), description="the block of any material, in place of [ice], which is one of ice"
    )
    contact: ContactHeat = ContactHeat()
    run: Run = Run()
    coupling: Coupling = Coupling()

    _thermal: ThermalParameters = PrivateAttr()

    @field_validator("effects")
    @classmethod
    def _check_effects(cls, files: tuple[str, ...]) -> tuple[str, ...]:
        if not {Path(file).resolve() for file in files} <= {*cls.catalogue.files}:
            raise ValueError(
                f"effects = {list(files)}: of a scenario in Python allowed is "
                f"Scenario.with_effects({', '.join(map(repr, files))})(...)"
            )
        return files

    @cached_property
    def taken(self) -> Mapping[str, Any]:
        """`table.key` -> value of what the file left to the defaults and is not plain.

        It says where values came from: scenarios that differ in nothing else are equal.
        """
        return {}

    def with_taken(self, taken: Mapping[str, Any]) -> Self:
        """The same scenario, of which so much is known to come from the defaults."""
        copy = self.model_copy()
        copy.__dict__["taken"] = dict(taken)
        return copy

    @model_validator(mode="after")
    def _join_with_heat(self) -> Self:
        self._take_block()
        if self.rig.surface == "slab":
            self._take_length_from_slab()
        if fault := self._too_fine("run.output_interval", self.run.output_interval):
            raise ValueError(fault)
        contact = {"radius": self.rig.contact_radius, "load": GRAVITY * self.rig.mass}
        contact |= self.contact.model_dump()
        try:
            thermal = ThermalParameters.checked(
                {
                    "ambient": self.ambient,
                    "belt": self._belt_under_block(),
                    "ice": self.ice,
                    "contact": contact,
                }
            )
        except ParameterError as error:
            raise ValueError(self._in_keys_of_block(str(error))) from None
        run, ramp = self.run.duration, min(self.surface.run_up_time, self.run.duration)
        force = self.friction.mu_k * self.rig.mass * GRAVITY
        self._thermal = thermal.in_still_air(force, abs(self.surface.speed), run - 0.5 * ramp)
        return self

    def _in_keys_of_block(self, fault: str) -> str:
        """A fault of the contact in the keys that it was made from."""
        fault = fault.replace("contact.radius", "rig.contact_radius")
        return fault.replace("ice.", "block.") if "block" in self.model_fields_set else fault

    def _belt_under_block(self) -> Belt:
        """The belt as the thermal model sees it: a railing carries the block's weight."""
        if self.belt.railing_friction == 0.0 or self.belt.railing_load > 0.0:
            return self.belt
        return self.belt.model_copy(update={"railing_load": self.rig.mass * GRAVITY})

    def _take_block(self) -> None:
        """Makes [ice] and [block] one table, whose shape either may give."""
        block, ice = self.block, self.ice
        if not block.model_fields_set:
            self.__dict__["block"] = ice
            return
        if twice := sorted(ice.model_fields_set & (block.model_fields_set | OF_MATERIAL)):
            raise ValueError(
                f"ice.{twice[0]} and the table [block] are both given: [ice] is a [block] of ice,"
                " leave one of the two out"
            )
        if "material" not in block.model_fields_set:
            raise ValueError(
                f"block.material is missing, needed is {', '.join((ICE, *MATERIALS))}, or a name of"
                " your own with density, heat_capacity and conductivity"
            )
        whole = Ice(**ice.model_dump(exclude_unset=True), **block.model_dump(exclude_unset=True))
        self.__dict__.update(ice=whole, block=whole)
        self.model_fields_set.discard("ice")

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
        kind = Parameters.of(self.catalogue)
        return kind.model_construct(**{name: getattr(self, name) for name in kind.model_fields})

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

    def changed(self, changes: Mapping[str, Any] | None = None, /, **named: Any) -> Self:
        """A variant, `block.key` -> value, or as keywords; ScenarioError in one line when it cannot
        be.

        A keyword is `block_key`, or a block with a mapping of its keys:

        >>> scenario = Scenario()
        >>> scenario.changed({"rig.mass": 1.2, "run.duration": 5.0}).rig.mass
        1.2
        >>> scenario.changed(rig_mass=1.2, surface={"speed": 0.2}).surface.speed
        0.2
        >>> scenario.changed(surface_sped=0.2)
        Traceback (most recent call last):
        cosim.scenario.validation.ScenarioError: surface.sped: no such key, nearest known: ...
        """
        changes = dict(changes or {}) | changes_named(named, type(self).model_fields)
        # what was not said stays so: some studies ask which numbers are known
        said = {"name": self.name} | self.model_dump(exclude_unset=True)
        variant = self.from_tables(changed_tables(said, changes))
        return variant.with_taken(
            {key: value for key, value in self.taken.items() if key not in changes}
        )

    @classmethod
    def from_tables(cls, tables: Mapping[str, Any]) -> Self:
        """A scenario from the tables of a TOML file; ScenarioError in one line.

        The files of effects that it names are executed, unless this class has them already.
        """
        return checked(cls._with_named(tables.get("effects")), tables)

    @classmethod
    def _with_named(cls, files: Any) -> type[Self]:
        """The class that has what a file's key `effects` names, too."""
        is_list = isinstance(files, (list, tuple)) and all(isinstance(each, str) for each in files)
        named = files if is_list else ()
        lacking = [each for each in named if Path(each).resolve() not in cls.catalogue.files]
        try:
            return cls.with_effects(*lacking) if lacking else cls
        except PluginError as error:
            raise ScenarioError(f"effects: {error}") from error

    def to_tables(self) -> dict[str, Any]:
        """All keys that a file can hold, with their values, less those that follow from others."""
        follows: dict[str, Any] = {}
        if self.rig.surface == "slab":
            follows["belt"] = {"length"}
        if "output_interval" not in self.run.model_fields_set:
            follows["run"] = {"output_interval"}
        follows["ice" if "block" in self.model_fields_set else "block"] = True
        tables = self.model_dump(exclude=follows)
        if not self.effects:
            del tables["effects"]
        return {"name": tables.pop("name")} | tables

    def __repr__(self) -> str:
        """What differs from the plain model, in at most 20 lines."""
        lines = [f"{key} = {value}" for key, value, _ in self._differing()]
        more = len(lines) - MOST_LINES
        if more > 0:
            lines[MOST_LINES:] = [f"and {more} more, see to_toml()"]
        return "\n  ".join([f"<Scenario {self.name}", *lines]) + ">"

    __str__ = __repr__

    def _repr_html_(self) -> str:
        """The same as a table, for a notebook."""
        rows = "".join(
            f"<tr><th>{escape(key)}</th><td>{escape(value)}</td><td>{escape(said)}</td></tr>"
            for key, value, said in self._differing()
        )
        return f"<p><strong>Scenario {escape(self.name)}</strong></p><table>{rows}</table>"

    def _differing(self) -> list[tuple[str, str, str]]:
        """Key, value with unit, and description of what is not as in the plain model."""
        found = []
        for key, field in known_keys(type(self)).items():
            table, _, entry = key.partition(".")
            if not entry or (table == "block" and "block" not in self.model_fields_set):
                continue
            value = getattr(getattr(self, table), entry)
            if value != field.get_default(call_default_factory=True):
                found.append((key, f"{value}{spaced(unit_of(field))}", field.description))
        return [(key, value, said or "") for key, value, said in found]

    def to_toml(self) -> str:
        """The text of a file that `read_scenario` reads as this scenario."""
        return tomli_w.dumps(self.to_tables())


def scenario_type() -> type[Scenario]:
    """What a file is read as: with the effects that every scenario has. PluginError."""
    return Scenario.of(default_catalogue())


def packaged_scenarios() -> list[str]:
    """Names of the scenarios that ship with the package."""
    files = (resources.files("cosim.scenario") / "packaged").iterdir()
    return sorted(file.name.removesuffix(SUFFIX) for file in files if file.name.endswith(SUFFIX))


def read_scenario(
    source: str | Path = "reference", changes: Mapping[str, Any] | None = None
) -> Scenario:
    """The scenario in a TOML file, or a packaged one by its name.

    What the file leaves out is as of a rig, and named in `Scenario.taken`, unless the file says
    `defaults = "plain"`. ``changes``: `table.key` -> value, in place of what the file has, before
    the defaults come. Raises ScenarioError, in one line: file, key, what is wrong, what is allowed.
    A case without a name takes that of its file.

    >>> read_scenario("reference").springs.stiffness
    20.17
    >>> read_scenario("reference", {"springs.stiffness": 38.5}).springs.stiffness
    38.5
    """
    LOG.info("reading %s", source)
    return scenario_of(parsed(source_text(source), source), source, changes)


def as_scenario(scenario: Scenario | str | Path) -> Scenario:
    """A scenario as it is, or else `read_scenario` of it."""
    return scenario if isinstance(scenario, Scenario) else read_scenario(scenario)


def scenario_of(
    tables: dict[str, Any], source: str | Path, changes: Mapping[str, Any] | None = None
) -> Scenario:
    """As `read_scenario`, from the tables of a file that is, or will be, at ``source``."""
    changes = {
        key: _found(value, Path()) if key in FILE_KEYS else value
        for key, value in (changes or {}).items()
    }
    _find_files(tables, Path(source).parent)
    full, taken = defaults_of_files.filled(changed_tables(tables, changes))
    full.setdefault("name", Path(source).name.removesuffix(SUFFIX))
    try:
        return scenario_type().from_tables(full).with_taken(taken)
    except ScenarioError as fault:
        where = f"{source} with changes" if is_of_change(str(fault), changes) else source
        raise ScenarioError(f"{where}: {fault}") from None


#: Keys that name a file.
FILE_KEYS = ("ice.mesh", "block.mesh", "friction.table")


def _find_files(tables: dict[str, Any], folder: Path) -> None:
    """A file is named from where the scenario is, and found from everywhere."""
    effects = tables.get("effects")
    if isinstance(effects, list) and all(isinstance(name, str) for name in effects):
        tables["effects"] = [str((folder / name).resolve()) for name in effects]
    for key in FILE_KEYS:
        table, _, entry = key.partition(".")
        entries = tables.get(table)
        if isinstance(entries, dict) and entry in entries:
            entries[entry] = _found(entries[entry], folder)


def _found(name: Any, folder: Path) -> Any:
    return str((folder / name).resolve()) if isinstance(name, str) and name else name


def source_text(source: str | Path) -> str:
    """The text of a file, or of a packaged scenario by its name; ScenarioError for none."""
    if str(source) in packaged_scenarios() and not os.path.isfile(source):
        file = resources.files("cosim.scenario") / "packaged" / f"{source}{SUFFIX}"
        return file.read_text(encoding="utf-8")
    if not os.path.exists(source):
        known = packaged_scenarios()
        beside = f"{source}{SUFFIX}"
        near = beside if os.path.isfile(beside) else nearest(str(source), known)
        hint = f"did you mean {near}?" if near else f"packaged: {', '.join(known)}"
        raise ScenarioError(
            f"{source}: no such file, allowed is a TOML file or a packaged scenario ({hint})"
        )
    return text_of(source)
