"""Files and folders of results: tried before anything is computed, whole when they are there."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path


class OutputRefused(ValueError):
    """A file or folder that cannot be written, found before anything is computed; one line."""


class OutputError(ValueError):
    """A result that was computed cannot be written; one line with the file and the reason."""


def writable(folder: Path, files: Iterable[str] = ()) -> Path:
    """Make a folder; OutputRefused when nothing can be written to it, or a name in it is taken."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass  # the only sure test: permissions do not bind everybody, a disk may be read-only
    except OSError as error:
        raise OutputRefused(
            f"{folder}: cannot be written to ({error.strerror}), allowed is a folder that can: "
            "name one with -o"
        ) from error
    not_taken(folder, files)
    return folder


def not_taken(folder: Path, files: Iterable[str]) -> None:
    """OutputRefused when a name that a file is to have is a folder's."""
    for name in files:
        if (folder / name).is_dir():
            raise OutputRefused(f"{folder / name}: is a folder, allowed is a file or nothing")


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
