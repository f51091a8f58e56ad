"""An FMU by its names: what its file declares, values read and written, and its messages."""

import itertools
import math
import zipfile
import zlib
from collections.abc import Iterable, Mapping
from ctypes import byref
from numbers import Real
from pathlib import Path

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
from fmpy.model_description import ModelDescription, ModelVariable, ValidationError
from lxml.etree import XMLSyntaxError

from cosim.coupling.participant import Causality, Port
from cosim.names import unknown_name

# FMI 2 types that fit a port: a number. Strings do not.
NUMERIC = ("Real", "Integer", "Boolean", "Enumeration")
PLAIN_NUMBER = "1"

Setting = float | int | bool | str


class FmuError(ValueError):
    """A file is not an FMU that can be used here, or a value given to it is refused."""


def describe(path: Path) -> ModelDescription:
    """What an FMI 2.0 co-simulation FMU declares; FmuError in one line when it is none."""
    if not path.is_file():
        raise FmuError(f"{path}: no such file; expected an FMU")
    try:
        description = fmpy.read_model_description(path)
    except (zipfile.BadZipFile, zlib.error, EOFError) as error:
        raise FmuError(f"{path}: not an FMU, or truncated ({error})") from error
    except KeyError as error:
        raise FmuError(f"{path}: not an FMU: holds no modelDescription.xml") from error
    except (XMLSyntaxError, ValidationError) as error:
        reason = " ".join(str(error).split())
        raise FmuError(f"{path}: its modelDescription.xml is not valid: {reason}") from error
    if description.fmiVersion != "2.0":
        raise FmuError(f"{path}: is FMI {description.fmiVersion}; FMI 2.0 is what is coupled here")
    if description.coSimulation is None:
        raise FmuError(f"{path}: is for model exchange only; a co-simulation FMU is needed")
    return description


def extract(path: Path, directory: Path) -> None:
    """Unpack an FMU; FmuError in one line when its contents are damaged."""
    try:
        fmpy.extract(path, unzipdir=directory)
    except (zipfile.BadZipFile, zlib.error, EOFError) as error:
        raise FmuError(f"{path}: damaged ({error})") from error


def ports_of(description: ModelDescription) -> list[Port]:
    """The numeric inputs and outputs, in the order declared."""
    return [
        Port(variable.name, unit_of(variable), Causality(variable.causality))
        for variable in description.modelVariables
        if variable.causality in ("input", "output") and variable.type in NUMERIC
    ]


def unit_of(variable: ModelVariable) -> str:
    """The declared unit, of the variable or of its type; "1" when there is none."""
    declared = variable.unit
    if declared is None and variable.declaredType is not None:
        declared = variable.declaredType.unit
    return declared or PLAIN_NUMBER


def check_settings(
    fmu_name: str,
    variables: Mapping[str, ModelVariable],
    settings: Mapping[str, Setting],
    causality: str,
) -> None:
    """Every name is a variable of the causality, every value has its type and range.

    causality: "parameter" or "input". Raises FmuError with the nearest name or the range.
    """
    known = [name for name, variable in variables.items() if variable.causality == causality]
    for name, value in settings.items():
        variable = variables.get(name)
        if variable is None:
            raise FmuError(unknown_name(f"{causality} of {fmu_name}", name, known))
        if variable.causality != causality:
            raise FmuError(f"{fmu_name}.{name} is a {variable.causality}, not a {causality}")
        _check_value(f"{fmu_name}.{name}", variable, value)


def _check_value(label: str, variable: ModelVariable, value: Setting) -> None:
    if variable.type == "String":
        if not isinstance(value, str):
            raise FmuError(f"{label} = {value!r}: must be a text")
        return
    if variable.type == "Boolean":
        if not isinstance(value, bool):
            raise FmuError(f"{label} = {value!r}: must be true or false")
        return
    if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
        raise FmuError(f"{label} = {value!r}: must be a finite number")
    if variable.type != "Real" and float(value) != int(value):
        raise FmuError(f"{label} = {value!r}: must be a whole number")
    _check_range(label, variable, float(value))


def _check_range(label: str, variable: ModelVariable, value: float) -> None:
    low = -math.inf if variable.min is None else float(variable.min)
    high = math.inf if variable.max is None else float(variable.max)
    if not low <= value <= high:
        raise FmuError(f"{label} = {value:g}: must lie in [{low:g}, {high:g}]")


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


def set_variables(
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
