"""C to shared libraries: by zig for every platform, by the compiler of the system for this one."""

import importlib.util
import logging
import os
import shutil
import struct
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path

from ..scratch import scratch_folder
from . import ends_with_parent
from .platforms import Platform, this_machine

LOG = logging.getLogger(__name__)

# With a * b + c contracted into one rounding, the motion would differ from machine to machine.
# Nobody asks a root or a power for errno: without it they are as exact, and a twentieth faster.
OPTIONS = (
    "-std=c99", "-Werror=implicit-function-declaration", "-O2", "-ffp-contract=off",
    "-fno-math-errno", "-fvisibility=hidden", "-s",
)  # fmt: skip
# Whoever calls the functions of a library by their names sees them all, and they call each other
# without a detour for somebody's functions of the same names.
CALLED_BY_NAME = ("-O3", "-fvisibility=default", "-fno-semantic-interposition")
# WebAssembly has no libraries that are linked later: a module that is called, without a `main`.
SHARED = {".wasm": ["-mexec-model=reactor"]}
# A library of a Mac says where it is to be looked for: wherever who links to it says. (Who opens it
# by its path, as hosts do, does not ask.)
MORE = {".dll": [], ".dylib": ["-lm", "-Wl,-install_name,@rpath/{library}"]}
COMPILERS = ("cc", "gcc", "clang")


NO_COMPILER = (
    "no C compiler: install one (cc, gcc or clang), or `pip install ziglang`, which compiles for "
    "every platform"
)


class CompilerError(ValueError):
    """There is no compiler for a platform, or it refuses the sources; one line."""


def has_zig() -> bool:
    """Whether every platform can be compiled for."""
    return importlib.util.find_spec("ziglang") is not None


def possible(platforms: Sequence[Platform]) -> list[Platform]:
    """Those that can be compiled for here: all with zig, else at most this machine's own."""
    if has_zig():
        return list(platforms)
    own = this_machine() if system_compiler() else None
    return [each for each in platforms if each == own]


def require_compiler(platform: Platform) -> None:
    """Raises CompilerError where nothing compiles for a platform."""
    if not possible([platform]):
        raise CompilerError(f"{platform.name}: {NO_COMPILER}")


def compiled(
    sources: Mapping[str, bytes],
    platforms: Sequence[Platform],
    name: str,
    options: Sequence[str] = (),
    *,
    stays: bool = False,
) -> dict[Platform, bytes]:
    """A library for each platform, of C sources by their names; ``name``: what it calls itself.

    stays : for this machine alone, by its own compiler if it has one, which is quicker; what zig
    compiles runs on older systems, too. Each is compiled by a process of its own, as many at once
    as there are processors; all end with this one, however that ends. Raises CompilerError.
    """
    LOG.info("compiling %s for %s", name, ", ".join(each.name for each in platforms))
    with scratch_folder("c") as scratch:
        folder = Path(scratch)
        for file, content in sources.items():
            (folder / file).write_bytes(content)
        # the line is cut before the pool waits for its threads
        with ThreadPoolExecutor(os.cpu_count()) as pool, _line() as line:
            made = pool.map(
                lambda each: _library(
                    folder, each, name, [*_compiler(each, stays), *OPTIONS, *options], line
                ),
                platforms,
            )
            return dict(zip(platforms, made, strict=True))


def compile_into(
    folder: Path,
    sources: Mapping[str, bytes],
    platforms: Sequence[Platform],
    name: str,
    options: Sequence[str] = (),
    *,
    file: Callable[[Platform], str],
) -> None:
    """Compile for a package that brings its libraries along, each as the name that ``file`` gives.

    Raises CompilerError.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for platform, library in compiled(sources, platforms, name, options).items():
        (folder / file(platform)).write_bytes(library)


@contextmanager
def _line() -> Iterator[int]:
    """Standard input of compilers, which end with it."""
    theirs, ours = os.pipe()
    try:
        yield theirs
    finally:
        os.close(ours)
        os.close(theirs)


def _library(
    folder: Path, platform: Platform, name: str, compiler: Sequence[str], line: int
) -> bytes:
    # A DLL calls itself as the file that the compiler writes, so each platform has a folder.
    library = Path(platform.name) / f"{name}{platform.suffix}"
    (folder / library.parent).mkdir()
    files = sorted(file.name for file in folder.glob("*.c"))
    more = [word.format(library=library.name) for word in MORE.get(platform.suffix, ["-lm"])]
    shared = SHARED.get(platform.suffix, ["-fPIC", "-shared"])
    command = [*compiler, *shared, "-o", str(library), *files, *more]
    guarded = [sys.executable, "-IS", ends_with_parent.__file__, *command]
    done = subprocess.run(
        guarded,
        cwd=folder,
        stdin=line,
        capture_output=True,
        text=True,
        check=False,
        process_group=0,
    )
    if done.returncode != 0:
        said = next((line for line in done.stderr.splitlines() if "error" in line), done.stderr)
        raise CompilerError(f"{platform.name}: {command[0]} refuses the sources: {said.strip()}")
    return (folder / library).read_bytes()


def _compiler(platform: Platform, stays: bool) -> list[str]:
    system = system_compiler() if platform == this_machine() else None
    if system and (stays or not has_zig()):
        return [system]
    require_compiler(platform)
    return [sys.executable, "-m", "ziglang", "cc", "-target", platform.target]


def system_compiler() -> str | None:
    """Path of the compiler of the system; None where it has none."""
    return next(filter(None, map(shutil.which, COMPILERS)), None)


# Of a file for several processors (mach-o/fat.h): magic number, processor type and subtype,
# alignment of the parts as a power of 2.
FAT, ALIGNMENT = 0xCAFEBABE, 14


def joined(parts: Sequence[bytes]) -> bytes:
    """One library for several processors of a Mac; a single one stays as it is."""
    if len(parts) == 1:
        return parts[0]
    header = struct.pack(">II", FAT, len(parts))
    at = 1 << ALIGNMENT
    body = b""
    for part in parts:
        kind, subtype = struct.unpack_from("<II", part, 4)  # what a thin library begins with
        header += struct.pack(">IIIII", kind, subtype, at + len(body), len(part), ALIGNMENT)
        body += part + b"\0" * (-len(part) % (1 << ALIGNMENT))
    return header.ljust(at, b"\0") + body
