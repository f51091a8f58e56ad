"""Outcomes of a sweep: finished chunks on disk, found again by the next sweep, and one dataset.

A chunk is one JSON file that appears under its name only when it is complete. Rows are found by
their content key, so it does not matter which sweep they were computed for; chunks of another
version of the model lie in another folder. The varied keys are the dataset's dimensions.
"""

from __future__ import annotations

import hashlib
import json
import math
import warnings
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from cosim.files import OutputError, OutputRefused, writable, write_text
from cosim.report.files import provenance

from .combination import (
    COMPLETE,
    ERROR,
    STATUS_MEANINGS,
    Row,
    Run,
    SweepError,
    SweepStopped,
    model_version,
)
from .features import FEATURES
from .grid import Grid

FOLDER = "chunks"
VERSION_DIGITS = 12


class Store:
    """Rows in ``folder``/chunks; without a folder nothing is kept."""

    def __init__(self, folder: Path | None):
        self.folder = None if folder is None else folder / FOLDER / model_version()[:VERSION_DIGITS]
        if self.folder is not None:
            try:
                writable(self.folder)
            except OutputRefused as error:
                raise SweepError(str(error)) from error

    def read(self) -> dict[str, Row]:
        """Key -> row of everything that is kept."""
        rows: dict[str, Row] = {}
        for file in sorted(self.folder.glob("*.json")) if self.folder else ():
            rows |= {row.key: row for row in _read(file)}
        return rows

    def write(self, rows: Sequence[Row]) -> None:
        """Keep the rows of a chunk; those in ERROR are left out and computed again next time."""
        kept = [row for row in rows if row.status != ERROR]
        if self.folder is None or not kept:
            return
        name = hashlib.sha256("".join(row.key for row in kept).encode()).hexdigest()[:24]
        text = json.dumps([_plain(row) for row in kept], allow_nan=False)
        try:
            write_text(text, self.folder / f"{name}.json")
        except OutputError as error:
            raise SweepStopped(str(error)) from error


def _plain(row: Row) -> list:
    values = [value if math.isfinite(value) else None for value in row.values]
    return [row.key, row.status, row.reason, values]


def _read(file: Path) -> list[Row]:
    """A chunk's rows; none, with a warning, when the file is damaged."""
    try:
        entries = json.loads(file.read_text(encoding="utf-8"))
        return [
            Row(key, status, reason, tuple(math.nan if v is None else float(v) for v in values))
            for key, status, reason, values in entries
        ]
    except (ValueError, TypeError) as error:
        warnings.warn(f"{file}: damaged ({error}), its combinations are run again", stacklevel=2)
        return []


CODES = np.arange(len(STATUS_MEANINGS.split()), dtype=np.int8)


def sweep_dataset(grid: Grid, run: Run, rows: Sequence[Row]) -> xr.Dataset:
    """``rows``, in the grid's order, as variables over the grid's dimensions."""
    table = np.array([row.values for row in rows])
    variables: dict[str, Any] = {
        name: (grid.dims, table[:, i].reshape(grid.shape), {"units": unit, "long_name": text})
        for i, (name, (unit, text)) in enumerate(FEATURES.items())
    }
    status = np.array([row.status for row in rows], dtype=np.int8)
    reason = np.array([row.reason for row in rows], dtype=object)
    variables["status"] = (
        grid.dims,
        status.reshape(grid.shape),
        {
            "units": "1",
            "long_name": "how the run ended",
            "flag_values": CODES,
            "flag_meanings": STATUS_MEANINGS,
        },
    )
    variables["reason"] = (
        grid.dims,
        reason.reshape(grid.shape),
        {
            "units": "1",
            "long_name": "why the run is not complete; empty when it is",
        },
    )
    coordinates = {
        name: (axis.name, values, attributes)
        for axis in grid.axes
        for name, (values, attributes) in axis.coordinates.items()
    }
    return xr.Dataset(variables, coordinates, _attributes(grid, run, status))


def _attributes(grid: Grid, run: Run, status: np.ndarray) -> dict[str, object]:
    failed = int(np.count_nonzero(status != COMPLETE))
    return {
        "title": " x ".join(f"{axis.name} ({len(axis)})" for axis in grid.axes),
        "status": "complete" if not failed else f"{failed} of {status.size} combinations failed",
        "duration": run.duration,
        "output_interval": run.output_interval,
        "parameters": json.dumps(grid.base.model_dump(mode="json")),
        "model_version": model_version(),
        "stickslip": version("stickslip"),
        **provenance(),
    }
