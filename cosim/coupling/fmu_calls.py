"""Calls of an FMU: variables read and written by name, and what it says meanwhile."""

import itertools
from collections.abc import Iterable, Mapping
from ctypes import byref

import fmpy
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
    fmi2Discard,
    fmi2Pending,
)
from fmpy.logging import addLoggerProxy
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


_numbers = itertools.count(1)
_logs: dict[int, "FmuLog"] = {}


class FmuLog:
    """The messages of one FMU instance.

    The logger behind all instances is one function, since fmpy's proxy, which formats the
    variadic message in C, keeps a single one for the process; the component environment tells
    the instances apart.
    """

    def __init__(self) -> None:
        self._errors: list[str] = []
        self._number = next(_numbers)
        _logs[self._number] = self
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = _logger
        self.callbacks.allocateMemory = _allocate
        self.callbacks.freeMemory = _free
        self.callbacks.componentEnvironment = self._number
        addLoggerProxy(byref(self.callbacks))

    def add(self, status: int, message: str) -> None:
        """Keep a message that reports a failure (discard, error or fatal)."""
        if fmi2Discard <= status < fmi2Pending:
            self._errors.append(" ".join(message.split()))

    def take_errors(self) -> str:
        """The failures reported since the last call, in one line; "" when there were none."""
        text = "; ".join(dict.fromkeys(self._errors))
        self._errors.clear()
        return text

    def close(self) -> None:
        """Stop listening."""
        _logs.pop(self._number, None)


def _dispatch(environment, instance_name, status, category, message):
    log = _logs.get(environment or 0)
    if log is not None and message is not None:
        log.add(status, message.decode("utf-8", errors="replace"))


# Kept for the life of the process: C code holds pointers to them.
_logger = fmi2CallbackLoggerTYPE(_dispatch)
_allocate = fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
_free = fmi2CallbackFreeMemoryTYPE(fmpy.free)
