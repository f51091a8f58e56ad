"""`stickslip build`: the units."""

from __future__ import annotations

from argparse import ArgumentTypeError, Namespace
from collections.abc import Sequence
from pathlib import Path

from stickslip.generation.platforms import PLATFORMS, Platform, this_machine

from cosim.cli import DONE
from cosim.names import unknown_name

UNITS = (
    *("StickSlip3DOF.fmu", "StickSlip3DOF-fmi3.fmu", "StickSlip3DOF-python.fmu"),
    *("BeltIceThermal.fmu", "BeltIceThermal-fmi3.fmu", "BeltIceThermal-python.fmu"),
    "StickSlipThermal.ssp",
)
UNIT_NAMES = ", ".join(UNITS)
PLATFORM_NAMES = ", ".join(each.name for each in PLATFORMS)
#: As `platforms` of each name that is given.
HERE = [[this_machine()]]


def unit(name: str) -> str:
    """The name of a unit."""
    if name not in UNITS:
        raise ArgumentTypeError(unknown_name("unit", name, UNITS))
    return name


def platforms(name: str) -> Sequence[Platform]:
    """The platform of a name, or all."""
    found = [each for each in PLATFORMS if name in ("all", each.name)]
    if found:
        return found
    raise ArgumentTypeError(unknown_name("platform", name, [each.name for each in PLATFORMS]))


def execute(arguments: Namespace) -> int:
    """Build the units afresh and say where they are, and for which platforms."""
    from stickslip.catalogue import default_catalogue

    from cosim.files import writable
    from cosim.fmu.build import build_fmu, own_folder, require_way
    from cosim.fmu.libraries import platforms_of

    catalogue = default_catalogue().with_files(*arguments.effects)
    units = arguments.units or UNITS
    platforms = list(dict.fromkeys(each for named in arguments.platforms for each in named))
    for name in units:
        require_way(name, platforms, catalogue)
    folder = writable(Path(arguments.output) if arguments.output else own_folder(catalogue), units)
    for name in units:
        fmu = build_fmu(folder, name, platforms, catalogue)
        print(f"{fmu}: {', '.join(platforms_of(fmu))}")
    return DONE
