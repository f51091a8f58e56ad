"""How content becomes a unit by way of pythonfmu; StickSlip3DOF-python.fmu is made of this.

The same content gives the same FMU, byte for byte. A build is known by the hash of its content, and
the Python modules inside carry that hash in their names: a process keeps one module of a name, so
two builds in it would otherwise run the code of the one that came first.

What travels inside StickSlip3DOF is pure Python of the standard library: the slave, the kernel as
`stickslip.generation.source` makes it, and how named parameters and random numbers enter it. The
effects' declarations stay behind, and pydantic with them.
"""

import json
import pprint
import re
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from importlib.metadata import version
from pathlib import Path
from typing import Any

from stickslip import ports, units
from stickslip.catalogue import CATALOGUE, Catalogue
from stickslip.generation.source import one_kernel, travelling
from stickslip.kernel import layout
from stickslip.scratch import scratch_folder

from cosim.files import write_bytes
from cosim.fmu import description
from cosim.fmu.archive import digest_of, extras, guid_of, packed
from cosim.fmu.description import UnitFacts, fmi2_description
from cosim.fmu.description.documentation import of_mechanics
from cosim.fmu.native import DESCRIPTION, NAME
from cosim.fmu.pythonfmu_library import corrected
from cosim.fmu.variables import WATCHED, Variable, variables

FMU = "StickSlip3DOF-python.fmu"
MODULE = "stickslip3dof"
PACKAGE_DOC = '"""The mechanics of StickSlip3DOF, as it travels inside the FMU."""\n'
#: What pythonfmu loads, in whatever Python its host has: nothing newer than the check may come
#: before it. The library runs it again for every instance and keeps for ever the classes that it
#: defines, so it defines none.
DOOR = Path(__file__).with_name("door.txt")


def door(name: str, package: str, least: int, host: str, needs: str = "") -> bytes:
    """The module that pythonfmu loads of a package's slave.

    least: of 3.x; host, needs: in words and as code, what else the host's Python must be.
    """
    told = {"name": name, "package": package, "least": least, "host": host, "needs": needs}
    return DOOR.read_text(encoding="utf-8").format(**told).encode()


def sources(catalogue: Catalogue = CATALOGUE) -> dict[str, bytes]:
    """Path inside the FMU's resources -> content, before anything is renamed."""
    texts = {
        "stickslip/__init__.py": PACKAGE_DOC,
        "stickslip/unit_slave.py": slave_file("unit_slave").read_text(encoding="utf-8"),
        "stickslip/slave.py": one_kernel(slave_file("slave").read_text(encoding="utf-8")),
    }
    texts |= {f"stickslip/{name}.py": text for name, text in travelling(catalogue.effects).items()}
    files = {name: text.encode() for name, text in texts.items()}
    return files | {f"{MODULE}.py": door(NAME, "stickslip", 10, "is new enough")}


def slave_file(name: str) -> Path:
    """A module that travels: in fmu_src in a checkout, beside this file in a package."""
    here = Path(__file__).resolve()
    checkout = here.parents[2] / "fmu_src" / f"{name}.py"
    return checkout if checkout.is_file() else here.with_name(f"{name}.py")


#: Files that an FMU also depends on, though they do not travel.
RECIPE_FILES = (
    Path(__file__),
    *map(
        Path(__file__).with_name,
        ("pythonfmu_library.py", "pythonfmu.toml", "variables.py", "variables.toml"),
    ),
    Path(units.__file__).with_name("units.toml"),
    Path(description.__file__),
    *sorted(Path(description.__file__).parent.glob("*.xml.j2")),
    Path(ports.__file__).with_name("ports.toml"),
    Path(__file__).parent / "thermal" / "python_unit.py",
)
#: What a slave is told of a variable, and beside it where the slave has it.
TOLD = "name causality type start min max above_min nominal is_tunable".split()


def build(
    directory: Path, files: dict[str, bytes] | None = None, catalogue: Catalogue = CATALOGUE
) -> Path:
    """Make the FMU in a directory and return its path; other content than ours for tests."""
    declared = variables(catalogue)
    places = {each.name: getattr(layout, each.slot) for each in declared if each.slot}
    places |= {each.name: layout.O_SIZE + place for place, each in enumerate(WATCHED)}
    said = f"{DESCRIPTION}. For hosts with a Python of 3.10 or newer"
    files = sources(catalogue) if files is None else files
    facts, raw = by_pythonfmu(NAME, said, files, (MODULE, "stickslip"), declared, places)
    made = finished(raw, facts, declared, of_mechanics(NAME, declared, catalogue))
    return write_bytes(made, directory / FMU)


