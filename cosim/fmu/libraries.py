"""The libraries of a native unit: the wheel's where they are of today's content, or compiled."""

from __future__ import annotations

import zipfile
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import IO

from cosim.fmu.compiler import CompilerError, compiled, joined, possible
from cosim.fmu.platforms import PLATFORMS, Platform, this_platform

#: Versions of FMI, each with its own names of the folders in `binaries`.
FMI2, FMI3 = 2, 3
#: Beside this file in an installed package: libraries of the wheel, in folders called by the GUIDs.
PREBUILT = "prebuilt"

Sources = Callable[[], dict[str, bytes]]


@cache
def libraries(
    guid: str, sources: Sources, platforms: tuple[Platform, ...]
) -> dict[Platform, bytes]:
    """Platform -> library, of those platforms that there is a way to.

    guid : of the unit; sources : makes its C files by their names, where they are compiled. Once in
    a process: a library serves several units. Raises CompilerError where there is a way to none.
    """
    made = _prebuilt(guid)
    if set(platforms) <= made.keys():
        return {platform: made[platform] for platform in platforms}
    there = possible(platforms)
    if there:
        return compiled(sources(), there)
    raise CompilerError(
        "no C compiler for the unit: install one (cc, gcc or clang), or `pip install ziglang`, "
        "which compiles for every platform"
    )


def _prebuilt(guid: str) -> dict[Platform, bytes]:
    folder = Path(__file__).with_name(PREBUILT) / guid
    files = {each: folder / f"{each.name}{each.suffix}" for each in PLATFORMS}
    return {each: file.read_bytes() for each, file in files.items() if file.is_file()}


def prebuild(folder: Path, guid: str, sources: Sources) -> Path:
    """Compile for every platform that can be, for a wheel; the folder that it is to bring along."""
    target = folder / guid
    target.mkdir(parents=True, exist_ok=True)
    for platform, library in compiled(sources(), possible(PLATFORMS)).items():
        (target / f"{platform.name}{platform.suffix}").write_bytes(library)
    return target


def binaries(made: Mapping[Platform, bytes], name: str, fmi: int = FMI2) -> dict[str, bytes]:
    """Path in the unit -> library; in one for FMI 2 both processors of a Mac share a file."""
    by_path: dict[str, list[bytes]] = {}
    for platform, library in made.items():
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
    return [each.name for each in PLATFORMS if _has(there, each)]


def _has(there: set[tuple[str, str]], platform: Platform) -> bool:
    return any((_folder(platform, fmi), platform.suffix) in there for fmi in (FMI2, FMI3))


def of_platforms(
    guid: str, sources: Sources, platforms: Sequence[Platform], name: str, fmi: int = FMI2
) -> dict[str, bytes]:
    """`libraries` as `binaries`."""
    return binaries(libraries(guid, sources, tuple(platforms)), name, fmi)
