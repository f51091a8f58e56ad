"""Result files that appear under their names only when they are complete."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import xarray as xr

from cosim import atomic

from .errors import OutputError


def write_atomically(path: Path, write: Callable[[Path], object]) -> Path:
    """`atomic.write_atomically`, with OutputError when the disk refuses."""

    def touch_and_write(partial: Path) -> None:
        partial.touch()  # says in plain words why a folder refuses; HDF5 does not
        write(partial)

    try:
        atomic.write_atomically(path, touch_and_write)
    except OSError as error:
        raise OutputError(f"{path}: cannot be written: {error.strerror or error}") from error
    return path


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


def write_text(text: str, path: Path) -> Path:
    """A text file in UTF-8."""
    return write_atomically(path, lambda partial: partial.write_text(text, encoding="utf-8"))


def write_bytes(content: bytes, path: Path) -> Path:
    """A binary file."""
    return write_atomically(path, lambda partial: partial.write_bytes(content))
