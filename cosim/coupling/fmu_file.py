"""Opening an FMU file: what it declares, as ports and parameters."""

import zipfile
import zlib
from pathlib import Path

import fmpy
from fmpy.model_description import ModelDescription, ModelVariable, ValidationError
from lxml.etree import XMLSyntaxError

from cosim.coupling.errors import FmuError
from cosim.coupling.ports import Causality, Port

# FMI 2 types that fit a port: a number. Strings do not.
NUMERIC = ("Real", "Integer", "Boolean", "Enumeration")
PLAIN_NUMBER = "1"


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
