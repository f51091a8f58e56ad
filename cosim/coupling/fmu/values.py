"""Values of many variables by name: one call of the unit for each type, its memory kept.

What FMI 2.0 and 3.0 have in common; which function serves which type they say by their `Kind`s.
"""

import ctypes
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from cosim.coupling.fmu.errors import FmuError
from cosim.coupling.fmu.variables import Scalar

#: How many sets of names a table of calls is kept of: those of a run are a handful.
MOST_PLANS = 256


@dataclass(frozen=True)
class Kind:
    """A type of variables: of what it is in memory, and what the functions that serve it end in."""

    memory: Any
    function: str
    convert: Callable[[Any], Any]


def whole(memory: Any) -> Callable[[Any], int]:
    """The nearest whole number, of a type of C that must be able to hold it."""
    signed = memory(-1).value < 0
    bits = 8 * ctypes.sizeof(memory) - signed
    least, most = (-(2**bits) if signed else 0), 2**bits - 1

    def convert(value: Any) -> int:
        number: int = round(value)
        if not least <= number <= most:
            raise FmuError(f"{value:g} is given to an integer from {least} to {most}")
        return number

    return convert


def truth(value: Any) -> bool:
    """Whether a number is nearer to 1 than to 0, or beyond."""
    found: bool = round(value) != 0
    return found


def encoded(value: str) -> bytes:
    """A text for C."""
    return value.encode("utf-8")


class Group:
    """Variables of one kind that are read or written together.

    memory: of C, as functions of FMI take it: references of the variables, their number, all their
    elements, the number of those. discrete: whether they may change at events only.
    """

    def __init__(self, kind: Kind, members: Sequence[Scalar], discrete: bool) -> None:
        self.kind = kind
        self.discrete = discrete
        self.names = [each.name for each in members]
        offsets: dict[int, int] = {}
        size = 0
        for each in members:
            if each.variable.valueReference not in offsets:
                offsets[each.variable.valueReference] = size
                size += each.size
        self._values = (kind.memory * size)()
        count = len(offsets)
        self.memory = ((ctypes.c_uint * count)(*offsets), count, self._values, size)
        self._places = [offsets[each.variable.valueReference] + each.place for each in members]

    def put(self, values: Mapping[str, Any]) -> None:
        """Fill the memory; all elements of an array are there."""
        for name, place in zip(self.names, self._places, strict=True):
            self._values[place] = self.kind.convert(values[name])

    def got(self) -> dict[str, Any]:
        """Name -> what is in the memory."""
        found = self._values[:]
        return {name: found[place] for name, place in zip(self.names, self._places, strict=True)}


class Values:
    """The variables of a unit in groups.

    known: element of an array -> the newest value; an array is written as a whole, whichever of
    its elements are new.
    """

    def __init__(self, table: Mapping[str, Scalar], kinds: Mapping[str, Kind]) -> None:
        self._table = table
        self._kinds = kinds
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
            kind = self._kinds[scalar.variable.type]
            discrete = scalar.variable.variability == "discrete"
            members.setdefault((kind.function, discrete), []).append(scalar)
        return [
            Group(self._kinds[group[0].variable.type], group, discrete)
            for (_, discrete), group in members.items()
        ]

    def filled(self, values: Mapping[str, Any]) -> list[Group]:
        """Groups that hold these values, ready to be written."""
        names = tuple(values)
        plan = self._plans.get(names)
        if plan is None:
            if len(self._plans) >= MOST_PLANS:
                self._plans.clear()
            groups = self.groups(self._with_whole_arrays(names))
            plan = groups, any(self._table[name].is_array for name in names)
            self._plans[names] = plan
        groups, with_arrays = plan
        if with_arrays:
            values = self._with_known(values, groups)
        for group in groups:
            group.put(values)
        return groups

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
        for group in groups:
            for name in group.names:
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
