"""Folders of results, tried before anything is computed."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable
from pathlib import Path


class OutputRefused(ValueError):
    """A file or folder that cannot be written; the message is one line."""


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
