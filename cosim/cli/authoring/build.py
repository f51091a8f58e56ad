"""`stickslip build`: the units."""

from __future__ import annotations

from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Sequence
from pathlib import Path

from stickslip.generation.platforms import PLATFORMS, Platform, this_machine

from cosim.cli import DONE
from cosim.cli.arguments import add_output
from cosim.names import unknown_name

EXAMPLE = "stickslip build StickSlip3DOF.fmu -o fmus"
UNITS = (
    *("StickSlip3DOF.fmu", "StickSlip3DOF-fmi3.fmu", "StickSlip3DOF-python.fmu"),
    *("BeltIceThermal.fmu", "BeltIceThermal-fmi3.fmu", "BeltIceThermal-python.fmu"),
    "StickSlipThermal.ssp",
)


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    parser.add_argument(
        "units",
        nargs="*",
        type=_unit,
        metavar="UNIT",
        help=f"one of {', '.join(UNITS)} (default: all)",
    )
    parser.add_argument(
        "--platforms",
        nargs="+",
        type=_platforms,
        default=[[this_machine()]],
        metavar="PLATFORM",
        help="that a native unit is to have libraries for, as far as there is a compiler: "
        f"{', '.join(each.name for each in PLATFORMS)}, or all (default: this machine's)",
    )
    parser.add_argument(
        "--effects",
        nargs="+",
        default=(),
        metavar="FILE.py",
        help="custom effects that the units of the block are to have behind the catalogue's; "
        "their code is run. The default folder is then one of their own in the user's cache",
    )
    add_output(
        parser, "folder of the units (default: build of a checkout, else the user's cache folder)"
    )


def _unit(name: str) -> str:
    if name not in UNITS:
        raise ArgumentTypeError(unknown_name("unit", name, UNITS))
    return name


def _platforms(name: str) -> Sequence[Platform]:
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
