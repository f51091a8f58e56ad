"""`stickslip build`: the units."""

from argparse import Namespace
from pathlib import Path

from stickslip.catalogue import default_catalogue

from cosim.cli import DONE
from cosim.cli.bar import Bar
from cosim.files import writable
from cosim.fmu.build import build_fmu, own_folder, require_way
from cosim.fmu.libraries import platforms_of
from cosim.fmu.unit_files import UNITS


def execute(arguments: Namespace) -> int:
    """Build the units afresh and say where they are, and for which platforms."""
    catalogue = default_catalogue().with_files(*arguments.effects)
    units = arguments.units or UNITS
    platforms = list(dict.fromkeys(each for named in arguments.platforms for each in named))
    for name in units:
        require_way(name, platforms, catalogue)
    folder = writable(Path(arguments.output) if arguments.output else own_folder(catalogue), units)
    with Bar(total=len(units), unit="unit") as bar:
        for name in units:
            fmu = build_fmu(folder, name, platforms, catalogue)
            bar.write(f"{fmu}: {', '.join(platforms_of(fmu))}")
            bar.update()
    return DONE
