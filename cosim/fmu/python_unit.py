"""StickSlip3DOF-python.fmu: how its content becomes a unit, by way of pythonfmu.

The same content gives the same FMU, byte for byte. A build is known by the hash of its content, and
the Python modules inside carry that hash in their names: a process keeps one module of a name, so
two builds in it would otherwise run the code of the one that came first.

What travels inside is pure Python of the standard library: the slave, the kernel as
`stickslip.generation.source` makes it, and how named parameters and random numbers enter it. The
effects' declarations stay behind, and pydantic with them.
"""

from __future__ import annotations

import hashlib
import json
import pprint
import re
import sys
import tempfile
import uuid
import zipfile
import zlib
from importlib import resources
from importlib.metadata import version
from pathlib import Path

from stickslip import ports
from stickslip.generation.source import kernel_source
from stickslip.kernel import layout
from stickslip.names import NAMES

from cosim.files import write_bytes
from cosim.fmu.archive import packed
from cosim.fmu.model_description import UnitFacts, fmi2_description
from cosim.fmu.native import DESCRIPTION, NAME
from cosim.fmu.pythonfmu_library import corrected
from cosim.fmu.variables import TUNABLE, Entry, parameter_table, variables

FMU = "StickSlip3DOF-python.fmu"
MODULE = "stickslip3dof"
#: Beside the kernel's text: files of the package `stickslip` as they are, but for where the names
#: of the kernel come from.
AS_THEY_ARE = ("contradictions.py", "draws.py", "packing.py", "status.py")
PACKAGE_DOC = '"""The mechanics of StickSlip3DOF, as it travels inside the FMU."""\n'
#: What pythonfmu loads, in whatever Python its host has: nothing newer than the check may come
#: before it. The library runs it again for every instance and keeps for ever the classes that it
#: defines, so it defines none.
DOOR = '''"""StickSlip3DOF, for hosts with a Python that is new enough."""

import sys

if sys.version_info < (3, 10):
    raise ImportError(
        "StickSlip3DOF needs Python 3.10 or newer, this host has %d.%d" % sys.version_info[:2]
    )

import ctypes

from stickslip.slave import StickSlip3DOF

# pythonfmu's library runs this file for every instance, with locals of its own, and then drops a
# reference to the globals that it never had. This is that reference.
if locals() is not globals():
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(globals()))
'''
_KERNEL = re.compile(r"(?m)^from (\.|stickslip\.)kernel\.[\w.]+ import")


def sources() -> dict[str, bytes]:
    """Path inside the FMU's resources -> content, before anything is renamed."""
    texts = {
        f"{MODULE}.py": DOOR,
        "stickslip/__init__.py": PACKAGE_DOC,
        "stickslip/slave.py": slave_file().read_text(encoding="utf-8"),
        "stickslip/kernel.py": kernel_source(),
        "stickslip/names.py": _names(),
    }
    for name in AS_THEY_ARE:
        texts[f"stickslip/{name}"] = (resources.files("stickslip") / name).read_text("utf-8")
    return {
        name: _KERNEL.sub(r"from \1kernel import", text).encode() for name, text in texts.items()
    }


def slave_file() -> Path:
    """The slave: in fmu_src in a checkout, beside this file in an installed package."""
    here = Path(__file__).resolve()
    checkout = here.parents[2] / "fmu_src" / "slave.py"
    return checkout if checkout.is_file() else here.with_name("slave.py")


def _names() -> str:
    head = '"""Names of the parameters in the order of the kernel\'s array ``v``."""'
    return f"{head}\n\nNAMES = {NAMES}\n"


#: Files that an FMU also depends on, though they do not travel.
RECIPE_FILES = (
    Path(__file__),
    *(
        Path(__file__).with_name(f"{name}.py")
        for name in ("model_description", "pythonfmu_library", "units", "variables")
    ),
    Path(ports.__file__),
)


def content_hash(files: dict[str, bytes] | None = None, table: list[Entry] | None = None) -> str:
    """Twelve hex digits over everything that an FMU built now would be made of."""
    files = sources() if files is None else files
    table = parameter_table() if table is None else table
    recipe = {f"recipe/{file.name}": file.read_bytes() for file in RECIPE_FILES}
    digest = hashlib.sha256()
    for name, content in sorted((files | recipe).items()):
        digest.update(f"{name}\0{len(content)}\0".encode())
        digest.update(content)
    digest.update(json.dumps(table, sort_keys=True).encode())
    digest.update(version("pythonfmu").encode())
    return digest.hexdigest()[:12]


