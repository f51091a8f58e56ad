"""The units by their names: built where they are asked for, and again when they are stale."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import platformdirs
import stickslip

import cosim
from cosim.fmu import native, python_unit
from cosim.fmu.compiler import CompilerError
from cosim.fmu.platforms import PLATFORMS, Platform, this_platform

#: Folder of a checkout in which its units stand, beside the recipes.
BUILD_FOLDER = Path("build")
NATIVE, PYTHON = f"{native.NAME}.fmu", python_unit.FMU
UNITS = (NATIVE, PYTHON)


class FmuBuildError(ValueError):
    """A unit cannot be built or written; the message names the folder or the reason."""


def own_folder() -> Path:
    """Where the units stand that nobody named: `build` of a checkout, else the user's cache."""
    if (BUILD_FOLDER / "units.py").is_file():
        return BUILD_FOLDER
    return platformdirs.user_cache_path("stickslip")


def own_fmu() -> Path:
    """The native unit in `own_folder`, fresh; where that cannot be written, in the cache or a
    scratch folder."""
    for place in dict.fromkeys((own_folder(), platformdirs.user_cache_path("stickslip"))):
        try:
            return ensure_fmu(place)
        except FmuBuildError as error:
            refused = error  # the last is told
    try:
        return ensure_fmu(tempfile.mkdtemp(prefix="stickslip-"))
    except (FmuBuildError, OSError):
        raise refused from None


def ensure_fmu(directory: str | Path) -> Path:
    """The native unit in a directory, built there when it is missing, damaged or stale.

    Its GUID decides, never a date. What is built has a library for this machine. Raises
    FmuBuildError.
    """
    fmu = Path(directory) / NATIVE
    if native.built_guid(fmu) == native.guid() and native.runs_here(fmu):
        return fmu
    own = this_platform()
    return build_fmu(directory, platforms=PLATFORMS if own is None else [own])


def build_fmu(
    directory: str | Path, name: str = NATIVE, platforms: Sequence[Platform] = PLATFORMS
) -> Path:
    """Build a unit of `UNITS` in a directory, which is made when it does not exist; its path.

    platforms : of a native unit, those that it is to have libraries for, as far as there is a
    compiler for them. The file appears at once and whole. Raises FmuBuildError in one line.
    """
    directory = Path(directory)
    _check_writable(directory)
    if name == PYTHON:
        return _build_python_unit(directory)
    try:
        return native.build(directory, platforms)
    except CompilerError as error:
        raise FmuBuildError(f"{name} was not built: {error}") from error


def _build_python_unit(directory: Path) -> Path:
    """In a process of its own, since pythonfmu imports what it builds."""
    done = subprocess.run(
        [sys.executable, "-P", "-m", python_unit.__name__, str(directory.resolve())],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | {"PYTHONPATH": _packages()},
    )
    if done.returncode != 0:
        said = done.stderr.strip().splitlines()
        raise FmuBuildError(f"{PYTHON} was not built: {said[-1] if said else 'no reason given'}")
    return directory / PYTHON


def _packages() -> str:
    """Where the packages of this process lie, for one that is to import the same."""
    homes = [str(Path(package.__path__[0]).parent) for package in (cosim, stickslip)]
    return os.pathsep.join([*homes, *filter(None, [os.environ.get("PYTHONPATH")])])


def _check_writable(directory: Path) -> None:
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FmuBuildError(f"{directory}: cannot be made: {error.strerror}") from error
    if not os.access(directory, os.W_OK | os.X_OK):
        raise FmuBuildError(f"{directory}: is not writable; name another folder for the FMU")
