"""Reading and writing FMU variables by name, whatever their type."""

from collections.abc import Iterable, Mapping

from fmpy.fmi2 import FMU2Slave
from fmpy.model_description import ModelVariable

_GETTERS = {"Real": "getReal", "Integer": "getInteger", "Boolean": "getBoolean"}
_SETTERS = {
    "Real": ("setReal", float),
    "Integer": ("setInteger", int),
    "Boolean": ("setBoolean", bool),
    "String": ("setString", str),
}


def _call_type(variable: ModelVariable) -> str:
    """The type whose functions serve a variable: FMI 2 passes enumerations as integers."""
    return "Integer" if variable.type == "Enumeration" else variable.type


class Reader:
    """Reads a fixed set of numeric variables, one FMI call for each type."""

    def __init__(self, variables: Iterable[ModelVariable]):
        self._groups: dict[str, tuple[list[str], list[int]]] = {}
        for variable in variables:
            names, references = self._groups.setdefault(_call_type(variable), ([], []))
            names.append(variable.name)
            references.append(variable.valueReference)

    def read(self, fmu: FMU2Slave) -> dict[str, float]:
        """Name -> value."""
        values: dict[str, float] = {}
        for kind, (names, references) in self._groups.items():
            values.update(zip(names, getattr(fmu, _GETTERS[kind])(references), strict=True))
        return values


def write(
    fmu: FMU2Slave, variables: Mapping[str, ModelVariable], values: Mapping[str, object]
) -> None:
    """Set variables by name, one FMI call for each type."""
    groups: dict[str, tuple[list[int], list[object]]] = {}
    for name, value in values.items():
        kind = _call_type(variables[name])
        references, numbers = groups.setdefault(kind, ([], []))
        references.append(variables[name].valueReference)
        numbers.append(_SETTERS[kind][1](value))
    for kind, (references, numbers) in groups.items():
        getattr(fmu, _SETTERS[kind][0])(references, numbers)
