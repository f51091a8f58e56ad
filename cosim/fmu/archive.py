"""A unit as a file: a zip that is the same, byte for byte, for the same content."""

from __future__ import annotations

import io
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