def built_hash(fmu: Path) -> str | None:
    """The content hash that an FMU was built with; None when it is missing, damaged or another."""
    try:
        with zipfile.ZipFile(fmu) as archive:
            if archive.testzip() is not None:
                return None
            module = archive.read("resources/slavemodule.txt").decode()
    except (OSError, zipfile.BadZipFile, zlib.error, EOFError, KeyError, ValueError):
        return None
    return module.removeprefix(f"{MODULE}_") if module.startswith(f"{MODULE}_") else None


def build(directory: Path, files: dict[str, bytes] | None = None) -> Path:
    """Make the FMU in a directory and return its path; other content than ours for tests.

    Written beside its final place and moved there, so that nobody ever sees half of it.
    """
    files = sources() if files is None else files
    table = parameter_table()
    content = content_hash(files, table)
    with tempfile.TemporaryDirectory(prefix="stickslip3dof-") as scratch:
        raw = _build_with_pythonfmu(Path(scratch), files, table, content)
        finished = _finish(raw, content)
    return write_bytes(finished, directory / FMU)


def _build_with_pythonfmu(
    scratch: Path, files: dict[str, bytes], table: list[Entry], content: str
) -> Path:
    from pythonfmu import FmuBuilder

    names = {MODULE: f"{MODULE}_{content}", "stickslip": f"stickslip_{content}"}
    variables = variables_module(table, content)
    for name, source in (files | {"stickslip/variables.py": variables}).items():
        target = scratch / _renamed(name, names)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(_rename_imports(source, names["stickslip"]))
    fmu: Path = FmuBuilder.build_FMU(
        scratch / f"{names[MODULE]}.py",
        dest=scratch / FMU,
        project_files=[scratch / names["stickslip"]],
        needsExecutionTool=True,
        canGetAndSetFMUstate=True,
        canSerializeFMUstate=True,
    )
    return fmu


def _renamed(name: str, names: dict[str, str]) -> Path:
    path = Path(name)
    first = names[path.parts[0].removesuffix(".py")]
    return Path(first + ".py") if len(path.parts) == 1 else Path(first, *path.parts[1:])


def _rename_imports(source: bytes, package: str) -> bytes:
    return re.sub(rb"(?m)^(\s*(?:from|import)\s+)stickslip\b", rb"\1" + package.encode(), source)


def _finish(raw: Path, content: str) -> bytes:
    """The unit with its full description and corrected libraries."""
    with zipfile.ZipFile(raw) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    if not any(name.startswith("binaries/") for name in files):
        raise ValueError(
            "pythonfmu has no libraries to put into the unit; it was imported from inside "
            "another FMU, so build in a process that has loaded none"
        )
    for name in files:
        if name.startswith("binaries/"):
            files[name] = corrected(files[name])
    files["modelDescription.xml"] = fmi2_description(_facts(content), variables())
    return packed(files)


def _facts(content: str) -> UnitFacts:
    return UnitFacts(
        name=NAME,
        guid=_guid(content),
        description=f"{DESCRIPTION}. For hosts with a Python of 3.10 or newer",
        version=version("stickslip"),
        tool=f"stickslip, pythonfmu {version('pythonfmu')}",
        python=True,
    )


def _guid(content: str) -> str:
    return str(uuid.uuid5(uuid.NAMESPACE_URL, f"{NAME}/{content}"))


def variables_module(table: list[Entry], content: str) -> bytes:
    """Text of the module that tells the slave what it is; ``content``: hash of the build."""
    values = {
        "BUILD": content,
        "GUID": _guid(content),
        # (name, place in u, start, min, max) and (name, place in o, is an integer)
        "INPUTS": [
            (each.name, getattr(layout, each.slot), each.start, each.min, each.max)
            for each in ports.INPUTS
        ],
        "OUTPUTS": [
            (each.name, getattr(layout, each.slot), each.unit is None) for each in ports.OUTPUTS
        ],
        "PARAMETERS": table,
        "TUNABLE": TUNABLE,
    }
    lines = ['"""What this build of the unit is, its ports and its parameters."""']
    for name, value in values.items():
        lines.append(f"{name} = {pprint.pformat(value, width=100, sort_dicts=False)}")
    return "\n".join(lines).encode() + b"\n"


if __name__ == "__main__":
    print(build(Path(sys.argv[1])))