def by_pythonfmu(
    name: str,
    said: str,
    files: dict[str, bytes],
    top: tuple[str, str],
    declared: Sequence[Variable],
    places: Mapping[str, Any],
    **more: Any,
) -> tuple[UnitFacts, dict[str, bytes]]:
    """What pythonfmu makes of a slave: path in the unit -> content; and what the unit says of it.

    said, more: of that. files: path inside the resources -> content. top: names of the door and of
    the package of all else that travels, without the hash; its module `variables`, which is made
    here, tells the slave what it is. places: input or output -> where the slave has it.
    """
    from pythonfmu import FmuBuilder

    content = _hash_of(files, declared)
    tool = f"stickslip, pythonfmu {version('pythonfmu')}"
    facts = UnitFacts(name, guid_of(name, content), said, tool=tool, python=True, **more)
    module, package = top
    told = _variables_module(content, facts.guid, declared, places)
    hashed = {each: f"{each}_{content}" for each in top}
    with scratch_folder(module) as folder:
        scratch = Path(folder)
        for file, source in (files | {f"{package}/variables.py": told}).items():
            target = scratch / _renamed(file, hashed)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(_rename_imports(source, package, hashed[package]))
        unit = FmuBuilder.build_FMU(
            scratch / f"{hashed[module]}.py",
            dest=scratch / "raw.fmu",
            project_files=[scratch / hashed[package]],
            needsExecutionTool=True,
            canGetAndSetFMUstate=True,
            canSerializeFMUstate=True,
        )
        with zipfile.ZipFile(unit) as archive:
            return facts, {file: archive.read(file) for file in archive.namelist()}


def _hash_of(files: Mapping[str, bytes], declared: Sequence[Variable]) -> str:
    """Twelve hex digits over everything that a unit is made of."""
    recipe = {f"{file.parent.name}/{file.name}": file.read_bytes() for file in RECIPE_FILES}
    digest = digest_of(dict(files) | recipe)
    digest.update(json.dumps([asdict(each) for each in declared], sort_keys=True).encode())
    digest.update(version("pythonfmu").encode())
    return digest.hexdigest()[:12]


def _renamed(name: str, names: dict[str, str]) -> Path:
    path = Path(name)
    first = names[path.parts[0].removesuffix(".py")]
    return Path(first + ".py") if len(path.parts) == 1 else Path(first, *path.parts[1:])


def _rename_imports(source: bytes, package: str, name: str) -> bytes:
    pattern = rf"(?m)^(\s*(?:from|import)\s+){package}\b".encode()
    return re.sub(pattern, rb"\1" + name.encode(), source)


def finished(
    raw: dict[str, bytes],
    facts: UnitFacts,
    declared: Sequence[Variable],
    documentation: dict[str, bytes],
) -> bytes:
    """The unit that pythonfmu made with its full description, and corrected libraries."""
    libraries = {name for name in raw if name.startswith("binaries/")}
    if not libraries:
        raise ValueError(
            "pythonfmu has no libraries to put into the unit; it was imported from inside "
            "another FMU, so build in a process that has loaded none"
        )
    files = raw | {name: corrected(raw[name]) for name in libraries}
    files["modelDescription.xml"] = fmi2_description(facts, declared)
    return packed(files | documentation | extras(others=["pythonfmu"]))


def _variables_module(
    content: str, guid: str, declared: Sequence[Variable], places: Mapping[str, Any]
) -> bytes:
    """Text of the module that tells a slave what it is; ``content``: hash of the build."""
    told = [
        {key: getattr(each, key) for key in TOLD} | {"place": places.get(each.name)}
        for each in declared
    ]
    values = {"BUILD": content, "GUID": guid, "VARIABLES": told}
    lines = ['"""What this build of the unit is, its ports and its parameters."""']
    for name, value in values.items():
        lines.append(f"{name} = {pprint.pformat(value, width=100, sort_dicts=False)}")
    return "\n".join(lines).encode() + b"\n"
