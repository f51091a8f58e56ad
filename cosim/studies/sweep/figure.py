"""Features against the varied keys."""

import math
import textwrap
from collections.abc import Sequence
from itertools import product
from typing import Any, Literal

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cosim.report.columns import Array
from cosim.report.page import unit_text
from cosim.report.palette import BLUE, FAINT_BLUE, INK, LIGHT_BLUE
from cosim.report.style import at_least, picture
from cosim.studies import FIGURES

from .features import ALL

# more lines than this in a panel are a tangle: their median and their range instead
MOST_LINES = 7
#: Of several lines: as dark and as light as is seen on white, and in the dark on black.
COLOURS, DARKEST, LIGHTEST = matplotlib.colormaps["viridis"], 0.1, 0.65
#: Inches: height of a panel, width of the figure, which is the page's.
HEIGHT, WIDTH = 1.75, 10.0
#: Panels side by side where one key is varied.
ABREAST = 3
#: Of the values: what varies by less is a nearly level line, and no zigzag over the whole panel.
SMALLEST_SPAN = 0.25
SMALL: Any = {"fontsize": 7.5, "title_fontsize": 7.5}


@picture("sweep", **FIGURES["sweep"])
def draw_sweep(dataset: xr.Dataset, names: Sequence[str]) -> Figure:
    """One row for each feature, one column for each varied dimension (three columns for one).

    names: of the features. With few lines in a panel there is one for each combination of the
    other dimensions, else their median, the middle half of them (darker) and their range. Runs that
    failed are left out.
    """
    dims = [str(name) for name in dataset["status"].dims]
    columns = len(dims) if len(dims) > 1 else min(ABREAST, len(names))
    figure, panels = _panels(len(dims), columns, len(names))
    for row, feature in zip(panels, names, strict=True):
        values, moves = ALL[feature].factor * dataset[feature], feature == "frequency"
        for axes, dim in zip(row, dims, strict=True):
            # 0 Hz is no frequency
            _draw(axes, values.where(values > 0.0) if moves else values, dim)
        # a range that is a small part of the values is not blown up to fill the axis
        at_least(row[0], SMALLEST_SPAN * max(map(abs, row[0].get_ylim())))
        row[0].set_ylabel(ALL[feature].label)
        for axes, dim in zip(row, dims, strict=True) if moves else ():
            _mark_none(axes, dataset, dim)
    lowest = len(names) - (1 if len(dims) > 1 else columns)
    for column, dim in enumerate(dims):
        for i, axes in enumerate(panels[:, column]):
            _name_axis(axes, dataset[dim], i >= lowest)
        _explain(panels[0, column], dataset, [name for name in dims if name != dim])
    complete = int(np.count_nonzero(dataset["status"] == 0))
    said = f"{dataset.attrs['title']}: {complete} of {dataset['status'].size} combinations"
    title = textwrap.fill(said, 100, break_long_words=False)
    figure.suptitle(title, x=0.01, ha="left")
    return figure


def _panels(dims: int, columns: int, features: int) -> tuple[Figure, NDArray[Any]]:
    """A figure and its panels (features, dims)."""
    rows = math.ceil(features * dims / columns)
    figure = Figure((WIDTH, 1.2 + HEIGHT * rows), layout="constrained")
    share: Literal["row", "none"] = "row" if dims > 1 else "none"
    panels = figure.subplots(rows, columns, sharex="col", sharey=share, squeeze=False)
    for place, axes in enumerate(panels.flat if dims == 1 else ()):
        axes.set_visible(place < features)
        if features - columns <= place < features:
            axes.tick_params(labelbottom=True)
    return figure, panels.ravel()[: features * dims].reshape(features, dims)


def _mark_none(axes: Axes, dataset: xr.Dataset, dim: str) -> None:
    """Crosses where a complete run has no stick-slip."""
    none = (dataset["frequency"] == 0.0) & (dataset["status"] == 0)
    at = none.any([name for name in none.dims if name != dim]).values
    places = _places(dataset[dim])[at]
    foot: Any = {"transform": axes.get_xaxis_transform(), "clip_on": False}
    if places.size:
        axes.plot(places, np.zeros(places.size), "x", color=INK, label="_none", **foot)


