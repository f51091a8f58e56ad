"""StickSlip3DOF.fmu: how its content becomes an FMU, by way of pythonfmu.

The same content gives the same FMU, byte for byte. A build is known by the hash of its content, and
the Python modules inside carry that hash in their names: a process keeps one module of a name, so
two builds in it would otherwise run the code of the one that came first.

What travels inside is pure Python of the standard library: the slave, the kernel as
`stickslip.generation.source` makes it, and how parameters enter it. The effects' declarations stay
behind, and pydantic with them.
"""

from __future__ import annotations

import hashlib
import io
import json
import re
import sys
import tempfile
import zipfile
import zlib
from importlib import resources
from importlib.metadata import version
from pathlib import Path

from stickslip import ports
from stickslip.generation.source import kernel_source
from stickslip.kernel.layout import constants

from cosim.files import write_bytes
from cosim.fmu.model_description import Entry, as_ports, complete, parameter_table, variables_module
from cosim.fmu.pythonfmu_library import corrected

#: Beside the kernel's text: files of the package `stickslip` as they are, but for where the names
#: of the kernel come from.
AS_THEY_ARE = ("contradictions.py", "packing.py", "status.py", "tableau.py")
PACKAGE_DOC = '"""The mechanics of StickSlip3DOF, as it travels inside the FMU."""\n'
_KERNEL = re.compile(r"(?m)^from (\.|stickslip\.)kernel\.[\w.]+ import")


def sources() -> dict[str, bytes]:
    """Path inside the FMU's resources -> content, before anything is renamed."""
    texts = {
        "slave.py": slave_file().read_text(encoding="utf-8"),
        "stickslip/__init__.py": PACKAGE_DOC,
        "stickslip/kernel.py": kernel_source(),
        "stickslip/derived.py": _derived(),
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


def _derived() -> str:
    from stickslip.derived import TEXT

    used = [name for name in constants() if re.search(rf"\b{name}\b", TEXT)]
    head = '"""The effects\' numbers in ``p``, made from their declarations."""\n\n'
    return f"{head}from .kernel import {', '.join(used)}\n{TEXT}"


FMU = "StickSlip3DOF.fmu"
MODULE = "stickslip3dof"
#: Files that an FMU also depends on, though they do not travel.
RECIPE_FILES = (
    Path(__file__),
    *(
        Path(__file__).with_name(f"{name}.py")
        for name in ("model_description", "pythonfmu_library")
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
        finished = _finish(raw, table)
    return write_bytes(finished, directory / FMU)


def _build_with_pythonfmu(
    scratch: Path, files: dict[str, bytes], table: list[Entry], content: str
) -> Path:
    from pythonfmu import FmuBuilder

    names = {"slave": f"{MODULE}_{content}", "stickslip": f"stickslip_{content}"}
    variables = variables_module(table, content)
    for name, source in (files | {"stickslip/variables.py": variables}).items():
        target = scratch / _renamed(name, names)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(_rename_imports(source, names["stickslip"]))
    fmu: Path = FmuBuilder.build_FMU(
        scratch / f"{names['slave']}.py",
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


def _finish(raw: Path, table: list[Entry]) -> bytes:
    """The FMU with its full description and library, entries in order and without a date."""
    packed = io.BytesIO()
    with zipfile.ZipFile(raw) as archive, zipfile.ZipFile(packed, "w") as result:
        if not any(name.startswith("binaries/") for name in archive.namelist()):
            raise ValueError(
                "pythonfmu has no libraries to put into the FMU; it was imported from inside "
                "another FMU, so build in a process that has loaded none"
            )
        for name in sorted(archive.namelist()):
            content = archive.read(name)
            if name == "modelDescription.xml":
                content = complete(content, as_ports(table))
            elif name.startswith("binaries/"):
                content = corrected(content)
            entry = zipfile.ZipInfo(name, date_time=(1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o755 << 16 if name.startswith("binaries/") else 0o644 << 16
            result.writestr(entry, content)
    return packed.getvalue()


if __name__ == "__main__":
    print(build(Path(sys.argv[1])))
