"""BeltIceThermal.fmu: the reduced heat model in C, with the functions of FMI around it.

The library is the same whatever belt and ice are: it is compiled without the heat model at hand, as
where a wheel is made. Their matrices are a file in the unit's resources.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from stickslip.generation.platforms import PLATFORMS, Platform
from stickslip.quantity import details

import cosim
from cosim.files import write_bytes
from cosim.fmu import c_tables, native
from cosim.fmu.archive import digest_of, guid_of, packed
from cosim.fmu.description import UnitFacts
from cosim.fmu.libraries import FMI2, FMI3, of_platforms
from cosim.fmu.thermal.variables import DESCRIPTION, ERRORS, NAME, STARTS, reduced
from cosim.fmu.variables import Variable, names

if TYPE_CHECKING:  # the heat model needs scikit-fem
    from thermal import ThermalParameters
    from thermal.reduction import Reduction

FMU = f"{NAME}.fmu"
#: Version of FMI -> file.
FILES = {FMI2: FMU, FMI3: f"{NAME}-fmi3.fmu"}
#: Files that make the sources, and the heat model that the matrices are of.
MAKERS = (
    *map(Path(__file__).with_name, ("native_unit.py", "variables.py", "variables.toml")),
    Path(c_tables.__file__),
)
CAN = {"HAS_EXCHANGE": False, "TAKES_RATES": False, "BEGINS_WITH_INPUTS": False}
#: Of the C of every unit, what is for model exchange.
NOT_NEEDED = ("exchange.c", "fmi2_exchange.c", "fmi3_exchange.c")


@cache
def sources() -> dict[str, bytes]:
    """File name -> content of everything that the library is compiled from."""
    declared = reduced()
    made = {
        "variables.h": _header(),
        "variables.c": "\n".join([c_tables.MADE, *c_tables.table_lines(declared)]),
    }
    return _written() | {name: content.encode() for name, content in made.items()}


def _header() -> str:
    declared = reduced()
    lines = c_tables.count_lines(declared, guid(), CAN)
    lines += ["#define STATE_COUNT 0", "#define INDICATOR_COUNT 0", ""]
    for causality, prefix in (("input", "IN"), ("output", "OUT")):
        places = [f"{prefix}_{name.upper()}" for name in names(declared, causality)]
        lines.append(f"enum {{ {', '.join(places)} }};")
    return c_tables.guarded("VARIABLES_H", lines)


def _written() -> dict[str, bytes]:
    shared = native.written("beltice")
    return {name: content for name, content in shared.items() if name not in NOT_NEEDED}


@cache
def guid() -> str:
    """The GUID of a unit built now: of its C, its variables and the heat model's code."""
    # the package `thermal` is not imported: it needs scikit-fem
    heat = Path(cosim.__path__[0]).parent / "thermal"
    files = {file.relative_to(heat).as_posix(): file for file in heat.rglob("*.py")}
    made_from = {
        "variables": json.dumps([asdict(each) for each in reduced()], sort_keys=True).encode(),
        **{f"maker/{file.name}": file.read_bytes() for file in MAKERS},
        **{f"thermal/{name}": file.read_bytes() for name, file in files.items()},
        **_written(),
    }
    return guid_of(NAME, digest_of(made_from).hexdigest())


def build(directory: Path, platforms: Sequence[Platform], fmi: int = FMI2) -> Path:
    """Make the unit of the reference scenario for a version of FMI in a directory, with libraries
    for platforms.

    Raises CompilerError where there is a way to none.
    """
    from cosim.fmu.thermal.reference_run import reference_parameters  # scikit-fem

    return build_for(reference_parameters(), directory / FILES[fmi], platforms, fmi)


def build_for(
    parameters: ThermalParameters,
    target: Path,
    platforms: Sequence[Platform] = PLATFORMS,
    fmi: int = FMI2,
) -> Path:
    """Make a unit of any belt and ice."""
    from cosim.fmu.thermal import reference_run, resources  # scikit-fem

    made = resources.reduction(parameters)
    declared = reduced(resources.starts(made))
    facts = _facts(fmi)
    files = native.of_version(facts, declared, sources(), fmi)
    files[f"resources/{resources.FILE}"] = resources.packed(made)
    files["documentation/index.html"] = _documentation(made, declared, fmi)
    files |= reference_run.of_heat(parameters, declared)
    files |= of_platforms(guid(), sources, platforms, NAME, fmi)
    return write_bytes(packed(files), target)


def _documentation(made: Reduction, declared: Sequence[Variable], fmi: int) -> bytes:
    from cosim.fmu.description.documentation import allowed
    from cosim.fmu.thermal.reference_run import EXPERIMENT
    from cosim.report.page import render

    page = render(
        "documentation.html.j2",
        "cosim.fmu.thermal",
        facts=_facts(fmi),
        fmi=fmi,
        variables=declared,
        allowed=allowed,
        fixed=_fixed(made.parameters, {each.name for each in declared}),
        errors=ERRORS,
        reference=EXPERIMENT,
        belt=made.belt.face.size,
        ice=made.ice.contact.size,
        cells=made.parameters.belt.cells,
        strips=made.parameters.contact.strips,
    )
    return page.encode()


def _fixed(parameters: ThermalParameters, free: set[str]) -> list[tuple[str, str, str, str]]:
    """Key, value, unit and meaning of what is in the matrices: all that is no parameter.

    Railing and rollers are left out: a reduced belt has none.
    """
    free |= {"belt.still_air_speed"}  # of which follows a heat transfer, which is free
    rows = []
    for name, table in parameters:
        for key, field in type(table).model_fields.items():
            value = getattr(table, key)
            absent = key.startswith(("railing", "roller"))
            if f"{name}.{key}" not in free and not absent and value not in ("", ()):
                said = f"{value:g}" if isinstance(value, int | float) else str(value)
                unit, meaning = details(field).get("unit", ""), field.description or ""
                rows.append((f"{name}.{key}", said, unit, meaning))
    return rows


def _facts(fmi: int) -> UnitFacts:
    return UnitFacts(
        name=NAME,
        guid=guid(),
        description=f"{DESCRIPTION}. Modes of the finite elements",
        sources=native.compiled_in(sources(), fmi),
        interpolates=False,
        gives_rates=False,
        starts=STARTS,
    )
