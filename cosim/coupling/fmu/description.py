"""What a unit declares about itself, and whether it is one that can be coupled here."""

import os
import re
from functools import lru_cache
from pathlib import Path

import fmpy
from fmpy.model_description import ModelDescription, ValidationError

from cosim.coupling.fmu.archive import DESCRIPTION, read_xml
from cosim.coupling.fmu.errors import FmuError, one_line

#: Of the faults that fmpy finds.
HARMLESS = re.compile(
    r'The (display )?unit ".*" of (the )?variable.* is not defined\.'
    r'|.* must have variability != "continuous"\.'
    r'|The variable name ".*" \(line \d+\) is not unique\.'
)


def describe(path: Path) -> ModelDescription:
    """What an FMI 2.0 or 3.0 co-simulation FMU declares; FmuError in one line when it is none.

    Read once while the file stays what it is: a system may have one unit a thousand times.
    """
    return _read(path, _identity(path))[0]


def faults_of(path: Path) -> list[str]:
    """What is wrong with a description and does no harm here.

    Units of well-known tools lack the definition of a unit, call a whole number continuous, or give
    two inner variables one name.
    """
    return _read(path, _identity(path))[1]


def _identity(path: Path) -> tuple[int, ...]:
    """What changes with the content of a file; () where there is none."""
    try:
        found = path.stat()
    except OSError:
        return ()
    return (found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns)


@lru_cache(maxsize=256)
def _read(path: Path, identity: tuple[int, ...]) -> tuple[ModelDescription, list[str]]:
    if read_xml(path, DESCRIPTION) is None:
        raise FmuError(f"{path}: not an FMU: holds no {DESCRIPTION}")
    read_xml(path, "sources/buildDescription.xml")  # which fmpy parses, too
    faults: list[str] = []
    try:
        try:
            description = fmpy.read_model_description(path)
        except ValidationError as error:
            faults = [one_line(ValueError(problem)) for problem in error.problems]
            if not all(HARMLESS.fullmatch(problem) for problem in faults):
                raise
            description = fmpy.read_model_description(path, validate=False)
    except ValidationError as error:
        raise FmuError(f"{path}: its {DESCRIPTION} is not valid: {one_line(error)}") from error
    # fmpy raises whatever comes of a reference to nothing, an unknown version, a missing attribute
    except Exception as error:
        raise FmuError(
            f"{path}: its {DESCRIPTION} does not make sense: {one_line(error)}"
        ) from error
    _check(path, description)
    return description, faults


def is_fmi3(description: ModelDescription) -> bool:
    """Whether it is FMI 3, not 2."""
    found: bool = description.fmiVersion.startswith("3.")
    return found


def takes_waveforms(description: ModelDescription) -> bool:
    """Whether a unit interpolates its inputs by their derivatives; FMI 3.0 has none."""
    return not is_fmi3(description) and bool(description.coSimulation.canInterpolateInputs)


def may_end_early(description: ModelDescription) -> bool:
    """Whether a unit can end a step before its end; none of FMI 2.0 can."""
    able = description.coSimulation
    return is_fmi3(description) and bool(able.mightReturnEarlyFromDoStep or able.hasEventMode)


def _check(path: Path, description: ModelDescription) -> None:
    version = description.fmiVersion
    if version != "2.0" and not re.fullmatch(r"3\.\d+(\.\d+)?", version):
        raise FmuError(
            f"{path}: is FMI {version}; what is coupled here is FMI 2.0 and 3.0, for co-simulation"
        )
    if description.coSimulation is None:
        why = (
            "scheduled execution only, whose parts a scheduler calls; allowed is a unit for "
            "co-simulation"
        )
        if description.modelExchange is not None:
            why = (
                "model exchange only, whose states the host integrates; allowed is a unit for "
                "co-simulation: export it as one, with the solver of its tool; by itself it runs "
                "with `fmpy simulate FILE --interface-type ModelExchange`"
            )
        raise FmuError(f"{path}: is for {why}")
    identifier = description.coSimulation.modelIdentifier
    if not re.fullmatch(r"[\w.+ -]+", identifier) or identifier.startswith("."):
        raise FmuError(
            f"{path}: its model identifier {identifier!r} is no name of a library: letters, "
            "digits and underscores"
        )


def library_of(path: Path, folder: Path, description: ModelDescription) -> Path:
    """The library for this machine in the folder that a unit is unpacked in; FmuError for none."""
    platform = fmpy.platform_tuple if is_fmi3(description) else fmpy.platform
    file = f"{description.coSimulation.modelIdentifier}{fmpy.sharedLibraryExtension}"
    library: Path = folder / "binaries" / platform / file
    if not library.is_file():
        binaries = folder / "binaries"
        there = sorted(each.name for each in binaries.iterdir()) if binaries.is_dir() else []
        raise FmuError(
            f"{path}: holds no library for this machine, binaries/{platform}/{file}; it is for "
            f"{', '.join(there) or 'none'}"
        )
    return library


def unloadable(path: Path, folder: Path, library: Path, error: BaseException) -> FmuError | None:
    """What the system said of a library that it does not load, in terms of the user's file and not
    of the unpacked copy; None for any other error."""
    cause = error.__cause__ or error.__context__
    if isinstance(error, AttributeError) or isinstance(cause, AttributeError):
        cause = error  # a library, but without a function of the standard
    elif not isinstance(cause, OSError):
        return None
    member = library.relative_to(folder).as_posix()
    reason = one_line(cause).replace(f"{library}: ", "").replace(f"{folder}{os.sep}", "")
    return FmuError(
        f"{path}: its library {member} cannot be loaded: {reason}; "
        "allowed is a shared library for this machine with the functions of FMI"
    )
