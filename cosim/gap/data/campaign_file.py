"""campaign.toml as checked tables: keys, units, bounds."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

import stickslip
from pydantic import AllowInfNan, BeforeValidator, Field, create_model, model_validator
from stickslip.catalogue import Catalogue, default_catalogue
from stickslip.effects import PluginError
from stickslip.parameters import FASTEST_SURFACE
from stickslip.quantity import Table, quantity

from cosim.gap.data.columns import to_si
from cosim.gap.data.errors import CampaignError, within
from cosim.names import nearest
from cosim.scenario.toml_file import parsed, text_of
from cosim.scenario.validation import ScenarioError, checked

if TYPE_CHECKING:
    Rig = stickslip.Rig  # for those who read its keys: they are the same
else:
    #: The rig as the experimenter knows it; each run has its own mass.
    _FIELDS = stickslip.Rig.model_fields.items()
    _KEYS = {key: (field.annotation, field) for key, field in _FIELDS if key != "mass"}
    _SAID = "Springs, attachments, contact and guides of the rig."
    Rig = create_model("Rig", __base__=Table, __doc__=_SAID, **_KEYS)


class Model(Table):
    """Where the workflow starts.

    scheme : exact geometry and events, or the source study's scheme as printed
    effects : files of effects of one's own, beside campaign.toml, which are tried like those of the
        catalogue: their code is run
    """

    scheme: Literal["exact", "study"] = quantity("exact", None)
    effects: tuple[str, ...] = quantity((), None)


#: Of a sample, in its unit: a thousandth of an atom, and still far above the rounding of the model.
LEAST_NOISE = 1e-12
#: Part of itself to which nobody knows a number, and a friction coefficient that nothing has.
LEAST_DEVIATION, MOST_FRICTION = 1e-6, 100.0
#: m/s: a millimetre in two weeks.
SLOWEST_SURFACE = 1e-9
#: Of a rig's parts, m.
LENGTHS = ("contact_radius", "attachment_radius", "spring_length", "spring_natural_length")
LONGEST, SHORTEST = 100.0, 1e-6


class Named(Table):
    """A table of which only what the file names counts."""

    @property
    def given(self) -> dict[str, Any]:
        """key -> value, of those that the file names."""
        return {key: getattr(self, key) for key in sorted(self.model_fields_set)}


class Noise(Named):
    """Standard deviation of one sample; what is not given is estimated."""

    x: float = quantity(math.inf, "m", "noise of x", ge=LEAST_NOISE, le=1.0)
    y: float = quantity(math.inf, "m", "noise of y", ge=LEAST_NOISE, le=1.0)
    phi: float = quantity(math.inf, "rad", "noise of phi", ge=LEAST_NOISE, le=10.0)
    force: float = quantity(math.inf, "N", "noise of the spring force", ge=LEAST_NOISE, le=1e6)


def _part(default: float, what: str) -> Any:
    return quantity(default, "1", f"{what}, part of it", ge=1e-6, le=0.2)


class Errors(Table):
    """How well the rig is known: standard deviations of what the file states.

    zero : of the tracker's zero in a run, in standard deviations of its noise; where it is not
        given, that of x and y is 0.5 mm
    """

    stiffness: float = _part(0.01, "of the springs' stiffness")
    surface_speed: float = _part(0.01, "of a run's surface speed about its set-point")
    zero: float = quantity(3.0, "1", ge=1e-3, le=1e3)
    friction: float = _part(0.02, "of friction from run to run, as expected beforehand")
    friction_table: float = _part(0.05, "of the level of friction.table")


class Limits(Named):
    """Where the rig can run: a next run is asked for within [low, high]."""

    surface_speed: tuple[float, ...] = quantity((), "m/s", "slowest and fastest")
    mass: tuple[float, ...] = quantity((), "kg", "of the block")
    stiffness: tuple[float, ...] = quantity((), "N/m", "of one of the four springs")

    @model_validator(mode="after")
    def _check(self) -> Self:
        for key, ends in self.given.items():
            if not (len(ends) == 2 and 0.0 < ends[0] <= ends[1]):
                raise ValueError(f"{key} = {list(ends)}, allowed is [low, high], 0 < low <= high")
        return self


class Measured(Named):
    """Numbers that are known with a standard deviation; others are not among ``given``."""

    @model_validator(mode="after")
    def _check(self) -> Self:
        for key, (value, deviation) in self.pairs.items():
            if not deviation > 0.0 or deviation < LEAST_DEVIATION * abs(value):
                raise ValueError(
                    f"{key} = [{value:g}, {deviation:g}], allowed is [value, standard deviation > "
                    f"0], {LEAST_DEVIATION:g} of the value at least"
                )
            self._check_value(key, value)
        return self

    @property
    def pairs(self) -> dict[str, tuple[float, float]]:
        """key -> (value, standard deviation), of all that the file names."""
        named = sorted(self.model_fields_set)
        return {key: pair for key in named if isinstance(pair := getattr(self, key), tuple)}

    def _check_value(self, key: str, value: float) -> None:
        """ValueError for a value that this quantity cannot have."""


def _measured(unit: str, description: str) -> Any:
    """A value with its standard deviation; one that is not known has an infinite one."""
    return quantity((0.0, math.inf), unit, description)


def _expected(value: Any) -> Any:
    """A number alone is expected, not known: its standard deviation is infinite."""
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return (float(value), math.inf) if is_number else value


Coefficient = Annotated[
    tuple[float, Annotated[float, AllowInfNan(True)]],
    BeforeValidator(_expected, json_schema_input_type=float | tuple[float, float]),
]


class Friction(Measured):
    """Coefficients that were measured by themselves: value and standard deviation.

    A number alone is what a plan expects; a fit does not know it.
    """

    mu_s: Coefficient = _measured("1", "static friction coefficient")
    mu_k: Coefficient = _measured("1", "kinetic friction coefficient")
    table: str = Field(
        "",
        description="CSV file beside campaign.toml with the columns v (m/s) and mu: kinetic "
        "friction over the sliding speed as it was measured by itself, from which the model sets "
        "out in place of mu_k; PCHIP, constant beyond its ends; errors.friction_table says how "
        "well its level is known",
    )

    @property
    def given(self) -> dict[str, tuple[float, float]]:
        """coefficient -> (value, standard deviation), of those that were measured."""
        return {key: pair for key, pair in self.pairs.items() if math.isfinite(pair[1])}

    @property
    def expected(self) -> dict[str, float]:
        """coefficient -> value, of those that the file names, measured or not."""
        return {key: pair[0] for key, pair in self.pairs.items()}

    def _check_value(self, key: str, value: float) -> None:
        if not 0.0 < value <= MOST_FRICTION:
            raise ValueError(f"{key} = {value:g}, allowed is above 0 and up to {MOST_FRICTION:g}")
        if key == "mu_k" and self.table:
            takes = f'table = "{self.table}", which takes its place'
            raise ValueError(f"mu_k = {value:g} beside {takes}; give one of the two")


class Summary(Measured):
    """Figures of a run whose time series is not at hand: value and standard deviation."""

    mean_x: tuple[float, float] = _measured("m", "mean of x")
    mean_y: tuple[float, float] = _measured("m", "mean of y")
    amplitude_x: tuple[float, float] = _measured("m", "half the range of x")
    frequency: tuple[float, float] = _measured("Hz", "oscillations of x per second")
    slip_share: tuple[float, float] = _measured("1", "share of the time in slip")
    slip_duration: tuple[float, float] = _measured("s", "mean length of a slip")
    stick_duration: tuple[float, float] = _measured("s", "mean length of a stick")
    break_away_x: tuple[float, float] = _measured("m", "mean of x at break-away")
    restick_x: tuple[float, float] = _measured("m", "mean of x at re-stick")
    max_rotation_deg: tuple[float, float] = _measured("deg", "largest rotation either way")

    def _check_value(self, key: str, value: float) -> None:
        if key == "slip_share" and not 0.0 <= value <= 1.0:
            raise ValueError(f"slip_share = {value:g} is not a share, allowed is 0 to 1")


def _column(what: str) -> Any:
    return Field("", description=f"column of {what}", min_length=1)


class ColumnNames(Named):
    """Names of the columns in a run's file, where they are not t, x, y, phi and force."""

    t: str = _column("the times")
    x: str = _column("the place along the surface's motion")
    y: str = _column("the place across")
    phi: str = _column("the rotation")
    force: str = _column("the springs' force along x")


