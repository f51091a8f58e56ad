"""Units in a page of C that do what a test needs: go wrong, or have events."""

import functools
import re
import subprocess
import tempfile
import zipfile
from pathlib import Path

import pytest
from c_library import compiler
from stickslip.generation.platforms import this_platform

from cosim.fmu.native import native_folder

HERE = Path(__file__).parent


@functools.cache
def _library(name: str) -> bytes:
    if not compiler() or this_platform() is None:
        pytest.skip("needs a C compiler")
    headers = native_folder() / "headers"
    with tempfile.TemporaryDirectory() as scratch:
        stubs = Path(scratch) / "stubs.c"
        stubs.write_text(_stubs(name, headers))
        made = Path(scratch) / "unit.so"
        command = [*compiler(), "-O1", "-w", "-fPIC", "-shared", f"-I{headers}", "-o", str(made)]
        subprocess.run([*command, str(HERE / f"{name}.c"), str(stubs), "-lm"], check=True)
        return made.read_bytes()


def _stubs(name: str, headers: Path) -> str:
    """Functions that fmpy wants to be there and no test calls."""
    source = (HERE / f"{name}.c").read_text()
    prefix = "fmi3" if "fmi3" in source else "fmi2"
    declared = (headers / f"{prefix}Functions.h").read_text()
    wanted = set(re.findall(rf"{prefix}\w+TYPE\s+({prefix}\w+);", declared))
    there = set(re.findall(rf"(?m)^[\w \*]*\b\*?({prefix}\w+)\(", source))
    return "".join(f"int {each}(void) {{ return 3; }}\n" for each in sorted(wanted - there))


def made(name: str, folder: Path, **changes: str) -> Path:
    """The unit `name` in a folder; changes: text in its description -> what is there instead."""
    platform = this_platform()
    library = _library(name)
    description = (HERE / f"{name}.xml").read_text()
    for old, new in changes.items():
        assert old in description
        description = description.replace(old, new)
    where = platform.name if 'fmiVersion="3.0"' in description else platform.fmi2
    unit = folder / f"{name}.fmu"
    with zipfile.ZipFile(unit, "w") as archive:
        archive.writestr("modelDescription.xml", description)
        archive.writestr(f"binaries/{where}/{name}{platform.suffix}", library)
    return unit
