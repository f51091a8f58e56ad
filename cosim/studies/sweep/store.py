"""Where finished combinations are kept for the next sweep.

A chunk of rows is one JSON file that appears under its name only when it is complete. Rows are
found by their content key, so it does not matter which sweep they were computed for; those of
another version of the model lie in another folder.
"""

from __future__ import annotations

import hashlib
import json
import warnings
from collections.abc import Sequence
from pathlib import Path

from cosim.files import OutputError, OutputRefused, writable, write_text

from .axis import SweepError
from .combination import ERROR, Row, SweepStopped

FOLDER = "chunks"
VERSION_DIGITS = 12


class Store:
    """Rows in ``folder``/chunks, of a version of the model; without a folder nothing is kept."""

    def __init__(self, folder: Path | None, version: str):
        self.folder = None if folder is None else folder / FOLDER / version[:VERSION_DIGITS]
        if self.folder is not None:
            try:
                writable(self.folder)
            except OutputRefused as error:
                raise SweepError(str(error)) from error

    def read(self) -> dict[str, Row]:
        """Key -> row of everything that is kept; a warning for a file that is damaged."""
        rows: dict[str, Row] = {}
        for file in sorted(self.folder.glob("*.json")) if self.folder else ():
            try:
                entries = json.loads(file.read_text(encoding="utf-8"))
                rows |= {key: Row(key, *outcome) for key, *outcome in entries}
            except (ValueError, TypeError) as error:
                said = f"{file}: damaged ({error}), its combinations are run again"
                warnings.warn(said, stacklevel=2)
        return rows

    def write(self, rows: Sequence[Row]) -> None:
        """Keep the rows of a chunk; those in ERROR are left out and computed again next time."""
        kept = [row for row in rows if row.status != ERROR]
        if self.folder is None or not kept:
            return
        name = hashlib.sha256("".join(row.key for row in kept).encode()).hexdigest()[:24]
        try:
            write_text(json.dumps(kept), self.folder / f"{name}.json")
        except OutputError as error:
            raise SweepStopped(str(error)) from error
