"""StickSlip3DOF.fmu: the kernel as C, with the functions of FMI around it.

The same content gives the same GUID, and with the same compiler the same file, byte for byte. What
was compiled while the package was made into a wheel (see `build/hook.py`) is taken where it is of
today's content; else it is compiled here.
"""

from __future__ import annotations

import hashlib
import json
import uuid
import zipfile
import zlib
from collections.abc import Sequence
from dataclasses import asdict
from functools import cache
from importlib.metadata import version
from pathlib import Path
from xml.etree.ElementTree import ParseError, fromstring

from stickslip.contradictions import SAID
from stickslip.generation import c as c_generation
from stickslip.generation.c import c_header, c_source
from stickslip.generation.source import kernel_source
from stickslip.names import NAMES
from stickslip.status import WHY_NOT

from cosim.files import write_bytes
from cosim.fmu import c_tables
from cosim.fmu.archive import packed
from cosim.fmu.compiler import CompilerError, libraries, possible
from cosim.fmu.exchange import INDICATORS, variables
from cosim.fmu.model_description import UnitFacts, fmi2_description
from cosim.fmu.platforms import PLATFORMS, Platform, this_platform

NAME = "StickSlip3DOF"
DESCRIPTION = (
    "Stick-slip of a block on four springs on a moving surface: three degrees of freedom, dry "
    "friction, friction heat handed over as energy"
)
#: Files that make the sources.
MAKERS = (
    *Path(c_generation.__file__).parent.glob("c*.py"),
    *(
        Path(__file__).with_name(f"{name}.py")
        for name in ("native", "c_tables", "compiler", "exchange")
    ),
)
#: Beside this file in an installed package: libraries of the wheel, in a folder called by the GUID.
PREBUILT = "prebuilt"


@cache
def sources() -> dict[str, bytes]:
    """File name -> content of everything that the library is compiled from."""
    text, declared = kernel_source(), variables()
    places = {name: place for place, name in enumerate(NAMES)}
    made = {
        "kernel.h": c_header(text),
        "kernel.c": c_source(text),
        "variables.h": c_tables.variables_header(declared, guid()),
        "variables.c": c_tables.variables_source(declared),
        "words.h": c_tables.words_header(),
        "words.c": c_tables.words_source(SAID, places),
    }
    return _written() | {name: content.encode() for name, content in made.items()}


@cache
def guid() -> str:
    """The GUID of a unit built now: of what it is made from, which is quicker than making it."""
    declared = [asdict(each) for each in variables()]
    made_from = {
        "kernel": kernel_source().encode(),
        "words": json.dumps([WHY_NOT, SAID]).encode(),
        "variables": json.dumps(declared, sort_keys=True).encode(),
        **{f"maker/{file.name}": file.read_bytes() for file in MAKERS},
        **_written(),
    }
    digest = hashlib.sha256()
    for name, content in sorted(made_from.items()):
        digest.update(f"{name}\0{len(content)}\0".encode())
        digest.update(content)
    return str(uuid.uuid5(uuid.NAMESPACE_URL, f"{NAME}/{digest.hexdigest()}"))


def _written() -> dict[str, bytes]:
    """What is written in C, not made: in fmu_src/native in a checkout."""
    folder = native_folder()
    places = (folder, folder / "headers", folder / "stickslip3dof")
    return {
        file.name: file.read_bytes()
        for place in places
        for file in place.iterdir()
        if file.name.endswith((".c", ".h")) and not file.name.startswith("fmi3")
    }


def native_folder() -> Path:
    """The folder of the C sources: in fmu_src in a checkout, beside this file in a package."""
    here = Path(__file__).resolve()
    checkout = here.parents[2] / "fmu_src" / "native"
    return checkout if checkout.is_dir() else here.with_name("native_sources")


def build(directory: Path, platforms: Sequence[Platform] = PLATFORMS) -> Path:
    """Make the unit in a directory, with libraries for those platforms that there is a way to.

    Written beside its final place and moved there, so that nobody ever sees half of it. Raises
    CompilerError where there is a way to none.
    """
    from cosim.fmu.documentation import documentation  # not for who only compiles

    files = {f"sources/{name}": content for name, content in sources().items()}
    files["modelDescription.xml"] = fmi2_description(_facts(), variables())
    files |= documentation(_facts(), variables())
    return write_bytes(packed(files | _libraries(platforms)), directory / f"{NAME}.fmu")


def _libraries(platforms: Sequence[Platform]) -> dict[str, bytes]:
    """Path in the unit -> library: the wheel's where they are of today's content, or compiled."""
    wanted = {f"binaries/{each.fmi2}/{NAME}{each.suffix}" for each in platforms}
    made = _prebuilt()
    if wanted <= made.keys():
        return {path: made[path] for path in wanted}
    there = possible(platforms)
    if there:
        return libraries(sources(), there, NAME)
    raise CompilerError(
        "no C compiler for the unit: install one (cc, gcc or clang), or `pip install ziglang`, "
        "which compiles for every platform"
    )


def _prebuilt() -> dict[str, bytes]:
    folder = Path(__file__).with_name(PREBUILT) / guid()
    return {
        file.relative_to(folder).as_posix(): file.read_bytes()
        for file in folder.rglob("*")
        if file.is_file()
    }


def prebuild(folder: Path) -> Path:
    """Compile for every platform that can be, for a wheel; the folder that it is to bring along."""
    target = folder / guid()
    for path, library in libraries(sources(), possible(PLATFORMS), NAME).items():
        (target / path).parent.mkdir(parents=True, exist_ok=True)
        (target / path).write_bytes(library)
    return target


def runs_here(fmu: Path) -> bool:
    """Whether a unit as a file has a library for this machine."""
    own = this_platform()
    return own is None or own.name in platforms_of(fmu)


def platforms_of(fmu: Path) -> list[str]:
    """Names of the platforms that a unit as a file has libraries for."""
    with zipfile.ZipFile(fmu) as archive:
        there = set(archive.namelist())
    return [each.name for each in PLATFORMS if f"binaries/{each.fmi2}/{NAME}{each.suffix}" in there]


def built_guid(fmu: Path) -> str | None:
    """The GUID of a unit as a file; None where it is missing or damaged."""
    try:
        with zipfile.ZipFile(fmu) as archive:
            if archive.testzip() is not None:
                return None
            return fromstring(archive.read("modelDescription.xml")).get("guid")
    except (OSError, zipfile.BadZipFile, zlib.error, EOFError, KeyError, ValueError, ParseError):
        return None


def _facts() -> UnitFacts:
    return UnitFacts(
        name=NAME,
        guid=guid(),
        description=DESCRIPTION,
        version=version("stickslip"),
        tool="stickslip",
        indicators=INDICATORS,
        sources=tuple(sorted(name for name in sources() if name.endswith(".c"))),
    )
