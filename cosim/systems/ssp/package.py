"""An SSP, or a folder of the same contents, opened with care: what is in it comes from others."""

import re
import tempfile
from pathlib import Path, PurePosixPath
from urllib.parse import unquote, urlsplit
from xml.etree.ElementTree import Element, ParseError, fromstring

from cosim.coupling.fmu.archive import check_xml, unpack
from cosim.systems.specification import SystemFault

STRUCTURE = "SystemStructure.ssd"
#: Bytes of an archive's contents, members, and how much smaller all may be packed.
MOST = (8 << 30, 20_000, 500)
#: Bytes of one XML file.
MOST_XML = 64 << 20


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
        self._scratch: tempfile.TemporaryDirectory[str] | None = None
        if path.is_dir():
            self._root = path
        elif path.suffix.lower() == ".ssd":
            self._root, self.structure = path.parent, path.name
        else:
            fault = "is no SSP, or truncated, allowed is a zip archive"
            self._scratch = unpack(path, MOST, SystemFault, fault)
            self._root = Path(self._scratch.name)

    def xml(self, name: str) -> Element:
        """The root of an XML file; document types are refused, and with them entities."""
        file, place = self.file(name), f"{self.path}: {name}"
        try:
            if (size := file.stat().st_size) > MOST_XML:
                raise SystemFault(
                    f"{place} is {size >> 20} MiB of XML, allowed are {MOST_XML >> 20}"
                )
            content = file.read_bytes()
        except OSError as error:
            raise SystemFault(f"{place} cannot be read ({error.strerror})") from None
        check_xml(f"{place}:", content, SystemFault)
        try:
            return fromstring(content)
        except ParseError:  # some tools write annotations with a prefix that is declared nowhere
            self.remarks.append(f"{place}: uses a prefix that it has not declared")
        try:
            return fromstring(_declared(content))
        except ParseError as error:
            raise SystemFault(f"{place}: is not valid: {error}") from None

    def file(self, source: str) -> Path:
        """A member as a file on disk, by a reference to it."""
        parts = urlsplit(source)
        if parts.scheme or parts.netloc:
            raise SystemFault(
                f"{self.path}: {source} is not in the package, allowed is a path within it"
            )
        name = unquote(parts.path)
        if self._scratch is not None and _leads_out(name):
            raise SystemFault(
                f"{self.path}: {source} points outside the package, allowed is a path within it"
            )
        if (target := self._root / name).is_file():
            return target
        needed = ", which its structure names, needed is that file"
        told = ", so it is no SSP" if source == self.structure else needed
        raise SystemFault(f"{self.path}: has no {source}{told}")

    def others(self) -> list[str]:
        """Names of further structure files: variants, of which the standard one is taken."""
        if self._scratch is None:
            return []
        files = (file.relative_to(self._root).as_posix() for file in self._root.rglob("*"))
        return sorted(n for n in files if n.lower().endswith(".ssd") and n != self.structure)

    def close(self) -> None:
        """Remove what was unpacked."""
        if self._scratch is not None:
            self._scratch.cleanup()


def _declared(content: bytes) -> bytes:
    """An XML text in which the root declares every prefix that it does not."""
    used = set(re.findall(rb"[<\s]/?([A-Za-z_][\w.-]*):[A-Za-z_]", content))
    unknown = used - {b"xml", b"xmlns", *re.findall(rb"xmlns:([\w.-]+)", content)}
    names = b"".join(b' xmlns:%b="undeclared:%b"' % (each, each) for each in sorted(unknown))
    return re.sub(rb"<([A-Za-z_][\w.:-]*)", lambda root: root[0] + names, content, count=1)


def _leads_out(name: str) -> bool:
    path = PurePosixPath(name.replace("\\", "/"))
    return path.is_absolute() or ".." in path.parts or ":" in name or "\x00" in name
