"""Results as files: NetCDF, CSV and JSON, and the versions of what made them."""

from __future__ import annotations

import json
import platform
from collections.abc import Mapping
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import xarray as xr

from cosim.atomic import write_atomically, write_text

PACKAGES = (
    "stickslip",
    "numpy",
    "numba",
    "scipy",
    "scikit-fem",
    "fmpy",
    "pythonfmu",
    "xarray",
    "h5netcdf",
    "matplotlib",
    "pydantic",
)


@cache
def versions() -> dict[str, str]:
    """Package -> version, Python and the platform first."""
    found = {"python": platform.python_version(), "platform": platform.platform()}
    return found | {name: _version(name) for name in PACKAGES}


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"


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
