"""A unit as a file, the same byte for byte for the same content, and known by it."""

import hashlib
import io
import uuid
import zipfile
from collections.abc import Mapping


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
