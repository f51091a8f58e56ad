"""Libraries of the native units: the names that they show, what they call themselves, and what is
said where there is none."""

import re
import shutil
import struct
import subprocess

import pytest
from refusals import one_line
from stickslip import machine_code
from stickslip.generation.compiler import compiled, has_zig
from stickslip.generation.platforms import PLATFORMS, this_platform

from cosim.fmu import libraries, native
from cosim.fmu.build import FmuBuildError, build_fmu
from cosim.fmu.thermal import native_unit

UNITS = {unit.NAME: unit for unit in (native, native_unit)}
#: Of mach-o/loader.h: magic number of a 64-bit file, size of its header, and the load command that
#: gives a library's own name.
MACH_O, HEADER, LC_ID_DYLIB = 0xFEEDFACF, 32, 0xD


@pytest.mark.parametrize("name", UNITS)
def test_a_library_that_anybody_compiles_shows_the_functions_of_fmi_alone(name, tmp_path):
    """Another unit in the process may have the same names inside; who compiles the sources that
    travel with a unit may know of no option for that."""
    compiler = next(filter(None, map(shutil.which, ("cc", "gcc", "clang"))), None)
    if compiler is None or not shutil.which("nm") or this_platform().suffix != ".so":
        pytest.skip("needs Linux, a C compiler and nm")
    for file, content in UNITS[name].sources().items():
        (tmp_path / file).write_bytes(content)
    files = sorted(file.name for file in tmp_path.glob("*.c"))
    made = [compiler, "-O0", "-fPIC", "-shared", "-o", "plain.so", *files, "-lm"]
    subprocess.run(made, cwd=tmp_path, check=True)
    told = subprocess.run(
        ["nm", "-D", "--defined-only", "plain.so"], cwd=tmp_path, check=True, capture_output=True,
        text=True,
    )  # fmt: skip
    shown = {line.split()[-1] for line in told.stdout.splitlines()}
    assert {"fmi2Instantiate", "fmi2DoStep"} <= shown
    assert [each for each in shown if not re.match(r"fmi[23][A-Z]", each)] == []


def install_name(library):
    """What a library of a Mac calls itself, by its load commands."""
    magic, _, _, _, count = struct.unpack_from("<IIIII", library)
    assert magic == MACH_O
    at, found = HEADER, []
    for _ in range(count):
        command, size, name = struct.unpack_from("<III", library, at)
        if command == LC_ID_DYLIB:
            found.append(library[at + name : at + size].rstrip(b"\0").decode())
        at += size
    return found


@pytest.mark.skipif(not has_zig(), reason="needs zig")
def test_libraries_call_themselves_as_their_files_are_called():
    """And not as the compiler's scratch file was. Without the C library, whose parts zig would
    compile for each of the platforms first; of a DLL it is what is called on loading."""
    loaded = b"int DllMainCRTStartup(void *a, unsigned b, void *c) { return 1; }\n"
    one = b'__attribute__((visibility("default"))) int one(void) { return 1; }\n'
    made = compiled({"one.c": loaded + one}, PLATFORMS, "Named", ["-nostdlib"])
    for platform, library in made.items():
        if platform.suffix == ".dylib":
            assert install_name(library) == ["@rpath/Named.dylib"]
        elif platform.suffix == ".dll":
            assert b"\0Named.dll\0" in library
        assert platform.name.encode() not in library


def test_what_was_compiled_once_is_taken_from_the_cache(tmp_path, monkeypatch):
    """And compiled again where the sources are others, or what was kept is damaged."""
    times = []

    def compile_anew(sources, platforms, name):
        times.append(name)
        return {each: sources["a.c"] for each in platforms}

    monkeypatch.setattr(machine_code, "_folders", lambda: [tmp_path / "cache"])
    monkeypatch.setattr(libraries, "compiled", compile_anew)
    monkeypatch.setattr(libraries, "possible", list)
    here = this_platform()

    def made(content):
        libraries.libraries.cache_clear()  # as another process
        return libraries.libraries("Unit", "guid", lambda: {"a.c": content}, (here,))

    assert made(b"one") == made(b"one") == {here: b"one"} and len(times) == 1
    assert made(b"two") == {here: b"two"} and len(times) == 2
    for file in (tmp_path / "cache").glob(f"*{here.suffix}"):
        file.write_bytes(b"damaged")
    assert made(b"one") == {here: b"one"} and len(times) == 3
    libraries.libraries.cache_clear()


# --- where there is no compiler ---


@pytest.fixture
def prebuilt(tmp_path, monkeypatch):
    """What an installed package brings along, on a machine without a compiler."""
    monkeypatch.setattr(libraries, "__file__", str(tmp_path / "libraries.py"))
    monkeypatch.setattr(libraries, "possible", lambda platforms: [])
    libraries.libraries.cache_clear()
    yield tmp_path / libraries.PREBUILT
    libraries.libraries.cache_clear()


def refusal(folder):
    return one_line(FmuBuildError, lambda: build_fmu(folder, platforms=[this_platform()]))


def put(folder, platform, content=b"a library"):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{platform.name}{platform.suffix}").write_bytes(content)


def test_libraries_of_another_content_are_said_to_be_that(prebuilt, tmp_path):
    """One file changed in an installed package, or two versions mixed."""
    put(prebuilt / "of-another-version", this_platform())
    said = refusal(tmp_path / "units")
    assert f"the libraries in {prebuilt} are of another content than the installed files" in said
    assert "pip install --force-reinstall stickslip" in said


def test_libraries_that_lack_this_platform_alone_need_a_compiler(prebuilt, tmp_path):
    put(prebuilt / native.guid(), next(each for each in PLATFORMS if each != this_platform()))
    assert "no C compiler: install one" in refusal(tmp_path / "units")


def test_what_there_is_of_the_platforms_is_taken(prebuilt, tmp_path):
    put(prebuilt / native.guid(), this_platform())
    assert libraries.platforms_of(build_fmu(tmp_path)) == [this_platform().name]
