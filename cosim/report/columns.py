"""Columns with units over their axes, to files, without xarray, which takes a second to import.

They have the names that an `xarray.Dataset` has for the same, and become one where it is asked for.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cosim.files import write_atomically

from .files import no_formula, require_room

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Column:
    """Values (n,) over an axis, and what is known of them: units, long_name, ..."""

    axis: str
    values: NDArray[Any]
    attrs: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Columns:
    """Columns by their names, `coords` those that are axes themselves."""

    data_vars: Mapping[str, Column]
    coords: Mapping[str, Column]
    attrs: Mapping[str, Any]

    def __getitem__(self, name: str) -> Column:
        return self.variables[name]

    @property
    def variables(self) -> dict[str, Column]:
        """All of them, the axes first."""
        return {**self.coords, **self.data_vars}

    def to_xarray(self) -> xr.Dataset:
        """The same as a dataset."""
        import xarray as xr

        values, axes = (
            {name: (each.axis, each.values, dict(each.attrs)) for name, each in columns.items()}
            for columns in (self.data_vars, self.coords)
        )
        return xr.Dataset(values, axes, dict(self.attrs))


def write_columns(columns: Columns, path: Path) -> Path:
    """netCDF 4, as xarray writes it: NaN marks what is missing."""
    import h5netcdf

    def write(partial: Path) -> None:
        arrays = [each.values for each in columns.variables.values()]
        require_room(partial, sum(array.nbytes for array in arrays), len(arrays))
        with h5netcdf.File(partial, "w") as file:
            file.attrs.update(columns.attrs)
            file.dimensions = {name: each.values.size for name, each in columns.coords.items()}
            for name, each in columns.variables.items():
                missing = np.nan if each.values.dtype.kind == "f" else None
                made = file.create_variable(
                    name, (each.axis,), each.values.dtype, data=each.values, fillvalue=missing
                )
                made.attrs.update(each.attrs)

    return write_atomically(path, write)


def write_columns_as_csv(columns: Columns, axis: str, path: Path) -> Path:
    """All over an axis as a table, itself first, with the digits that restore numbers exactly."""
    shown = {name: each for name, each in columns.variables.items() if each.axis == axis}
    rows = zip(*(_cells(each.values) for each in shown.values()), strict=True)

    def write(partial: Path) -> None:
        with partial.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(map(no_formula, shown))
            writer.writerows(rows)

    return write_atomically(path, write)


def _cells(values: NDArray[Any]) -> list[Any]:
    cells: list[Any] = values.tolist()
    return [None if cell != cell else cell for cell in cells] if np.isnan(values).any() else cells
