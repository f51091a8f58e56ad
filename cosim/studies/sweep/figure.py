"""Features against the varied keys."""

from __future__ import annotations

import math
from typing import Any, Literal

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cosim.report.style import BLUE, picture

Array = NDArray[np.float64]

# feature -> label and factor to the unit in it
SHOWN = {
    "x_mean": ("mean x [mm]", 1e3),
    "x_std": ("std of x [mm]", 1e3),
    "phi_max": ("largest |φ| [°]", math.degrees(1.0)),
    "frequency": ("frequency [Hz]", 1.0),
    "slip_time": ("mean slip time [s]", 1.0),
    "slip_share": ("slip share [1]", 1.0),
    "friction_coefficient": ("mean friction / N [1]", 1.0),
    "heat": ("friction heat [J]", 1.0),
}
# more lines than this in a panel are a tangle: their median and their range instead
MOST_LINES = 7
HALF, BAND = "#8FBFDD", "#D3E5F0"
COLOURS = matplotlib.colormaps["viridis"]
PANEL = (2.9, 1.75)  # inches
SMALLEST_SPAN = 0.05


@picture(
    "sweep",
    "Features of the motion over the varied keys; runs that failed are left out.",
)
def draw_sweep(dataset: xr.Dataset) -> Figure:
    """One row for each feature, one column for each varied dimension (two columns for one).

    With few lines in a panel there is one for each combination of the other dimensions, else
    their median, the middle half of them (darker) and their range. Runs that failed are left out.
    """
    dims = [str(name) for name in dataset["status"].dims]
    figure, panels = _panels(dims)
    for row, (feature, (label, factor)) in zip(panels, SHOWN.items(), strict=True):
        for axes, dim in zip(row, dims, strict=True):
            _draw(axes, factor * dataset[feature], dim)
        _widen(row[0])
        row[0].set_ylabel(label)
    for column, dim in enumerate(dims):
        for axes in panels[:, column]:
            _name_axis(axes, dataset, dim)
        _explain(panels[0, column], dataset, dim, dims)
    complete = int(np.count_nonzero(dataset["status"] == 0))
    figure.suptitle(
        f"Sweep over {dataset.attrs['title']}: {complete} of {dataset['status'].size} combinations",
        x=0.01,
        ha="left",
    )
    return figure


def _panels(dims: list[str]) -> tuple[Figure, NDArray[Any]]:
    """A figure and its panels (features, dims)."""
    rows, columns = (len(SHOWN), len(dims)) if len(dims) > 1 else (math.ceil(len(SHOWN) / 2), 2)
    width, height = PANEL
    figure = Figure((1.0 + width * columns, 1.2 + height * rows), layout="constrained")
    share_y: Literal["row", "none"] = "row" if len(dims) > 1 else "none"
    panels = figure.subplots(rows, columns, sharex="col", sharey=share_y, squeeze=False)
    return figure, panels.reshape(len(SHOWN), len(dims))


def _widen(axes: Axes) -> None:
    """A range that is a small part of the values is not blown up to fill the axis."""
    low, high = axes.get_ylim()
    span = SMALLEST_SPAN * max(abs(low), abs(high))
    if high - low < span:
        middle = 0.5 * (low + high)
        axes.set_ylim(middle - 0.5 * span, middle + 0.5 * span)


def _draw(axes: Axes, values: xr.DataArray, dim: str) -> None:
    places = _places(values[dim])
    table = values.transpose(..., dim).values.reshape(-1, places.size)
    numeric = _is_numeric(values[dim])
    width = 1.3 if numeric else 0.4
    if len(table) <= MOST_LINES:
        for line, colour in zip(table, _colours(len(table)), strict=True):
            axes.plot(places, line, color=colour, marker="o", markersize=3.0, linewidth=width)
        return
    known = np.isfinite(table).any(axis=0)
    if known.any():
        quantiles = np.nanquantile(table[:, known], [0.0, 0.25, 0.5, 0.75, 1.0], axis=0)
        _draw_spread(axes, places[known], quantiles, numeric)


def _draw_spread(axes: Axes, places: Array, quantiles: Array, numeric: bool) -> None:
    """Range, middle half and median (5, n): bands over numbers, bars over names."""
    low, quarter, middle, three_quarters, high = quantiles
    for bottom, top, colour in ((low, high, BAND), (quarter, three_quarters, HALF)):
        if numeric and places.size > 1:
            axes.fill_between(places, bottom, top, color=colour, linewidth=0.0)
        else:
            axes.vlines(places, bottom, top, color=colour, linewidth=7.0)
    axes.plot(
        places, middle, color=BLUE, marker="o", markersize=3.0, linewidth=1.3 if numeric else 0.0
    )


def _colours(count: int) -> list:
    return [BLUE] if count == 1 else [COLOURS(0.9 * i / (count - 1)) for i in range(count)]


def _is_numeric(coordinate: xr.DataArray) -> bool:
    return np.issubdtype(coordinate.dtype, np.number)


def _places(coordinate: xr.DataArray) -> Array:
    """Where the values stand: at themselves, names side by side."""
    if _is_numeric(coordinate):
        return coordinate.values.astype(float)
    return np.arange(coordinate.size, dtype=float)


def _name_axis(axes: Axes, dataset: xr.Dataset, dim: str) -> None:
    coordinate = dataset[dim]
    unit = coordinate.attrs["units"].replace("degC", "°C")
    place = axes.get_subplotspec()
    if place is not None and place.is_last_row():
        axes.set_xlabel(dim if unit == "1" else f"{dim} [{unit}]")
    if not _is_numeric(coordinate):
        labels = [str(label) for label in coordinate.values]
        long = sum(map(len, labels)) > 24
        axes.set_xticks(
            _places(coordinate),
            labels,
            rotation=60 if long else 0,
            ha="right" if long else "center",
            rotation_mode="anchor",
        )
        axes.set_xlim(-0.4, coordinate.size - 0.6)


def _explain(axes: Axes, dataset: xr.Dataset, dim: str, dims: list[str]) -> None:
    """What lines or band of a column are, over its first panel."""
    others = [name for name in dims if name != dim]
    lines = math.prod(dataset.sizes[name] for name in others)
    if not others or lines == 1:
        return
    if lines > MOST_LINES:
        axes.set_title("median, middle half, range", fontsize=8.0, loc="left")
        return
    grid = np.indices([dataset.sizes[name] for name in others]).reshape(len(others), -1).T
    labels = [
        ", ".join(_shown(dataset[name].values[i]) for name, i in zip(others, place, strict=True))
        for place in grid
    ]
    axes.legend(
        axes.lines,
        labels,
        title=", ".join(others),
        fontsize=7.5,
        title_fontsize=7.5,
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        ncols=min(len(labels), 3),
        borderaxespad=0.0,
        columnspacing=1.0,
        handlelength=1.2,
    )


def _shown(value: object) -> str:
    return format(value, "g") if isinstance(value, float) else str(value)
