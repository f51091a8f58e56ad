"""Builds StickSlip3DOF.fmu when it is missing or was built from something else."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import platformdirs
import stickslip

import cosim

from . import stickslip3dof

#: Folder of a checkout in which its FMU stands, beside the recipe.
BUILD_FOLDER = Path("build")


class FmuBuildError(ValueError):
    """The FMU cannot be built or written; the message names the folder or the reason."""


def own_folder() -> Path:
    """Where the FMU stands that nobody named: `build` of a checkout, else the user's cache."""
    if (BUILD_FOLDER / "stickslip3dof.py").is_file():
        return BUILD_FOLDER
    return platformdirs.user_cache_path("stickslip")


def own_fmu() -> Path:
    """The FMU in `own_folder`, fresh; where that cannot be written, in the cache or a scratch
    folder."""
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
    """The FMU in a directory, built there when it is missing, damaged or not of today's content.

    The content's hash decides, never a date. Raises FmuBuildError.
    """
    fmu = Path(directory) / stickslip3dof.FMU
    if stickslip3dof.built_hash(fmu) == stickslip3dof.content_hash():
        return fmu
    return build_fmu(directory)


def build_fmu(directory: str | Path) -> Path:
    """Build the FMU in a directory, which is made when it does not exist; its path.

    In a process of its own, since pythonfmu imports what it builds. The file appears at once and
    whole. Raises FmuBuildError in one line.
    """
    directory = Path(directory)
    _check_writable(directory)
    done = subprocess.run(
        [sys.executable, "-P", "-m", stickslip3dof.__name__, str(directory.resolve())],
        capture_output=True,
        text=True,
        check=False,
        env=os.environ | {"PYTHONPATH": _packages()},
    )
    if done.returncode != 0:
        said = done.stderr.strip().splitlines()
        raise FmuBuildError(f"the FMU was not built: {said[-1] if said else 'no reason given'}")
    return directory / stickslip3dof.FMU


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
