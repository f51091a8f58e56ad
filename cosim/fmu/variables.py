"""What StickSlip3DOF has for variables: ports and parameters, in the order of their references."""

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, get_args, get_origin

from pydantic.fields import FieldInfo
from stickslip import Parameters, ports
from stickslip.catalogue import CATALOGUE, Catalogue
from stickslip.packaged import packaged_tables
from stickslip.quantity import details
from stickslip.units import UNITS

import cosim

Entry = dict[str, Any]

#: Guides, terminals, and what the unit has that its model has not.
DECLARED = packaged_tables(__package__, "variables.toml")
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
    description: str
    unit: str | None = None
    nominal: float | None = None
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
    Variable(name, "output", text, is_boolean=True) for name, text in DECLARED["watched"].items()
)
#: Parameters of the unit alone: what it does with its inputs, and bounds of what it watches.
OWN = tuple(Variable(causality="parameter", **each) for each in DECLARED["parameters"])


def variables(catalogue: Catalogue = CATALOGUE) -> list[Variable]:
    """All of them: inputs, outputs, parameters.

    Parameters have unit, bounds and description from the parameter models. They start as a
    scenario's file that leaves all out: a rig that can be built. Raises ValueError for a unit that
    `UNITS` lacks.
    """
    kind = Parameters.of(catalogue)
    starts = kind.model_validate(rig_defaults()).flat()
    return [
        *(_of_port(port, "input") for port in ports.INPUTS),
        *(_of_port(port, "output") for port in ports.OUTPUTS),
        *WATCHED,
        *(_parameter(kind, name, start) for name, start in starts.items()),
        *OWN,
    ]


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


def _parameter(kind: type[Parameters], name: str, start: float) -> Variable:
    base = name.partition("[")[0]  # of an array, of which all elements are alike
    group, key = base.split(".")
    table: Any = kind.model_fields[group].annotation
    field = table.model_fields.get(key)
    told = {} if field is None else declared(field, f"effect or table {group}: {key}")
    told |= DECLARED["otherwise"].get(base, {})
    if told.get("unit") is None:
        return Variable(name, "parameter", start=int(start), **told)
    return Variable(name, "parameter", nominal=abs(start) or 1.0, start=start, **told)


def declared(field: FieldInfo, label: str) -> Entry:
    """Unit (None: an integer), bounds and description of a parameter, of what its field says."""
    bounds = bounds_of(field)
    unit = None if field.annotation is int else details(field)["unit"]
    if unit is not None and unit not in UNITS:
        raise ValueError(f"{label} is in {unit!r}, a unit that stickslip/units.toml lacks")
    return {
        "unit": unit,
        "min": bounds.get("gt", bounds.get("ge")),
        "max": bounds.get("lt", bounds.get("le")),
        "above_min": "gt" in bounds,
        "description": field.description or "",
    }
