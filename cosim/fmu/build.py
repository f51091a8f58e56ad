"""Builds StickSlip3DOF.fmu when it is missing or was built from something else.

What goes in is the recipe's business (`build/stickslip3dof.py` in a checkout, the same file in
`cosim/recipes` in an installed package).
"""

import importlib.util
import os
import subprocess
import sys
from functools import cache
from pathlib import Path
from types import ModuleType

HERE = Path(__file__).resolve().parents[1]
RECIPE = "stickslip3dof.py"


class FmuBuildError(ValueError):
    """The FMU cannot be built or written; the message names the folder or the reason."""


def recipe_file() -> Path:
    """The recipe: at the root of a checkout, or as the wheel carries it."""
    for folder in (HERE.parent / "build", HERE / "recipes"):
        if (folder / RECIPE).is_file():
            return folder / RECIPE
    raise FmuBuildError(
        f"{RECIPE} is neither in {HERE.parent / 'build'} nor in {HERE / 'recipes'}; "
        "reinstall the package"
    )


def ensure_fmu(directory: str | Path) -> Path:
    """The FMU in a directory, built there when it is missing, damaged or not of today's content.

    The content's hash decides, never a date. Raises FmuBuildError.
    """
    recipe = _recipe()
    fmu = Path(directory) / recipe.FMU
    if recipe.built_hash(fmu) == recipe.content_hash():
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
        [sys.executable, str(recipe_file()), str(directory.resolve())],
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode != 0:
        said = done.stderr.strip().splitlines()
        raise FmuBuildError(f"the FMU was not built: {said[-1] if said else 'no reason given'}")
    return directory / _recipe().FMU


def _check_writable(directory: Path) -> None:
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FmuBuildError(f"{directory}: cannot be made: {error.strerror}") from error
    if not os.access(directory, os.W_OK | os.X_OK):
        raise FmuBuildError(f"{directory}: is not writable; name another folder for the FMU")


@cache
def _recipe() -> ModuleType:
    spec = importlib.util.spec_from_file_location("cosim_stickslip3dof_recipe", recipe_file())
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