class UnitNames(ColumnNames):
    """Units of the columns in a run's file, where they are not s, m, m, rad and N."""

    @model_validator(mode="after")
    def _check(self) -> Self:
        for channel, unit in self.given.items():
            try:
                to_si(channel, unit)
            except ValueError as fault:
                raise ValueError(f"{channel} = {fault}") from None
        return self


#: What every run states.
SETTINGS = ("mass", "stiffness", "surface_speed")


class RunTable(Table):
    """One [[run]].

    file : CSV file beside campaign.toml
    mass : mass of the block
    stiffness : stiffness of one of the four springs
    surface_speed : set-point of the surface's speed
    ambient_degC : temperature of the room
    hold_out : never used for fitting
    duration : of the record, while it is planned
    rate : samples a second, while it is planned
    """

    file: str = quantity("", None)
    mass: float = quantity(math.nan, "kg", gt=0)
    stiffness: float = quantity(math.nan, "N/m", gt=0)
    surface_speed: float = quantity(math.nan, "m/s", ge=-FASTEST_SURFACE, le=FASTEST_SURFACE)
    ambient_degC: float = quantity(-8.0, "degC", ge=-273.15, le=100)
    hold_out: bool = quantity(False, None)
    summary: Summary = Summary()
    columns: ColumnNames = ColumnNames.model_construct()
    units: UnitNames = UnitNames.model_construct()
    duration: float = quantity(20.0, "s", gt=0)
    rate: float = quantity(100.0, "Hz", gt=0)

    @model_validator(mode="after")
    def _check_setting(self) -> Self:
        for key in SETTINGS:
            if key not in self.model_fields_set:
                raise ValueError(f"{key} is missing, allowed is a number")
        if abs(self.surface_speed) < SLOWEST_SURFACE:
            still = f"surface_speed = {self.surface_speed:g}: nothing is driven"
            raise ValueError(f"{still}, allowed is at least {SLOWEST_SURFACE:g} m/s either way")
        return self


