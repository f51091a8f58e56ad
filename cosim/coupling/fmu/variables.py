"""The variables of a unit as numbers: arrays element by element, ports, and what may be set."""

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from numbers import Real

from fmpy.model_description import ModelDescription, ModelVariable

from cosim.coupling.conversion import BASE_UNITS, NO_UNIT
from cosim.coupling.fmu.errors import FmuError
from cosim.coupling.participant import Causality, Port, UnitDefinition
from cosim.names import unknown_name

Setting = float | int | bool | str

#: Types that fit a port, a number: of FMI 2.0, of FMI 3.0, of both.
REALS = ("Real", "Float32", "Float64")
INTEGERS = ("Integer", *(f"{sign}Int{bits}" for sign in ("", "U") for bits in (8, 16, 32, 64)))
NUMERIC = (*REALS, *INTEGERS, "Boolean", "Enumeration")
#: Kind of a setting that says what a variable starts from.
START = "start value"
#: Elements of all arrays of a unit, more is no set of ports.
MOST_ELEMENTS = 100_000


@dataclass(frozen=True)
class Scalar:
    """A variable, or an element of an array.

    place: of the element in the array, row by row. size: number of elements, 1 for no array.
    start: what it is unless it is set, as declared.
    """

    name: str
    variable: ModelVariable
    place: int = 0
    size: int = 1
    start: str | None = None

    @property
    def is_array(self) -> bool:
        """Whether it is an element of one."""
        return bool(self.variable.shape)


def scalars(description: ModelDescription) -> dict[str, Scalar]:
    """Name -> scalar, of numbers and texts; elements of arrays are `name[1]`, `name[1,2]`.

    Left out is what is neither: binary data, clocks, and what a clock alone may change.
    """
    table: dict[str, Scalar] = {}
    elements = 0
    for variable in description.modelVariables:
        if variable.type not in (*NUMERIC, "String") or variable.clocks:
            continue
        elements += math.prod(variable.shape or ())
        if elements > MOST_ELEMENTS:
            raise FmuError(
                f"{description.modelName}: {variable.name} is an array with which the unit has "
                f"{elements} variables, allowed are {MOST_ELEMENTS}"
            )
        for scalar in _elements(variable):
            if scalar.name in table:
                if _is_inner(scalar.variable) and _is_inner(table[scalar.name].variable):
                    continue  # nobody reads or sets them
                raise FmuError(f"{description.modelName}: two variables are named {scalar.name}")
            table[scalar.name] = scalar
    return table


def _is_inner(variable: ModelVariable) -> bool:
    return variable.causality in ("local", "calculatedParameter", None)


def _elements(variable: ModelVariable) -> list[Scalar]:
    if not variable.shape:
        return [Scalar(variable.name, variable, start=variable.start)]
    size = math.prod(variable.shape)
    starts: list[str | None] = [*(variable.start or "").split()]
    if len(starts) != size:
        starts = [starts[0] if len(starts) == 1 else None] * size  # one stands for all of them
    places = itertools.product(*(range(1, length + 1) for length in variable.shape))
    return [
        Scalar(f"{variable.name}[{','.join(map(str, at))}]", variable, place, size, starts[place])
        for place, at in enumerate(places)
    ]


def ports_of(description: ModelDescription, table: Mapping[str, Scalar]) -> list[Port]:
    """The numeric inputs and outputs, in the order declared."""
    definitions = definitions_of(description)
    return [
        Port(
            scalar.name,
            unit_of(scalar.variable),
            Causality(scalar.variable.causality),
            _nominal(scalar.variable),
            definitions.get(unit_of(scalar.variable)),
            *_range(scalar.variable),
        )
        for scalar in table.values()
        if scalar.variable.causality in ("input", "output") and scalar.variable.type in NUMERIC
    ]


def unit_of(variable: ModelVariable) -> str:
    """The declared unit, of the variable or of its type; "1" when there is none."""
    return (_declared(variable, "unit") or "").strip() or NO_UNIT


def _declared(variable: ModelVariable, key: str) -> str | None:
    """What is declared of a variable, or of its type."""
    declared: str | None = getattr(variable, key)
    if declared is None and variable.declaredType is not None:
        declared = getattr(variable.declaredType, key)
    return declared


def _range(variable: ModelVariable) -> tuple[float, float]:
    """Least and largest value that is declared."""
    low, high = _declared(variable, "min"), _declared(variable, "max")
    return -math.inf if low is None else float(low), math.inf if high is None else float(high)


def _nominal(variable: ModelVariable) -> float:
    declared = _declared(variable, "nominal")
    size = 1.0 if declared is None else abs(float(declared))
    return size if 0.0 < size < math.inf else 1.0


def definitions_of(description: ModelDescription) -> dict[str, UnitDefinition]:
    """Unit -> what it is made of, of those that an FMU defines."""
    return {
        unit.name: UnitDefinition(
            tuple(int(getattr(unit.baseUnit, base)) for base in BASE_UNITS),
            float(unit.baseUnit.factor),
            float(unit.baseUnit.offset),
        )
        for unit in description.unitDefinitions
        if unit.baseUnit is not None
    }


def check_settings(
    fmu_name: str, table: Mapping[str, Scalar], settings: Mapping[str, Setting], kind: str
) -> None:
    """Every name is a variable of the kind, every value has its type and range.

    kind: "parameter", "input", or `START`, of an output or a variable inside that a host may set
    before initialisation. Raises FmuError with the nearest name or the range.
    """
    starts = kind == START
    known = [
        name
        for name, each in table.items()
        if (_may_start(each.variable) if starts else each.variable.causality == kind)
    ]
    for name, value in settings.items():
        if name not in table:
            raise FmuError(unknown_name(f"{kind} of {fmu_name}", name, known))
        variable = table[name].variable
        if starts and not _may_start(variable):
            raise FmuError(
                f"{fmu_name}.{name}: what it starts from cannot be set, of variables that are no "
                "parameter or input only those with initial = exact or approx"
            )
        if not starts and variable.causality != kind:
            raise FmuError(f"{fmu_name}.{name} is a {variable.causality}, not a {kind}")
        _check_value(f"{fmu_name}.{name}", variable, value)


def _may_start(variable: ModelVariable) -> bool:
    exact = variable.initial in ("exact", "approx") and variable.variability != "constant"
    return exact and variable.causality in ("output", "local")


def _check_value(label: str, variable: ModelVariable, value: Setting) -> None:
    if variable.type == "String":
        if not isinstance(value, str):
            raise FmuError(f"{label} = {value!r}: must be a text")
    elif variable.type == "Boolean":
        if not isinstance(value, bool):
            raise FmuError(f"{label} = {value!r}: must be true or false")
    elif isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
        raise FmuError(f"{label} = {value!r}: must be a finite number")
    elif variable.type not in REALS and float(value) != int(value):
        raise FmuError(f"{label} = {value!r}: must be a whole number")
    else:
        least, most = _range(variable)
        if not least <= value <= most:
            raise FmuError(f"{label} = {value:g}: must lie in [{least:g}, {most:g}]")
