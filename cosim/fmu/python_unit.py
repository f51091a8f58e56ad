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
from collections.abc import Sequence
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
from cosim.fmu.archive import digest_of, guid_of, packed
from cosim.fmu.description import UnitFacts, fmi2_description
from cosim.fmu.description.documentation import of_mechanics
from cosim.fmu.extras import extras
from cosim.fmu.native import DESCRIPTION, NAME
from cosim.fmu.pythonfmu_library import corrected
from cosim.fmu.variables import TUNABLE, WATCHED, Entry, Variable, parameter_table, variables

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
)


def content_hash(files: dict[str, bytes] | None = None, table: list[Entry] | None = None) -> str:
    """Twelve hex digits over everything that an FMU built now would be made of."""
    files = sources() if files is None else files
    table = parameter_table() if table is None else table
    recipe = {f"recipe/{file.name}": file.read_bytes() for file in RECIPE_FILES}
    return hash_of(files | recipe, table)


def hash_of(files: dict[str, bytes], table: list[Any]) -> str:
    """Twelve hex digits over files and declarations, and pythonfmu."""
    digest = digest_of(files)
    digest.update(json.dumps(table, sort_keys=True).encode())
    digest.update(version("pythonfmu").encode())
    return digest.hexdigest()[:12]


def build(
    directory: Path, files: dict[str, bytes] | None = None, catalogue: Catalogue = CATALOGUE
) -> Path:
    """Make the FMU in a directory and return its path; other content than ours for tests."""
    files = sources(catalogue) if files is None else files
    table, declared = parameter_table(catalogue), variables(catalogue)
    content = content_hash(files, table)
    said = f"{DESCRIPTION}. For hosts with a Python of 3.10 or newer"
    files = files | {"stickslip/variables.py": variables_module(table, content)}
    raw = by_pythonfmu(files, MODULE, "stickslip", content)
    documentation = of_mechanics(NAME, declared, catalogue)
    made = finished(raw, facts_of(NAME, content, said), declared, documentation)
    return write_bytes(made, directory / FMU)


def by_pythonfmu(
    files: dict[str, bytes], module: str, package: str, content: str
) -> dict[str, bytes]:
    """What pythonfmu makes of a slave: path in the unit -> content.

    files: path inside the resources -> content, with the package's module `variables`, which tells
    the slave what it is. module: name of the door, without the hash; package: of all else that
    travels; content: the hash.
    """
    from pythonfmu import FmuBuilder

    hashed = {name: f"{name}_{content}" for name in (module, package)}
    with scratch_folder(module) as folder:
        scratch = Path(folder)
        for name, source in files.items():
            target = scratch / _renamed(name, hashed)
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
            return {name: archive.read(name) for name in archive.namelist()}


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


def facts_of(name: str, content: str, said: str, **more: Any) -> UnitFacts:
    """Of a unit by way of pythonfmu, by the hash of its content."""
    tool = f"stickslip, pythonfmu {version('pythonfmu')}"
    return UnitFacts(name, guid_of(name, content), said, tool=tool, python=True, **more)


def variables_module(table: list[Entry], content: str) -> bytes:
    """Text of the module that tells the slave what it is; ``content``: hash of the build."""
    values = {
        "BUILD": content,
        "GUID": guid_of(NAME, content),
        # (name, place in u, start, min, max, nominal) and (name, place in o, type)
        "INPUTS": [
            (each.name, getattr(layout, each.slot), each.start, each.min, each.max, each.nominal)
            for each in ports.INPUTS
        ],
        "OUTPUTS": [
            *(
                (each.name, getattr(layout, each.slot), "Integer" if each.unit is None else "Real")
                for each in ports.OUTPUTS
            ),
            *((each.name, layout.O_SIZE + place, "Boolean") for place, each in enumerate(WATCHED)),
        ],
        "PARAMETERS": table,
        "TUNABLE": TUNABLE,
    }
    return module_of(values)


def module_of(values: dict[str, Any]) -> bytes:
    """Text of a module with these names, which tells a slave what it is."""
    lines = ['"""What this build of the unit is, its ports and its parameters."""']
    for name, value in values.items():
        lines.append(f"{name} = {pprint.pformat(value, width=100, sort_dicts=False)}")
    return "\n".join(lines).encode() + b"\n"