class MeasuredRunTable(RunTable):
    """One [[run]] that was made."""

    @model_validator(mode="after")
    def _check_source(self) -> Self:
        plan = "neither given, allowed is one of the two (a run still to be made: stickslip plan)"
        if bool(self.file) == bool(self.summary.given):
            both = "both given, allowed is one of the two"
            raise ValueError(f"file and summary: {both if self.file else plan}")
        return self


class CampaignTable(Table):
    """campaign.toml but for its runs.

    name : name of the campaign
    """

    name: str = quantity("unnamed", None, min_length=1, max_length=200)
    rig: Rig = Rig()
    model: Model = Model()
    noise: Noise = Noise()
    errors: Errors = Errors()
    friction: Friction = Friction()
    limits: Limits = Limits()
    columns: ColumnNames = ColumnNames.model_construct()
    units: UnitNames = UnitNames.model_construct()

    @model_validator(mode="after")
    def _check_lengths(self) -> Self:
        for key in LENGTHS:
            if not SHORTEST <= getattr(self.rig, key) <= LONGEST:
                is_none = f"rig.{key} = {getattr(self.rig, key):g} m is no length of a rig"
                raise ValueError(f"{is_none}, allowed is {SHORTEST:g} to {LONGEST:g} m")
        return self


FILE_NAME = "campaign.toml"


def _refuse_settings_of_runs(tables: Mapping[str, Any]) -> None:
    """A mass that stands under [rig]: the rig is what all runs share."""
    for name, table in tables.items():
        field = CampaignTable.model_fields.get(name)
        known = getattr(field.annotation, "model_fields", {}) if field else {}
        for key in SETTINGS if isinstance(table, dict) else ():
            if key in table and key not in known:
                own = f"may differ from run to run, allowed is {key} in each [[run]]"
                raise CampaignError(f"{name}.{key} = {table[key]}: {own}")


def read_tables(
    path: Path, kind: type[RunTable] = MeasuredRunTable
) -> tuple[CampaignTable, list[RunTable], Catalogue]:
    """The campaign's table, those of its runs, and its effects; CampaignError in one line.

    kind : `RunTable` where the runs are only planned
    """
    if not path.exists():
        allowed = "a campaign.toml or a folder with one"
        made = f"; `stickslip campaign {path.parent}` makes it of the folder's tracker files"
        hint = made if path.name == FILE_NAME and path.parent.is_dir() else ""
        raise CampaignError(f"{path}: no such file, allowed is {allowed}{hint}")
    try:
        tables = parsed(text_of(path), path)
    except ScenarioError as fault:
        raise CampaignError(str(fault)) from None
    runs = tables.pop("run", None)
    if not (runs and isinstance(runs, list) and all(isinstance(run, dict) for run in runs)):
        near = nearest("run", [key for key in tables if key not in CampaignTable.model_fields])
        hint = f" (nearest: {near})" if runs is None and near else ""
        raise CampaignError(f"{path}: run: no runs{hint}, allowed is a table [[run]] for each run")
    read = []
    with within(path):
        _refuse_settings_of_runs(tables)
        named = {"name": path.resolve().parent.name or "unnamed"} | tables
        campaign = checked(CampaignTable, named)
    try:
        files = [path.parent / name for name in campaign.model.effects]
        catalogue = default_catalogue().with_files(*files)
    except PluginError as error:
        raise CampaignError(f"{path}: model.effects: {error}") from None
    for number, run in enumerate(runs, 1):
        with within(f"{path}: run {number}"):
            read.append(checked(kind, run))
    return campaign, read, catalogue
