"""A sweep's rows as one dataset, whose dimensions are the varied keys."""

from __future__ import annotations

import json
from collections.abc import Sequence
from importlib.metadata import version
from typing import Any

import numpy as np
import xarray as xr

from cosim.report.files import provenance

from .combination import COMPLETE, STATUS_MEANINGS, Row, Run, model_version
from .features import FEATURES
from .grid import Grid

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
