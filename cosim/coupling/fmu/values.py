"""Values of many variables by name: one call of the unit for each type.

What FMI 2.0 and 3.0 have in common; fmpy has a function for each type.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from cosim.coupling.fmu.errors import FmuError
from cosim.coupling.fmu.variables import REALS, Scalar

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
