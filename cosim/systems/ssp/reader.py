"""An SSP file as a system to be run."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import tostring

from cosim.systems.settings import Coupling, Run
from cosim.systems.specification import SystemSpecification
from cosim.systems.ssp.flat import Flat
from cosim.systems.ssp.package import Package
from cosim.systems.ssp.structure import Structure, read_structure
from cosim.systems.system_errors import SystemFault, changed, naming, table_of


def read_ssp(path: Path, changes: Mapping[str, Any]) -> SystemSpecification:
    """The system in an SSP, or in a folder or structure file of the same contents.

    changes: `table.key` -> value of the tables [coupling] and [run], which an SSP does not have.
    Raises SystemFault in one line: file, element, what is wrong, what is allowed.
    """
    with ExitStack() as unpacked, naming(str(path)):
        package = Package(path)
        unpacked.callback(package.close)
        root = package.xml(package.structure)
        structure = read_structure(root, package.structure)
        flat = Flat(structure, package)
        tables = changed(_tables(structure), changes)
        coupling = table_of(Coupling, tables["coupling"], "coupling")
        run = table_of(Run, tables["run"], "run")
        units = flat.units()
        if not units:
            raise SystemFault(f"{package.structure}: has no component, needed is one at least")
        variants = [
            f"{path}: {name} is another variant; {package.structure} is run"
            for name in package.others()
        ]
        return SystemSpecification(
            name=structure.name,
            source=str(path),
            units=units,
            links=flat.links(),
            coupling=coupling,
            run=run,
            text=tostring(root, encoding="unicode"),
            remarks=(*package.remarks, *variants),
            _held=unpacked.pop_all(),
        )


def _tables(structure: Structure) -> dict[str, Any]:
    """What the file says of step and time."""
    told = {
        "coupling": {"macro_step": structure.step},
        "run": {"start": structure.start, "stop": structure.stop},
    }
    return {
        table: {key: value for key, value in entries.items() if value is not None}
        for table, entries in told.items()
    }
