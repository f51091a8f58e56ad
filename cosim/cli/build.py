"""`stickslip build`: the FMU."""

from __future__ import annotations

from argparse import Namespace
from pathlib import Path

from cosim.cli.files import writable_folder
from cosim.fmu.build import build_fmu


def main(arguments: Namespace) -> int:
    """Build the FMU afresh and say where it is."""
    folder = writable_folder(Path(arguments.output), ["StickSlip3DOF.fmu"])
    print(build_fmu(folder))
    return 0
