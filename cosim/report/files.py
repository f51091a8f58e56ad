"""The data of a run as files."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import xarray as xr

from cosim.files import write_atomically, write_text


def write_netcdf(dataset: xr.Dataset, path: Path) -> Path:
    """The whole dataset as netCDF 4 (through h5netcdf)."""
    return write_atomically(path, lambda partial: dataset.to_netcdf(partial, engine="h5netcdf"))


def write_csv(dataset: xr.Dataset, path: Path) -> Path:
    """Everything over ``time`` as a table; numbers with the digits that restore them exactly."""
    names = [name for name in dataset.data_vars if dataset[name].dims == ("time",)]
    table = dataset[names].to_dataframe()
    return write_atomically(path, lambda partial: table.to_csv(partial))


def write_json(content: Mapping[str, Any], path: Path) -> Path:
    """A JSON file; NaN is refused, a missing number is null."""
    text = json.dumps(content, indent=2, allow_nan=False, ensure_ascii=False)
    return write_text(text + "\n", path)
