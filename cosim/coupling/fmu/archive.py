"""The file that a unit is: read and unpacked so that it cannot do harm before it even runs."""

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
ELSEWHERE = "the environment variable TMPDIR names another place"
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
        check_members(path, archive)
        if member not in archive.namelist():
            return None
        if archive.getinfo(member).file_size > MOST_XML:
            raise FmuError(f"{path}: its {member} has more than {MOST_XML >> 20} MiB")
        content = archive.read(member)
    check_xml(f"{path}: its {member}", content)
    return content


def unpack(
    path: Path,
    most: tuple[int, int, int] | None = None,
    refused: type[ValueError] = FmuError,
    fault: str = "damaged",
) -> tempfile.TemporaryDirectory[str]:
    """Unpack a unit, or another archive, into a fresh folder; `refused` in one line where that
    cannot be.

    most: as of `check_members`. fault: what a broken archive is.
    """
    from stickslip.scratch import scratch_folder  # whoever couples units loads no model

    try:
        directory = scratch_folder("fmu")
    except OSError as error:
        raise refused(f"{path}: there is no folder to unpack it in ({one_line(error)})") from error
    folder = directory.name
    where = f"{path}: cannot be unpacked in {folder}"
    try:
        with _opened(path, fault, refused) as archive:
            size = check_members(path, archive, most, refused)
            room = shutil.disk_usage(folder).free
            if size > room:
                raise refused(
                    f"{where}: takes {size >> 20} MiB, there are {room >> 20} MiB; {ELSEWHERE}"
                )
            for member in archive.infolist():
                name = member.orig_filename
                if "\\" in name or "\0" in name:
                    raise refused(f"{path}: its member {name!r} has a name that no file may have")
                try:
                    archive.extract(member, folder)
                except OSError as error:
                    raise refused(f"{where}: {error.strerror or error}; {ELSEWHERE}") from error
    except BaseException:
        directory.cleanup()
        raise
    return directory


@contextmanager
def _opened(
    path: Path,
    fault: str = "not an FMU, or truncated",
    refused: type[ValueError] = FmuError,
) -> Iterator[zipfile.ZipFile]:
    if not path.is_file():
        what = "is no regular file" if path.exists() else "no such file"
        raise refused(f"{path}: {what}; expected an FMU")
    try:
        with zipfile.ZipFile(path) as archive:
            yield archive
    except refused:
        raise
    except BROKEN as error:
        raise refused(f"{path}: {fault} ({one_line(error)})") from error
    except OSError as error:
        raise refused(f"{path}: cannot be read: {error.strerror or error}") from error


def check_members(
    path: Path,
    archive: zipfile.ZipFile,
    most: tuple[int, int, int] | None = None,
    refused: type[ValueError] = FmuError,
) -> int:
    """Nothing points outside, nothing is there that only a trap would have; else `refused`.

    most: bytes unpacked, members, and how many times larger than the file all may be unpacked;
    left out: what a unit may have. Bytes that there are.
    """
    most_bytes, most_members, most_ratio = most or (MOST_BYTES, MOST_MEMBERS, MOST_RATIO)
    members = archive.infolist()
    if len(members) > most_members:
        raise refused(f"{path}: holds {len(members)} files, allowed are {most_members}")
    for member in members:
        if fault := _fault_of(member):
            raise refused(f"{path}: its member {member.orig_filename!r} {fault}")
    size, packed = sum(member.file_size for member in members), path.stat().st_size
    if size > most_bytes:
        raise refused(
            f"{path}: would take {size / 1024**3:.3g} GiB unpacked, allowed are "
            f"{most_bytes / 1024**3:g} GiB"
        )
    if size > FEW_BYTES and size > most_ratio * packed:
        raise refused(
            f"{path}: would be {size / packed:.0f} times as large unpacked ({size >> 20} MiB), "
            f"allowed is {most_ratio} times; a zip bomb?"
        )
    return size


def _fault_of(member: zipfile.ZipInfo) -> str:
    """What is wrong with a member; "" where nothing is."""
    # orig_filename: as it is in the file; zipfile itself makes / of \ on Windows, cuts at a NUL
    name = member.orig_filename
    if re.match(r"[/\\]|[A-Za-z]:", name) or ".." in re.split(r"[/\\]", name):
        return "points outside the folder that it belongs in"
    if stat.S_ISLNK(member.external_attr >> 16):
        return "is a symbolic link, which may point outside"
    return "is encrypted" if member.flag_bits & 0x1 else ""


def check_xml(place: str, content: bytes, refused: type[ValueError] = FmuError) -> None:
    """Refuse what is no XML, and a document type: entities, which can grow without end or fetch
    files, live there.

    Names need not have a known namespace.
    """

    def refuse(*_: object) -> None:
        raise refused(f"{place} has a document type (DTD, entities), which nothing here needs")

    parser = expat.ParserCreate()
    parser.StartDoctypeDeclHandler = refuse
    try:
        parser.Parse(content, True)  # at once: in pieces, a long attribute is begun with each anew
    except (expat.ExpatError, ValueError, LookupError) as error:
        if isinstance(error, refused):
            raise
        raise refused(f"{place} is not valid: {one_line(error)}") from error
