"""What StickSlip3DOF has for variables: ports and parameters, in the order of their references."""

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, get_args, get_origin

from pydantic.fields import FieldInfo
from stickslip import Parameters, ports
from stickslip.catalogue import CATALOGUE, Catalogue
from stickslip.kernel import layout
from stickslip.packaged import packaged_tables
from stickslip.quantity import details
from stickslip.units import UNITS

import cosim

Entry = dict[str, Any]

#: Guides, terminals, and what the unit has that its model has not.
DECLARED = packaged_tables(__package__, "variables.toml")
_WITHOUT: Entry = {"unit": None, "nominal": None, "max": None, "above_min": False}
#: Parameters that the FMU shows otherwise than the parameter models do.
GUIDES: dict[str, Entry] = {
    key: _WITHOUT
    | {
        "min": 0,
        "max": 1,
        "description": f"1: the block can move in {motion}; 0: a guide keeps it from that",
    }
    for key, motion in DECLARED["guides"].items()
}
SPECIAL: dict[str, Entry] = {
    "rig.inertia": {
        "min": 0,
        "description": "moment of inertia about the vertical; 0: that of a disc, m a^2 / 2",
    },
    **{
        f"friction.table_{of}[{i + 1}]": {"min": 0}
        for of, limit in (("speed", layout.CURVE_LIMIT), ("mu", layout.TABLE_LIMIT))
        for i in range(limit)
    },
}
#: Of the unit alone: what it does with its inputs, and bounds of what it watches, see `WATCHED`.
HOLD: Entry = _WITHOUT | DECLARED["hold"]
LIMITS: tuple[Entry, ...] = tuple(_WITHOUT | each for each in DECLARED["limits"])
#: Parameters that may be changed in a run, where a unit can take that.
TUNABLE = ("friction.mu_s", "friction.mu_k")


@dataclass(frozen=True)
class Variable:
    """A variable of the unit; its value reference is its place among all.

    causality: input, output, parameter or local; unit: None for an integer; slot: where the kernel
    keeps a port; above_min: whether min itself is excluded; is_state: whether a host of model
    exchange integrates it; derivative_of: name of the state that it is the rate of; is_boolean:
    whether it is true or false, and has no unit.
    """

    name: str
    causality: str
    unit: str | None
    nominal: float | None
    description: str
    min: float | int | None = None
    max: float | int | None = None
    above_min: bool = False
    start: float | int | None = None
    slot: str = ""
    is_state: bool = False
    derivative_of: str = ""
    is_boolean: bool = False

    @property
    def type(self) -> str:
        """Its type in FMI 2: Real, Integer or Boolean."""
        if self.is_boolean:
            return "Boolean"
        return "Integer" if self.unit is None else "Real"

    @property
    def is_discrete(self) -> bool:
        """Whether it is no real number, and changes at events only."""
        return self.unit is None

    @property
    def array(self) -> str:
        """Name of the array that it is an element of, empty if it is none: ``a`` of ``a[3]``."""
        return self.name.partition("[")[0] if self.name.endswith("]") else ""

    @property
    def is_tunable(self) -> bool:
        """Whether it is a parameter that may be changed in a run."""
        return self.name in TUNABLE


#: Outputs of the unit alone: what no rig bears. The model goes on as if it did.
WATCHED = tuple(
    Variable(name, "output", None, None, text, is_boolean=True)
    for name, text in DECLARED["watched"].items()
)


def variables(catalogue: Catalogue = CATALOGUE) -> list[Variable]:
    """All of them: inputs, outputs, parameters."""
    return [
        *(_of_port(port, "input") for port in ports.INPUTS),
        *(_of_port(port, "output") for port in ports.OUTPUTS),
        *WATCHED,
        *(Variable(causality="parameter", **entry) for entry in parameter_table(catalogue)),
    ]


def parameter_table(catalogue: Catalogue = CATALOGUE) -> list[Entry]:
    """Every parameter of the FMU, with unit, bounds and description from the parameter models.

    One entry each: name, unit (None: an integer), nominal, min, max, above_min (whether min itself
    is excluded), description, start. The starts are those of a scenario's file that leaves all
    out: a rig that can be built. Raises ValueError for a unit that `UNITS` lacks.
    """
    kind = Parameters.of(catalogue)
    starts = kind.model_validate(rig_defaults()).flat()
    return [*(_entry(kind, name, start) for name, start in starts.items()), HOLD, *LIMITS]


def rig_defaults() -> dict[str, Entry]:
    """Tables of what a scenario's file leaves out; `cosim.scenario`, which needs the heat model, is
    not imported."""
    file = Path(cosim.__path__[0]) / "scenario" / "defaults.toml"
    return tomllib.loads(file.read_text(encoding="utf-8"))


def by_array(declared: Iterable[Variable]) -> list[list[Variable]]:
    """The variables, those of an array together; each of the others by itself.

    Raises ValueError where elements of an array differ in more than name, nominal and start.
    """
    found: list[list[Variable]] = []
    for variable in declared:
        if not variable.array or not found or found[-1][0].array != variable.array:
            found.append([variable])
            continue
        first = found[-1][0]
        if replace(variable, name=first.name, nominal=first.nominal, start=first.start) != first:
            raise ValueError(f"{variable.name} is not declared as {first.name} is")
        found[-1].append(variable)
    return found


def names(of: Iterable[Variable], causality: str) -> list[str]:
    """Names of those of a causality."""
    return [each.name for each in of if each.causality == causality]


def _of_port(port: ports.Port, causality: str) -> Variable:
    kept = ("name", "unit", "nominal", "description", "min", "max", "start", "slot")
    return Variable(causality=causality, **{key: getattr(port, key) for key in kept})


def bounds_of(field: FieldInfo) -> dict[str, float]:
    """Those that pydantic checks of a parameter: gt, ge, lt and le, where there are any.

    Of a parameter of several numbers, those of each.
    """
    is_list = get_origin(field.annotation) is tuple
    one = FieldInfo.from_annotation(get_args(field.annotation)[0]) if is_list else field
    return {
        kind: getattr(bound, kind)
        for bound in one.metadata
        for kind in ("gt", "ge", "lt", "le")
        if getattr(bound, kind, None) is not None
    }


def _entry(kind: type[Parameters], name: str, start: float) -> Entry:
    group, key = name.split(".")
    entry = {"name": name, "nominal": abs(start) or 1.0, "start": start} | GUIDES.get(key, {})
    if key in GUIDES:
        return entry | {"start": int(start)}
    table: Any = kind.model_fields[group].annotation
    told = declared(table.model_fields[key.partition("[")[0]], f"effect or table {group}: {key}")
    if told["unit"] is None:
        entry |= {"start": int(start), "nominal": None}
    return entry | told | SPECIAL.get(name, {})


def declared(field: FieldInfo, label: str) -> Entry:
    """Unit (None: an integer), bounds and description of a parameter, of what its field says."""
    bounds = bounds_of(field)
    unit = None if field.annotation is int else details(field)["unit"]
    if unit is not None and unit not in UNITS:
        raise ValueError(f"{label} is in {unit!r}, a unit that UNITS of {__name__} lacks")
    return {
        "unit": unit,
        "min": bounds.get("gt", bounds.get("ge")),
        "max": bounds.get("lt", bounds.get("le")),
        "above_min": "gt" in bounds,
        "description": field.description or "",
    }
