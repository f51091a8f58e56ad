"""The file that a unit is: read and unpacked so that it cannot do harm before it even runs."""

from __future__ import annotations

import lzma
import re
import shutil
import stat
import struct
import tempfile
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from xml.parsers import expat

from cosim.coupling.fmu.errors import FmuError, one_line

#: Bytes that a unit may have unpacked, bytes of its description, and members.
MOST_BYTES, MOST_XML, MOST_MEMBERS = 4 * 1024**3, 256 * 1024**2, 50_000
#: How many times larger than the file that may be, where it is more than FEW_BYTES: a table of
#: zeros alone gives a thousand, a real unit with large tables ten.
MOST_RATIO, FEW_BYTES = 200, 64 * 1024**2
DESCRIPTION = "modelDescription.xml"
#: What zipfile and the packing methods raise where an archive is broken.
BROKEN = (
    *(zipfile.BadZipFile, zlib.error, lzma.LZMAError, EOFError, struct.error, OverflowError),
    *(UnicodeError, NotImplementedError, RuntimeError, ValueError, IndexError, KeyError),
)


def read_xml(path: Path, member: str) -> bytes | None:
    """An XML file of a unit, None where there is none of that name; FmuError where it is no FMU.

    The archive is checked as a whole, and the file for entities.
    """
    with _opened(path) as archive:
        _check(path, archive)
        if member not in archive.namelist():
            return None
        if archive.getinfo(member).file_size > MOST_XML:
            raise FmuError(f"{path}: its {member} has more than {MOST_XML >> 20} MiB")
        content = archive.read(member)
    _check_prolog(path, member, content)
    return content


def unpack(path: Path) -> tempfile.TemporaryDirectory[str]:
    """Unpack a unit into a fresh folder; FmuError in one line where that cannot be."""
    from stickslip.scratch import scratch_folder  # whoever couples units loads no model

    try:
        directory = scratch_folder("fmu")
    except OSError as error:
        raise FmuError(f"{path}: there is no folder to unpack it in ({one_line(error)})") from error
    folder = directory.name
    try:
        with _opened(path, "damaged") as archive:
            _check(path, archive)
            _check_room(path, archive, folder)
            for member in archive.infolist():
                _extract(path, archive, member, folder)
    except BaseException:
        directory.cleanup()
        raise
    return directory


def _extract(path: Path, archive: zipfile.ZipFile, member: zipfile.ZipInfo, folder: str) -> None:
    try:
        archive.extract(member, folder)
    except OSError as error:
        raise FmuError(
            f"{path}: cannot be unpacked in {folder}: {error.strerror or error}; the environment "
            "variable TMPDIR names another place"
        ) from error


@contextmanager
def _opened(path: Path, fault: str = "not an FMU, or truncated") -> Iterator[zipfile.ZipFile]:
    if not path.is_file():
        raise FmuError(f"{path}: no such file; expected an FMU")
    try:
        with zipfile.ZipFile(path) as archive:
            yield archive
    except FmuError:
        raise
    except BROKEN as error:
        raise FmuError(f"{path}: {fault} ({one_line(error)})") from error
    except OSError as error:
        raise FmuError(f"{path}: cannot be read: {error.strerror or error}") from error


def _check(path: Path, archive: zipfile.ZipFile) -> None:
    """Nothing points outside, nothing is there that only a trap would have."""
    members = archive.infolist()
    if len(members) > MOST_MEMBERS:
        raise FmuError(f"{path}: holds {len(members)} files, allowed are {MOST_MEMBERS}")
    for member in members:
        _check_member(path, member)
    size, packed = _unpacked(archive), path.stat().st_size
    if size > MOST_BYTES:
        raise FmuError(
            f"{path}: would take {size / 1024**3:.3g} GiB unpacked, allowed are "
            f"{MOST_BYTES / 1024**3:g} GiB"
        )
    if size > FEW_BYTES and size > MOST_RATIO * packed:
        raise FmuError(
            f"{path}: would be {size / packed:.0f} times as large unpacked ({size >> 20} MiB), "
            f"allowed is {MOST_RATIO} times; a zip bomb?"
        )


def _unpacked(archive: zipfile.ZipFile) -> int:
    return sum(member.file_size for member in archive.infolist())


def _check_member(path: Path, member: zipfile.ZipInfo) -> None:
    # orig_filename: as it is in the file; zipfile itself makes / of \ on Windows, cuts at a NUL
    name = member.orig_filename
    outside = (
        name.startswith(("/", "\\"))
        or re.match(r"[A-Za-z]:", name) is not None
        or ".." in re.split(r"[/\\]", name)
    )
    if outside:
        raise FmuError(f"{path}: its member {name!r} points outside the folder that it belongs in")
    if "\\" in name or "\0" in name:
        raise FmuError(f"{path}: its member {name!r} has a name that no FMU may hold")
    if stat.S_ISLNK(member.external_attr >> 16):
        raise FmuError(f"{path}: its member {name!r} is a symbolic link, which may point outside")
    if member.flag_bits & 0x1:
        raise FmuError(f"{path}: its member {name!r} is encrypted")


def _check_room(path: Path, archive: zipfile.ZipFile, folder: str) -> None:
    size = _unpacked(archive)
    with_room = shutil.disk_usage(folder).free
    if size > with_room:
        raise FmuError(
            f"{path}: cannot be unpacked in {folder}: takes {size >> 20} MiB, there are "
            f"{with_room >> 20} MiB; the environment variable TMPDIR names another place"
        )


class _Root(Exception):
    """The first element has come: what may hold entities lies behind."""


def _check_prolog(path: Path, member: str, content: bytes) -> None:
    """Refuse a document type: entities, which can grow without end or fetch files, live there."""

    def refuse(*_: object) -> None:
        raise FmuError(
            f"{path}: its {member} has a document type (DTD, entities), which no FMU needs"
        )

    def end(*_: object) -> None:
        raise _Root

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = refuse
    parser.StartElementHandler = end
    try:
        parser.Parse(content, True)  # at once: in pieces, a long attribute is begun with each anew
    except _Root:
        pass
    except (expat.ExpatError, ValueError, LookupError) as error:
        if isinstance(error, FmuError):
            raise
        raise FmuError(f"{path}: its {member} is not valid: {one_line(error)}") from error
