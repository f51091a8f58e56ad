"""The units by their names: built where they are asked for, and again when they are stale."""

import os
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import platformdirs
from stickslip.catalogue import CATALOGUE, Catalogue
from stickslip.generation.compiler import NO_COMPILER, CompilerError
from stickslip.generation.platforms import Platform, this_machine
from stickslip.scratch import scratch_folder

from cosim.files import clear_partial
from cosim.fmu import libraries, native, python_unit
from cosim.fmu.libraries import runs_here
from cosim.fmu.thermal import native_unit
from cosim.fmu.unit_files import FMI3, NATIVE, PYTHON, SYSTEM, THERMAL, THERMAL_FMI3, THERMAL_PYTHON
from cosim.processes import apart

#: Folder of a checkout in which its units stand, beside the recipes.
BUILD_FOLDER = Path("build")
#: Units of pythonfmu.
MADE_APART = (PYTHON, THERMAL_PYTHON)


class FmuBuildError(ValueError):
    """A unit cannot be built or written; the message names the folder or the reason."""


def own_folder(catalogue: Catalogue = CATALOGUE) -> Path:
    """Where the units stand that nobody named: `build` of a checkout, else the user's cache."""
    if not catalogue.outside and (BUILD_FOLDER / "units.py").is_file():
        return BUILD_FOLDER
    return _cache_folder(catalogue)


def _cache_folder(catalogue: Catalogue) -> Path:
    """Of these effects and this version alone: two that run at once share no file."""
    names = [*(effect.id for effect in catalogue.outside), native.guid(catalogue)[:8]]
    return platformdirs.user_cache_path("stickslip") / "-".join(names)


def own_fmu(catalogue: Catalogue = CATALOGUE) -> Path:
    """The native unit in `own_folder`, fresh; where that cannot be written, in the cache or a
    scratch folder."""
    for place in dict.fromkeys((own_folder(catalogue), _cache_folder(catalogue))):
        try:
            return ensure_fmu(place, catalogue=catalogue)
        except FmuBuildError as error:
            refused = error  # the last is told
    try:
        return ensure_fmu(_scratch().name, catalogue=catalogue)
    except (FmuBuildError, OSError):
        raise refused from refused.__cause__


@cache
def _scratch() -> TemporaryDirectory[str]:
    """A folder for units, as long as this process."""
    return scratch_folder("units")


def ensure_fmu(directory: str | Path, name: str = NATIVE, catalogue: Catalogue = CATALOGUE) -> Path:
    """A native unit of `UNITS` in a directory, built there when it is missing, damaged or stale.

    Its GUID decides, never a date. What is built has a library for this machine. Raises
    FmuBuildError.
    """
    fmu = Path(directory) / name
    if native.built_guid(fmu) == native.guid(catalogue) and runs_here(fmu):
        return fmu
    return build_fmu(directory, name, catalogue=catalogue)


def build_fmu(
    directory: str | Path,
    name: str = NATIVE,
    platforms: Sequence[Platform] = (),
    catalogue: Catalogue = CATALOGUE,
) -> Path:
    """Build a unit of `UNITS` in a directory, which is made when it does not exist; its path.

    platforms : of a native unit, those that it is to have libraries for, as far as there is a
    compiler for them; none: that of this machine. The file appears at once and whole. Raises
    FmuBuildError in one line.
    """
    directory = Path(directory)
    platforms = platforms or [this_machine()]
    require_way(name, platforms, catalogue)
    _check_writable(directory)
    try:
        return _made(name, directory, platforms, catalogue)
    except CompilerError as error:
        raise FmuBuildError(f"{name} was not built: {error}") from error


def require_way(
    name: str, platforms: Sequence[Platform] = (), catalogue: Catalogue = CATALOGUE
) -> None:
    """Raises FmuBuildError where there is no compiler for a unit that needs one."""
    guids = [native.guid(catalogue)] if name in (NATIVE, FMI3, SYSTEM) else []
    if name in (THERMAL, THERMAL_FMI3, SYSTEM):
        guids.append(native_unit.guid())
    try:
        for guid in guids:
            libraries.require_way(guid, platforms or [this_machine()])
    except CompilerError as error:
        why = str(error)
        if catalogue.outside:
            why = f"custom effects are compiled, and there is {NO_COMPILER}"
        if name in (NATIVE, FMI3):
            why += f"; {PYTHON} needs none: `stickslip build {PYTHON} -o .`, `run --fmu {PYTHON}`"
        raise FmuBuildError(f"{name} was not built: {why}") from error


def _made(name: str, directory: Path, platforms: Sequence[Platform], catalogue: Catalogue) -> Path:
    if name in MADE_APART:
        return _made_apart(name, directory, catalogue)
    if name == SYSTEM:
        from cosim.fmu.thermal import structure  # the scenario, and with it the heat model

        return structure.build(directory, platforms, catalogue)
    fmi = libraries.FMI3 if name in (FMI3, THERMAL_FMI3) else libraries.FMI2
    if name in (THERMAL, THERMAL_FMI3):
        return native_unit.build(directory, platforms, fmi)
    return native.build(directory, platforms, fmi, catalogue)


def _made_apart(name: str, directory: Path, catalogue: Catalogue) -> Path:
    """In a process of its own, since pythonfmu imports what it builds."""
    try:
        if name == PYTHON:
            return apart(python_unit.build, directory, None, catalogue)
        from cosim.fmu.thermal import python_unit as of_heat  # scikit-fem

        return apart(of_heat.build, directory)
    except Exception as error:
        raise FmuBuildError(f"{name} was not built: {error}") from error


def _check_writable(directory: Path) -> None:
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FmuBuildError(f"{directory}: cannot be made: {error.strerror}") from error
    if not os.access(directory, os.W_OK | os.X_OK):
        raise FmuBuildError(f"{directory}: is not writable; name another folder for the FMU")
    clear_partial(directory)
