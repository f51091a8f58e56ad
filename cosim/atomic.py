"""Files that appear under their names only when they are complete."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path


class OutputError(ValueError):
    """A result file cannot be written; one line with the file and the reason."""


def write_atomically(path: Path, write: Callable[[Path], object]) -> Path:
    """Let ``write`` fill a partial file beside ``path``, bring it to the disk, put it in place.

    An earlier file of that name stays as it was until then. Raises OutputError where the disk
    refuses, and what ``write`` raises; no partial file is left.
    """
    partial = path.with_name(f".{path.name}.{os.getpid()}.partial")
    try:
        partial.touch()  # says in plain words why a folder refuses; HDF5 does not
        write(partial)
        with partial.open("rb+") as file:
            os.fsync(file.fileno())  # else a power cut may leave the name without the contents
        os.replace(partial, path)
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from error
    finally:
        if path.parent.is_dir():
            partial.unlink(missing_ok=True)
    return path


def write_text(text: str, path: Path) -> Path:
    """A text file in UTF-8."""
    return write_atomically(path, lambda partial: partial.write_text(text, encoding="utf-8"))


def write_bytes(content: bytes, path: Path) -> Path:
    """A binary file."""
    return write_atomically(path, lambda partial: partial.write_bytes(content))
