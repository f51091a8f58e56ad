"""What a run has over its axes, with units, and as files: a small part of what xarray has.

The names are xarray's, whose import takes longer than a run, and both serve whoever reads a run:
`Columns` are what a command computes, a dataset is what a file or a user's program has.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, overload

import numpy as np
from numpy.typing import NDArray

from cosim.files import write_atomically

from .files import no_formula, require_room

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
#: What a run is read from.
Data: TypeAlias = "xr.Dataset | Columns"


@dataclass(frozen=True)
class Column:
    """Values over axes, and what is known of them: units, long_name, ..."""

    dims: tuple[str, ...]
    values: NDArray[Any]
    attrs: Mapping[str, Any] = field(default_factory=dict)

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the values."""
        return self.values.dtype

    @property
    def size(self) -> int:
        """Number of values."""
        return self.values.size

    def __getitem__(self, place: int) -> Any:
        return self.values[place]

    def max(self) -> Any:
        """The largest value that is known."""
        return np.nanmax(self.values)

    def __float__(self) -> float:
        return float(self.values)

    def at(self, rows: Mapping[str, Any]) -> Column:
        """Of these rows of some axes."""
        places = tuple(rows.get(axis, slice(None)) for axis in self.dims)
        dims = tuple(axis for axis in self.dims if not isinstance(rows.get(axis), int))
        return Column(dims, self.values[places], self.attrs)


@dataclass(frozen=True, eq=False)
class Columns:
    """Columns by their names, `coords` those that are axes themselves."""

    data_vars: dict[str, Column]
    coords: dict[str, Column]
    attrs: dict[str, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, data: Data) -> Columns:
        """The columns of a dataset; columns as they are."""
        if isinstance(data, Columns):
            return data

        def taken(variables: Mapping[Any, xr.DataArray]) -> dict[str, Column]:
            return {
                str(name): Column(tuple(map(str, each.dims)), each.values, dict(each.attrs))
                for name, each in variables.items()
            }

        return cls(taken(data.data_vars), taken(data.coords), dict(data.attrs))

    @overload
    def __getitem__(self, name: str) -> Column: ...
    @overload
    def __getitem__(self, name: list[str]) -> Columns: ...
    def __getitem__(self, name: str | list[str]) -> Column | Columns:
        if isinstance(name, str):
            return self.data_vars[name] if name in self.data_vars else self.coords[name]
        kept = {each: self.data_vars[each] for each in name}
        axes = {axis for each in kept.values() for axis in each.dims}
        coords = {axis: each for axis, each in self.coords.items() if axis in axes}
        return Columns(kept, coords, self.attrs)

    def __contains__(self, name: object) -> bool:
        return name in self.data_vars or name in self.coords

    def __iter__(self) -> Iterator[str]:
        return iter(self.data_vars)

    @property
    def variables(self) -> dict[str, Column]:
        """All of them, the axes first."""
        return {**self.coords, **self.data_vars}

    @property
    def sizes(self) -> dict[str, int]:
        """Rows of each axis."""
        return {name: each.values.size for name, each in self.coords.items()}

    def isel(self, **rows: Any) -> Columns:
        """Of some rows of an axis: a slice, places, or a single one."""
        variables, coords = (
            {name: each.at(rows) for name, each in columns.items()}
            for columns in (self.data_vars, self.coords)
        )
        return Columns(variables, coords, self.attrs)

    def sel(self, **spans: slice) -> Columns:
        """Between two values of a rising axis, both of them with it."""
        rows = {}
        for axis, span in spans.items():
            values = self.coords[axis].values
            begin = 0 if span.start is None else np.searchsorted(values, span.start, "left")
            end = None if span.stop is None else np.searchsorted(values, span.stop, "right")
            rows[axis] = slice(begin, end)
        return self.isel(**rows)

    def merge(self, other: Columns) -> Columns:
        """With the columns of another, which are not among these."""
        return Columns(
            {**self.data_vars, **other.data_vars}, {**self.coords, **other.coords}, self.attrs
        )

    def with_rows(self, *others: Columns) -> Columns:
        """With the rows of others, all of the same columns over the same rising axis."""
        (axis,) = self.coords
        parts = (self, *others)
        order = np.argsort(np.concatenate([part[axis].values for part in parts]), kind="stable")
        joined = {
            name: Column(
                each.dims, np.concatenate([part[name].values for part in parts])[order], each.attrs
            )
            for name, each in self.variables.items()
        }
        return Columns(joined, {axis: joined.pop(axis)}, self.attrs)

    def to_xarray(self) -> xr.Dataset:
        """The same as a dataset."""
        import xarray as xr

        values, axes = (
            {name: (each.dims, each.values, dict(each.attrs)) for name, each in columns.items()}
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
            file.dimensions = columns.sizes
            for name, each in columns.variables.items():
                missing = np.nan if each.dtype.kind == "f" else None
                made = file.create_variable(
                    name, each.dims, each.dtype, data=each.values, fillvalue=missing
                )
                made.attrs.update(each.attrs)

    return write_atomically(path, write)


def write_columns_as_csv(columns: Columns, axis: str, path: Path) -> Path:
    """All over an axis as a table, itself first, with the digits that restore numbers exactly."""
    shown = {name: each for name, each in columns.variables.items() if each.dims == (axis,)}
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
