"""The libraries of a native unit: the wheel's where they are of today's content, or compiled.

What was compiled once is kept in the user's cache, for whoever builds a unit of the same sources.
"""

import logging
import zipfile
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import IO

from stickslip import machine_code
from stickslip.generation.compiler import (
    NO_COMPILER,
    OPTIONS,
    CompilerError,
    compile_into,
    compiled,
    has_zig,
    joined,
    possible,
)
from stickslip.generation.platforms import BROWSER, PLATFORMS, Platform, this_platform

LOG = logging.getLogger(__name__)
#: Level of what `cosim.cli.console` shows on a terminal.
WAITING = logging.INFO + 5
#: Versions of FMI, each with its own names of the folders in `binaries`.
FMI2, FMI3 = 2, 3
#: Beside this file in an installed package: libraries of the wheel, in folders called by the GUIDs.
PREBUILT = "prebuilt"

Sources = Callable[[], dict[str, bytes]]


@cache
def libraries(
    name: str, guid: str, sources: Sources, platforms: tuple[Platform, ...]
) -> dict[Platform, bytes]:
    """Platform -> library, of those platforms that there is a way to.

    name, guid : of the unit; sources : makes its C files by their names, where they are compiled.
    Once in a process: a library serves several units. Raises CompilerError where there is a way to
    none.
    """
    require_way(guid, platforms)
    brought = _prebuilt(guid)
    made = {each: brought[each].read_bytes() for each in platforms if each in brought}
    lacking = possible([each for each in platforms if each not in made])
    if lacking:
        made |= _compiled(sources(), lacking, name)
    return made


def _compiled(
    sources: Mapping[str, bytes], platforms: Sequence[Platform], name: str
) -> dict[Platform, bytes]:
    """Taken from the user's cache, or compiled and kept there. Raises CompilerError."""
    made_from = repr((OPTIONS, has_zig(), sorted(sources.items())))
    code = machine_code.Code(name, made_from, lambda: sources)
    files = {each: code.file(each) for each in platforms}
    kept = {each: machine_code.kept(file) for each, file in files.items()}
    made = {each: file.read_bytes() for each, file in kept.items() if file}
    if lacking := [each for each in platforms if each not in made]:
        LOG.log(WAITING, "compiling %s for this version, once: some seconds", name)
        new = compiled(sources, lacking, name)
        for each, library in new.items():
            machine_code.keep(files[each], library)
        made |= new
    return made


def require_way(guid: str, platforms: Sequence[Platform]) -> None:
    """Raises CompilerError where a unit can have a library for none of the platforms."""
    brought = _prebuilt(guid)
    if not (any(each in brought for each in platforms) or possible(platforms)):
        raise CompilerError(_no_way(guid))


def _prebuilt(guid: str) -> dict[Platform, Path]:
    folder = _prebuilt_folder() / guid
    files = {each: folder / _file(each) for each in (*PLATFORMS, BROWSER)}
    return {each: file for each, file in files.items() if file.is_file()}


def _prebuilt_folder() -> Path:
    return Path(__file__).with_name(PREBUILT)


def _no_way(guid: str) -> str:
    """Why there is a library for none of the platforms."""
    folder = _prebuilt_folder()
    if folder.is_dir() and not (folder / guid).is_dir():
        return (
            f"the libraries in {folder} are of another content than the installed files beside "
            "them, of which some have been changed or are of another version, and there is no C "
            "compiler to make new ones: install stickslip again "
            "(`pip install --force-reinstall stickslip`)"
        )
    return NO_COMPILER


def prebuild(
    folder: Path, name: str, guid: str, sources: Sources, platforms: Sequence[Platform]
) -> Path:
    """Compile for platforms that can be, for a wheel; the folder that it is to bring along."""
    target = folder / guid
    compile_into(target, sources(), possible(platforms), name, file=_file)
    return target


def _file(platform: Platform) -> str:
    return f"{platform.name}{platform.suffix}"


def of_platforms(
    guid: str, sources: Sources, platforms: Sequence[Platform], name: str, fmi: int = FMI2
) -> dict[str, bytes]:
    """Path in the unit -> library; in one for FMI 2 both processors of a Mac share a file."""
    by_path: dict[str, list[bytes]] = {}
    for platform, library in libraries(name, guid, sources, tuple(platforms)).items():
        path = f"{_folder(platform, fmi)}/{name}{platform.suffix}"
        by_path.setdefault(path, []).append(library)
    return {path: joined(parts) for path, parts in by_path.items()}


def _folder(platform: Platform, fmi: int) -> str:
    return f"binaries/{platform.name if fmi == FMI3 else platform.fmi2}"


def runs_here(fmu: Path) -> bool:
    """Whether a unit as a file has a library for this machine."""
    own = this_platform()
    return own is None or own.name in platforms_of(fmu)


def platforms_of(fmu: Path | IO[bytes]) -> list[str]:
    """Names of the platforms that a unit as a file has libraries for; of a system, its units."""
    with zipfile.ZipFile(fmu) as archive:
        names = archive.namelist()
        unit = next((name for name in names if name.endswith(".fmu")), None)
        if unit is not None:
            return platforms_of(archive.open(unit))
    there = {(Path(name).parent.as_posix(), Path(name).suffix) for name in names}
    return [
        each.name
        for each in PLATFORMS
        if any((_folder(each, fmi), each.suffix) in there for fmi in (FMI2, FMI3))
    ]