def _draw(axes: Axes, values: xr.DataArray, dim: str) -> None:
    """Lines over one dimension, or where there are many their spread."""
    if not np.isfinite(values).any():
        axes.text(0.5, 0.5, "none in these runs", ha="center", transform=axes.transAxes)
    places, numeric = _places(values[dim]), _is_numeric(values[dim])
    table = values.transpose(..., dim).values.reshape(-1, places.size)
    known = np.isfinite(table).any(axis=0)
    if len(table) > MOST_LINES and known.any():
        quantiles = np.nanquantile(table[:, known], [0.0, 0.25, 0.5, 0.75, 1.0], axis=0)
        _draw_spread(axes, places[known], quantiles, numeric)
    elif len(table) <= MOST_LINES:
        alone = len(table) == 1
        colours = [BLUE] if alone else COLOURS(np.linspace(DARKEST, LIGHTEST, len(table)))
        # the first is the widest, so that one which lies below another is seen beside it
        extra = [0.0] if alone else np.linspace(2.4, 0.0, len(table))
        for line, colour, more in zip(table, colours, extra, strict=True):
            size, width = 3.0 + 2.0 * more, 1.3 + more if numeric else 0.4
            axes.plot(places, line, color=colour, marker="o", markersize=size, linewidth=width)


def _draw_spread(axes: Axes, places: Array, quantiles: Array, numeric: bool) -> None:
    """Range, middle half and median (5, n): bands over numbers, bars over names."""
    low, quarter, middle, three_quarters, high = quantiles
    for bottom, top, colour in ((low, high, FAINT_BLUE), (quarter, three_quarters, LIGHT_BLUE)):
        if numeric and places.size > 1:
            axes.fill_between(places, bottom, top, color=colour, linewidth=0.0)
        else:
            axes.vlines(places, bottom, top, color=colour, linewidth=7.0)
    width = 1.3 if numeric else 0.0
    axes.plot(places, middle, color=BLUE, marker="o", markersize=3.0, linewidth=width)


def _is_numeric(coordinate: xr.DataArray) -> bool:
    return np.issubdtype(coordinate.dtype, np.number)


def _places(coordinate: xr.DataArray) -> Array:
    """Where the values stand: at themselves, names side by side."""
    at = coordinate.values if _is_numeric(coordinate) else np.arange(coordinate.size)
    return at.astype(float)


def titled(coordinate: xr.DataArray) -> str:
    """A dimension with its unit, if it has numbers."""
    if not _is_numeric(coordinate):
        return str(coordinate.name)
    return f"{coordinate.name} [{unit_text(coordinate.attrs['units'])}]"


def unit_of(coordinate: xr.DataArray) -> str:
    """As it stands behind a number; nothing for a plain number or a name."""
    unit = unit_text(coordinate.attrs["units"])
    return "" if unit == "1" else f" {unit}"


def _name_axis(axes: Axes, coordinate: xr.DataArray, last: bool) -> None:
    if last:
        axes.set_xlabel(titled(coordinate))
    if not _is_numeric(coordinate):
        labels = [str(label) for label in coordinate.values]
        long = sum(map(len, labels)) > 24
        style: Any = {"rotation": 60, "ha": "right"} if long else {"rotation": 0, "ha": "center"}
        axes.set_xticks(_places(coordinate), labels, rotation_mode="anchor", **style)
        axes.set_xlim(-0.4, coordinate.size - 0.6)


def _explain(axes: Axes, dataset: xr.Dataset, others: Sequence[str]) -> None:
    """What lines or band of a column are, over its first panel; others: dimensions beside its."""
    lines = math.prod(dataset.sizes[name] for name in others)
    if lines > MOST_LINES:
        axes.set_title("median, middle half, range", fontsize=8.0, loc="left")
    elif lines > 1:
        places = product(*(dataset[name].values for name in others))
        labels = [", ".join(_shown(value) for value in place) for place in places]
        place: Any = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "borderaxespad": 0.0}
        title = ", ".join(titled(dataset[name]) for name in others)
        columns: Any = {"ncols": min(lines, 3), "columnspacing": 1.0, "handlelength": 1.2}
        axes.legend(axes.lines[:lines], labels, title=title, **SMALL, **place, **columns)


def _shown(value: object) -> str:
    return format(value, "g") if isinstance(value, float) else str(value)
