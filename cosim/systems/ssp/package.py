"""An SSP file, or a folder of the same contents, opened with care: what is in it comes from others.

Nothing is unpacked but the members that are asked for, and nowhere but into a folder of our own.
"""

from __future__ import annotations

import re
import shutil
import tempfile
import zipfile
import zlib
from pathlib import Path, PurePosixPath
from urllib.parse import unquote, urlsplit
from xml.etree.ElementTree import Element, ParseError, fromstring

from stickslip.scratch import scratch_folder

from cosim.coupling.fmu.archive import check_members, check_xml
from cosim.systems.system_errors import SystemFault

STRUCTURE = "SystemStructure.ssd"
#: Bytes of an archive's contents, of one of its XML files, and how much smaller all may be packed.
MOST_BYTES, MOST_XML, MOST_RATIO = 8 << 30, 64 << 20, 500
MOST_MEMBERS = 20_000


class Package:
    """Members of an SSP by their names.

    path: the SSP, a folder, or a structure file (.ssd) in one. structure: name of the structure
    file. Raises SystemFault in one line, also for members that point outside, for one that unpacks
    to what no system has (a zip bomb), and for entities in its XML.
    """

    def __init__(self, path: Path):
        self.path = path
        self.structure = STRUCTURE
        self.remarks: list[str] = []
        self._archive: zipfile.ZipFile | None = None
        self._scratch: tempfile.TemporaryDirectory[str] | None = None
        if path.is_dir():
            self._root = path
        elif path.suffix.lower() == ".ssd":
            self._root, self.structure = path.parent, path.name
        else:
            self._archive = _opened(path)
            self._scratch = scratch_folder("ssp")
            self._root = Path(self._scratch.name)

    def xml(self, name: str) -> Element:
        """The root of an XML file."""
        return self.parsed(self._bytes(name), f"{self.path}: {name}")

    def parsed(self, content: bytes, place: str) -> Element:
        """The root of an XML text; document types are refused, and with them entities."""
        check_xml(f"{place}:", content, SystemFault)
        try:
            return fromstring(content)
        except ParseError as error:
            # some tools write annotations with a prefix that is declared nowhere
            declared = _declared(content)
            if declared == content:
                raise SystemFault(f"{place}: is not valid: {error}") from None
        self.remarks.append(f"{place}: uses a prefix that it has not declared")
        return self.parsed(declared, place)

    def file(self, source: str) -> Path:
        """A member as a file on disk, unpacked where it has to be."""
        name = self._inside(source)
        target = self._root / name
        if self._archive is not None and not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            try:
                with self._archive.open(name) as packed, target.open("wb") as unpacked:
                    shutil.copyfileobj(packed, unpacked)
            except KeyError:
                raise SystemFault(self._missing(source)) from None
            except (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, OSError) as error:
                raise SystemFault(f"{self.path}: {source} cannot be unpacked ({error})") from None
        if not target.is_file():
            raise SystemFault(self._missing(source))
        return target

    def others(self) -> list[str]:
        """Names of further structure files: variants, of which the standard one is taken."""
        if self._archive is None:
            return []
        return [
            name
            for name in self._archive.namelist()
            if name.lower().endswith(".ssd") and name != self.structure
        ]

    def close(self) -> None:
        """Remove what was unpacked."""
        if self._archive is not None:
            self._archive.close()
        if self._scratch is not None:
            self._scratch.cleanup()

    def _bytes(self, name: str) -> bytes:
        if self._archive is not None:
            for member in self._archive.infolist():
                if member.filename == name and member.file_size > MOST_XML:
                    raise SystemFault(
                        f"{self.path}: {name} unpacks to {member.file_size >> 20} MiB of XML, "
                        f"allowed are {MOST_XML >> 20}"
                    )
        try:
            return self.file(name).read_bytes()
        except OSError as error:
            raise SystemFault(f"{self.path}: {name} cannot be read ({error.strerror})") from None

    def _inside(self, source: str) -> str:
        """The name of a member from a reference to it; SystemFault for what is no member."""
        parts = urlsplit(source)
        if parts.scheme or parts.netloc:
            raise SystemFault(
                f"{self.path}: {source} is not in the package, allowed is a path within it"
            )
        name = unquote(parts.path)
        if self._archive is not None and _leads_out(name):
            raise SystemFault(
                f"{self.path}: {source} points outside the package, allowed is a path within it"
            )
        return PurePosixPath(name).as_posix()

    def _missing(self, source: str) -> str:
        return f"{self.path}: has no {source}" + (
            ", so it is no SSP"
            if source == self.structure
            else ", which its structure names, needed is that file"
        )


def _declared(content: bytes) -> bytes:
    """An XML text in which the root declares every prefix that it does not."""
    used = set(re.findall(rb"[<\s]/?([A-Za-z_][\w.-]*):[A-Za-z_]", content))
    unknown = used - {b"xml", b"xmlns", *re.findall(rb"xmlns:([\w.-]+)", content)}
    names = b"".join(b' xmlns:%b="undeclared:%b"' % (each, each) for each in sorted(unknown))
    return re.sub(rb"<([A-Za-z_][\w.:-]*)", lambda root: root[0] + names, content, count=1)


def _opened(path: Path) -> zipfile.ZipFile:
    if not path.exists():
        raise SystemFault(f"{path}: no such file, allowed is an SSP or a TOML file")
    try:
        archive = zipfile.ZipFile(path)
    except (zipfile.BadZipFile, EOFError, ValueError, OSError) as error:
        raise SystemFault(
            f"{path}: is no SSP, or truncated ({error}), allowed is a zip archive"
        ) from None
    try:
        check_members(path, archive, (MOST_BYTES, MOST_MEMBERS, MOST_RATIO), SystemFault)
    except SystemFault:
        archive.close()
        raise
    return archive


def _leads_out(name: str) -> bool:
    path = PurePosixPath(name.replace("\\", "/"))
    return path.is_absolute() or ".." in path.parts or ":" in name or "\x00" in name
