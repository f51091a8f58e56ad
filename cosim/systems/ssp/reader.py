"""An SSP file as a system to be run."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import tostring

from cosim.systems.specification import Coupling, Run, SystemSpecification
from cosim.systems.ssp.flat import Flat
from cosim.systems.ssp.package import Package
from cosim.systems.ssp.structure import tables_of, top_of, units_of
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
        with naming(package.structure):
            top, definitions, said = top_of(root), units_of(root, "ssd"), tables_of(root)
        flat = Flat(top, definitions, package)
        tables = changed(said, changes)
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
            name=root.get("name") or top.node.get("name") or "system",
            source=str(path),
            units=units,
            links=flat.links(),
            coupling=coupling,
            run=run,
            text=tostring(root, encoding="unicode"),
            remarks=(*package.remarks, *variants),
            _held=unpacked.pop_all(),
        )
