"""What arguments are made of: types, names and defaults that `commands.toml` calls by their names.

Beside the modules that compute, so that a command's help is there without them.
"""

import keyword
import os
import re
from argparse import ArgumentTypeError
from collections.abc import Sequence
from pathlib import Path

from stickslip.generation.platforms import PLATFORMS, Platform, this_machine

from cosim.cores import CORES as CORES
from cosim.fmu.unit_files import UNITS
from cosim.names import unknown_name

#: As a FILE of --json: standard output.
STDOUT = "-"
UNIT_NAMES = ", ".join(UNITS)
PLATFORM_NAMES = ", ".join(each.name for each in PLATFORMS)
#: As `platforms` of each name that is given.
HERE = [[this_machine()]]
CAMPAIGNS = Path(__file__).parents[1] / "gap" / "campaigns"
#: Names of the campaigns that ship with the package.
PACKAGED = sorted(file.stem for file in CAMPAIGNS.glob("*.toml"))
CAMPAIGNS_HERE = ", ".join(PACKAGED)


def folder(text: str) -> str:
    """A folder's name; an empty one, such as of a shell's unset variable, is none."""
    if not text.strip():
        raise ArgumentTypeError("'' is no name of a folder, allowed is one such as results")
    return text


def json_file(text: str) -> str:
    """A file's name; not that of a scenario, an effect or a claim, which may have been meant."""
    if text != STDOUT and not re.search(r"[./\\]", text) and not os.path.exists(text):
        raise ArgumentTypeError(
            f"{text} is no name of a file, allowed is one such as {text}.json; what is to be "
            "computed goes in front of --json"
        )
    return text


def effect_file(name: str) -> Path:
    """A file whose name an effect can have."""
    path = Path(name)
    wrong = not re.fullmatch(r"[a-z][a-z0-9_]*", path.stem) or keyword.iskeyword(path.stem)
    if path.suffix != ".py" or wrong:
        raise ArgumentTypeError(
            f"{name!r} is not allowed, allowed is a name of small letters, digits and _ that "
            "begins with a letter, and ends in .py"
        )
    return path


def unit(name: str) -> str:
    """The name of a unit."""
    if name not in UNITS:
        raise ArgumentTypeError(unknown_name("unit", name, UNITS))
    return name


def platforms(name: str) -> Sequence[Platform]:
    """The platform of a name, or all."""
    if found := [each for each in PLATFORMS if name in ("all", each.name)]:
        return found
    raise ArgumentTypeError(unknown_name("platform", name, [each.name for each in PLATFORMS]))


def number_or_air(text: str) -> float | None:
    """A number; None for what a belt gives to still air by moving through it."""
    try:
        return None if text == "air" else float(text)
    except ValueError:
        raise ArgumentTypeError(f"{text}: allowed is a number in W/m2K, or air") from None


def count(text: str) -> int:
    """A number of processes."""
    number = whole(text)
    if number < 1:
        raise ArgumentTypeError(f"{text} is not allowed, allowed is 1 or more")
    return number


def whole(text: str) -> int:
    """A whole number from 0."""
    if not text.isdecimal():
        raise ArgumentTypeError(f"{text!r} is not allowed, allowed is a whole number from 0")
    return int(text)


def chance(text: str) -> float:
    """A chance, neither 0 nor 1."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < 1.0:
        raise ArgumentTypeError(f"{text!r} is not allowed, allowed is a number between 0 and 1")
    return value
