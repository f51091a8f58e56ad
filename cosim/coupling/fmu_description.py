"""What an FMU file declares: ports, and the values that may be given to it before it starts."""

import math
import zipfile
import zlib
from collections.abc import Mapping
from numbers import Real
from pathlib import Path

import fmpy
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
