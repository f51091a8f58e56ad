"""`stickslip build`: the FMU."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from pathlib import Path

from cosim.cli import DONE
from cosim.cli.arguments import add_output

EXAMPLE = "stickslip build -o fmus"
FMU = "StickSlip3DOF.fmu"


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    add_output(
        parser, "folder of the FMU (default: build of a checkout, else the user's cache folder)"
    )
    parser.add_argument("--fmi", choices=["2"], default="2", help="version of FMI (default: 2)")


def refused() -> tuple[type[Exception], ...]:
    """What is bad input."""
    from cosim.files import OutputRefused

    return (OutputRefused,)


def execute(arguments: Namespace) -> int:
    """Build the FMU afresh and say where it is."""
    from cosim.files import writable
    from cosim.fmu.build import build_fmu, own_folder

    folder = Path(arguments.output) if arguments.output else own_folder()
    print(build_fmu(writable(folder, [FMU])))
    return DONE
