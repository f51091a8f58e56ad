"""A unit as a file, the same byte for byte for the same content, and known by it.

Beside its model every unit has licences, an icon and, for FMI 3, the terminals it has. A terminal
groups what is connected together; two of the same kind fit each other member by member (FMI 3.0,
section 2.4.9).
"""

import hashlib
import io
import uuid
import zipfile
from collections.abc import Iterable, Mapping
from importlib.metadata import distribution
from importlib.resources import files
from typing import Any

from cosim.fmu.description import xml_of
from cosim.fmu.libraries import FMI2, FMI3
from cosim.fmu.variables import DECLARED, Variable


def packed(files: Mapping[str, bytes]) -> bytes:
    """The zip of path -> content, in the order of the paths and without a date."""
    result = io.BytesIO()
    with zipfile.ZipFile(result, "w") as archive:
        for name in sorted(files):
            entry = zipfile.ZipInfo(name, date_time=(1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o755 << 16 if name.startswith("binaries/") else 0o644 << 16
            archive.writestr(entry, files[name], compresslevel=9)
    return result.getvalue()


def digest_of(files: Mapping[str, bytes]) -> "hashlib._Hash":
    """SHA-256 of name -> content, of which no two can be taken for each other."""
    digest = hashlib.sha256()
    for name, content in sorted(files.items()):
        digest.update(f"{name}\0{len(content)}\0".encode())
        digest.update(content)
    return digest


def guid_of(name: str, content: str) -> str:
    """The GUID of a unit, by its name and the digest of what it is made from."""
    return str(uuid.uuid5(uuid.NAMESPACE_URL, f"{name}/{content}"))


LICENSES = "documentation/licenses"
#: Kind of terminal -> what it is, and member -> variables that it may be, of which a unit has one.
TERMINALS: Mapping[str, Any] = DECLARED["terminals"]


def extras(
    variables: Iterable[Variable] = (), fmi: int = FMI2, others: Iterable[str] = ()
) -> dict[str, bytes]:
    """Path in the unit -> content. others: distributions whose code travels in it, too."""
    found = {f"{LICENSES}/license.txt": _license("stickslip")}
    for name in others:
        found[f"{LICENSES}/{name}.txt"] = _license(name)
    if fmi == FMI3:
        found["terminalsAndIcons/terminalsAndIcons.xml"] = terminals([*variables])
        found["terminalsAndIcons/icon.png"] = _icon("png")
        found["terminalsAndIcons/icon.svg"] = _icon("svg")
    else:
        found["model.png"] = _icon("png")
    return found


def _license(name: str) -> bytes:
    text = distribution(name).read_text("licenses/LICENSE")
    if not text:
        raise ValueError(f"the licence of {name} is not installed with it: licenses/LICENSE")
    return text.encode("utf-8")


def _icon(kind: str) -> bytes:
    return (files("cosim.fmu.description") / f"icon.{kind}").read_bytes()


def terminals(variables: Iterable[Variable]) -> bytes:
    """terminalsAndIcons.xml: those of `TERMINALS` of which a unit has every member."""
    known = {variable.name for variable in variables}
    found = {}
    for kind, told in TERMINALS.items():
        has = {
            member: next((name for name in names if name in known), None)
            for member, names in told["members"].items()
        }
        if None not in has.values():
            found[kind] = told["says"], has
    return xml_of("terminals.xml.j2", terminals=found)
