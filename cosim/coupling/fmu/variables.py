"""The variables of a unit as numbers: elements of arrays, ports, what may be set, and values.

Values of many variables go in and out by name, by one call of the unit for each type. What FMI 2.0
and 3.0 have in common; fmpy has a function for each type.
"""

import itertools
import math
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
from typing import Any

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


#: How many sets of names a table of calls is kept of: those of a run are a handful.
MOST_PLANS = 256


def converter(kind: str) -> Callable[[Any], Any]:
    """What makes a value one of a type as fmpy's functions call it: Float64, Int8, Boolean, ..."""
    if kind in REALS:
        return float
    if kind == "String":
        return str
    if kind == "Boolean":
        return lambda value: round(value) != 0  # nearer to 1 than to 0, or beyond
    bits = int((re.findall(r"\d+", kind) or ["32"])[0])
    least, most = (0, 2**bits - 1) if kind[0] == "U" else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)

    def whole(value: Any) -> int:
        """The nearest whole number, which the type must be able to hold."""
        number: int = round(value)
        if not least <= number <= most:
            raise FmuError(f"{value:g} is given to an integer from {least} to {most}")
        return number

    return whole


class Group:
    """Variables of one type that are read or written together.

    kind: the type, as fmpy's functions call it. references: of the variables; size: number of all
    their elements. discrete: whether they may change at events only.
    """

    def __init__(self, kind: str, members: Sequence[Scalar], discrete: bool) -> None:
        self.kind, self.discrete = kind, discrete
        self._convert = converter(kind)
        offsets: dict[int, int] = {}
        self.size = 0
        for each in members:
            if each.variable.valueReference not in offsets:
                offsets[each.variable.valueReference] = self.size
                self.size += each.size
        self.references = list(offsets)
        self.places = {
            each.name: offsets[each.variable.valueReference] + each.place for each in members
        }

    def elements(self, values: Mapping[str, Any]) -> list[Any]:
        """Values by name, all elements of an array among them, as the unit takes them."""
        found: list[Any] = [None] * self.size
        for name, place in self.places.items():
            found[place] = self._convert(values[name])
        return found

    def named(self, elements: Sequence[Any]) -> dict[str, Any]:
        """Name -> what the unit gives."""
        return {name: elements[place] for name, place in self.places.items()}


#: What is to be written: of each group its elements.
Filled = list[tuple[Group, list[Any]]]


class Values:
    """The variables of a unit in groups.

    enumeration: type of an enumeration's values. known: element of an array -> the newest value;
    an array is written as a whole, whichever of its elements are new.
    """

    def __init__(self, table: Mapping[str, Scalar], enumeration: str) -> None:
        self._table, self._enumeration = table, enumeration
        self._plans: dict[tuple[str, ...], tuple[list[Group], bool]] = {}
        self._arrays: dict[str, list[Scalar]] = {}
        self.known: dict[str, Any] = {}
        for scalar in table.values():
            if scalar.is_array:
                self._arrays.setdefault(scalar.variable.name, []).append(scalar)
                if scalar.start is not None:
                    self.known[scalar.name] = _read(scalar)

    def groups(self, names: Iterable[str]) -> list[Group]:
        """What reads variables by name; of an array it takes those that are asked for."""
        members: dict[tuple[str, bool], list[Scalar]] = {}
        for name in names:
            scalar = self._table[name]
            kind = scalar.variable.type
            kind = self._enumeration if kind == "Enumeration" else kind
            discrete = scalar.variable.variability == "discrete"
            members.setdefault((kind, discrete), []).append(scalar)
        return [Group(kind, group, discrete) for (kind, discrete), group in members.items()]

    def filled(self, values: Mapping[str, Any]) -> Filled:
        """Groups with these values, ready to be written."""
        names = tuple(values)
        if names not in self._plans:
            if len(self._plans) >= MOST_PLANS:
                self._plans.clear()
            groups = self.groups(self._with_whole_arrays(names))
            self._plans[names] = groups, any(self._table[name].is_array for name in names)
        groups, with_arrays = self._plans[names]
        if with_arrays:
            values = self._with_known(values, groups)
        return [(group, group.elements(values)) for group in groups]

    def _with_whole_arrays(self, names: Iterable[str]) -> list[str]:
        wanted: dict[str, None] = {}
        for name in names:
            scalar = self._table[name]
            for each in self._arrays.get(scalar.variable.name, [scalar]):
                wanted[each.name] = None
        return list(wanted)

    def _with_known(self, values: Mapping[str, Any], groups: list[Group]) -> Mapping[str, Any]:
        self.known.update((name, v) for name, v in values.items() if self._table[name].is_array)
        whole = {**self.known, **values}
        for name in (name for group in groups for name in group.places):
            if name not in whole:
                raise FmuError(
                    f"{name} has no start value: the whole array that it is of must be set"
                )
        return whole


def _read(scalar: Scalar) -> Any:
    text = str(scalar.start)
    if scalar.variable.type == "Boolean":
        return text in ("true", "1")
    return text if scalar.variable.type == "String" else float(text)
