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
from cosim.systems.system_errors import SystemFault, table_of


def read_ssp(path: Path, changes: Mapping[str, Any]) -> SystemSpecification:
    """The system in an SSP, or in a folder or structure file of the same contents.

    changes: `table.key` -> value of the tables [coupling] and [run], which an SSP does not have.
    Raises SystemFault in one line: file, element, what is wrong, what is allowed.
    """
    held = ExitStack()
    try:
        package = Package(path)
        held.callback(package.close)
        return _specified(package, changes, held)
    except SystemFault as fault:
        held.close()
        line = str(fault)
        raise SystemFault(line if line.startswith(str(path)) else f"{path}: {line}") from None
    except BaseException:
        held.close()
        raise


def _specified(
    package: Package, changes: Mapping[str, Any], held: ExitStack
) -> SystemSpecification:
    root = package.xml(package.structure)
    structure = read_structure(root, package.structure)
    flat = Flat(structure, package)
    coupling, run = _tables(structure, changes)
    units = flat.units()
    if not units:
        raise SystemFault(f"{package.structure}: has no component, needed is one at least")
    return SystemSpecification(
        name=structure.name,
        source=str(package.path),
        units=units,
        links=flat.links(),
        coupling=coupling,
        run=run,
        text=tostring(root, encoding="unicode"),
        remarks=(*package.remarks, *_variants(package)),
        _held=held,
    )


def _variants(package: Package) -> list[str]:
    return [
        f"{package.path}: {name} is another variant; {package.structure} is run"
        for name in package.others()
    ]


def _tables(structure: Structure, changes: Mapping[str, Any]) -> tuple[Coupling, Run]:
    """What the file says of step and time, and what it is changed to."""
    tables: dict[str, dict[str, Any]] = {"coupling": {}, "run": {}}
    for table, key, value in (
        ("coupling", "macro_step", structure.step),
        ("run", "start", structure.start),
        ("run", "stop", structure.stop),
    ):
        if value is not None:
            tables[table][key] = value
    for name, value in changes.items():
        table, _, key = name.partition(".")
        if table not in tables:
            raise SystemFault(f"{name}: cannot be set here, allowed are keys of coupling and run")
        tables[table][key] = value
    return (
        table_of(Coupling, tables["coupling"], "coupling"),
        table_of(Run, tables["run"], "run"),
    )
