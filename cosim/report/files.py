"""Results as files, of every command: NetCDF, CSV and JSON, and what made them."""

from __future__ import annotations

import json
import platform
from collections.abc import Mapping
from datetime import UTC, datetime
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any, Literal

import xarray as xr

from cosim.files import write_atomically, write_text

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


def provenance() -> dict[str, str]:
    """What every dataset says of its making: versions (JSON) and the time, UTC."""
    return {
        "versions": json.dumps(versions()),
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
    }


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


def write_netcdf(dataset: xr.Dataset | Mapping[str, xr.Dataset], path: Path) -> Path:
    """netCDF 4 (through h5netcdf): a dataset, or several by the name of their group ("": root)."""
    groups = {"": dataset} if isinstance(dataset, xr.Dataset) else dataset

    def write(partial: Path) -> None:
        mode: Literal["w", "a"] = "w"
        for group, one in groups.items():
            one.to_netcdf(partial, mode=mode, group=group or None, engine="h5netcdf")
            mode = "a"

    return write_atomically(path, write)


def write_csv(dataset: xr.Dataset, path: Path) -> Path:
    """Everything over ``time`` as a table; numbers with the digits that restore them exactly."""
    names = [name for name in dataset.data_vars if dataset[name].dims == ("time",)]
    table = dataset[names].to_dataframe()
    return write_atomically(path, lambda partial: table.to_csv(partial))


def write_json(content: Mapping[str, Any], path: Path) -> Path:
    """A JSON file; NaN is refused, a missing number is null."""
    text = json.dumps(content, indent=2, allow_nan=False, ensure_ascii=False)
    return write_text(text + "\n", path)
