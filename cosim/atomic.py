"""Files that appear under their names only when they are complete."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path


def write_atomically(path: Path, write: Callable[[Path], object]) -> None:
    """Let ``write`` fill a partial file beside ``path``, bring it to the disk, put it in place.

    An earlier file of that name stays as it was until then. Raises what ``write`` and the disk
    raise; no partial file is left.
    """
    partial = path.with_name(f".{path.name}.{os.getpid()}.partial")
    try:
        write(partial)
        with partial.open("rb+") as file:
            os.fsync(file.fileno())  # else a power cut may leave the name without the contents
        os.replace(partial, path)
    finally:
        if path.parent.is_dir():
            partial.unlink(missing_ok=True)
