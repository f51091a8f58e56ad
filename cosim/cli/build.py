"""`stickslip build`: the FMU."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from cosim.cli.files import writable_folder
from cosim.fmu.build import build_fmu, own_folder


def main(arguments: Namespace) -> int:
    """Build the FMU afresh and say where it is."""
    named = Path(arguments.output) if arguments.output else own_folder()
    folder = writable_folder(named, ["StickSlip3DOF.fmu"])
    print(build_fmu(folder))
    return 0
