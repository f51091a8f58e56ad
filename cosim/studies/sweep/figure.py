"""Features against the varied keys."""

from __future__ import annotations

import math

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

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
RC = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": "#D9D9D9",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
}
BLUE, BAND = "#0072B2", "#BFD9EA"
COLOURS = matplotlib.colormaps["viridis"]
PANEL = (2.9, 1.75)  # inches


def draw_sweep(dataset: xr.Dataset) -> Figure:
    """One row for each feature, one column for each varied dimension.

    With few lines in a panel there is one for each combination of the other dimensions, else
    their median in the range of all. Runs that failed are left out.
    """
    dims = [str(name) for name in dataset["status"].dims]
    with matplotlib.rc_context(RC):
        width, height = PANEL
        figure = Figure(
            (1.0 + max(width * len(dims), 1.6 * width), 1.2 + height * len(SHOWN)),
            layout="constrained",
        )
        panels = figure.subplots(len(SHOWN), len(dims), sharex="col", sharey="row", squeeze=False)
        for row, (feature, (label, factor)) in enumerate(SHOWN.items()):
            for column, dim in enumerate(dims):
                _draw(panels[row, column], factor * dataset[feature], dim)
            panels[row, 0].set_ylabel(label)
        for column, dim in enumerate(dims):
            _name_axis(panels[-1, column], dataset, dim)
            _explain(panels[0, column], dataset, dim, dims)
        figure.align_ylabels(panels[:, 0])
        complete = int(np.count_nonzero(dataset["status"] == 0))
        figure.suptitle(
            f"Sweep over {dataset.attrs['title']}: {complete} of {dataset['status'].size} "
            "combinations", x=0.01, ha="left",
        )
    return figure


def _draw(axes: Axes, values: xr.DataArray, dim: str) -> None:
    places = _places(values[dim])
    table = values.transpose(..., dim).values.reshape(-1, places.size)
    style = {"marker": "o", "markersize": 3.0, "linewidth": 1.3}
    if len(table) <= MOST_LINES:
        for line, colour in zip(table, _colours(len(table)), strict=True):
            axes.plot(places, line, color=colour, **style)
        return
    known = np.isfinite(table).any(axis=0)
    if known.any():
        low, middle, high = np.nanquantile(table[:, known], [0.0, 0.5, 1.0], axis=0)
        axes.fill_between(places[known], low, high, color=BAND, linewidth=0.0)
        axes.plot(places[known], middle, color=BLUE, **style)


def _colours(count: int) -> list:
    return [BLUE] if count == 1 else [COLOURS(0.9 * i / (count - 1)) for i in range(count)]


def _is_numeric(coordinate: xr.DataArray) -> bool:
    return np.issubdtype(coordinate.dtype, np.number)


def _places(coordinate: xr.DataArray) -> NDArray[np.float64]:
    """Where the values stand: at themselves, names side by side."""
    if _is_numeric(coordinate):
        return coordinate.values.astype(float)
    return np.arange(coordinate.size, dtype=float)


def _name_axis(axes: Axes, dataset: xr.Dataset, dim: str) -> None:
    coordinate = dataset[dim]
    unit = coordinate.attrs["units"]
    axes.set_xlabel(dim if unit == "1" else f"{dim} [{unit}]")
    if not _is_numeric(coordinate):
        labels = [str(label) for label in coordinate.values]
        long = sum(map(len, labels)) > 24
        axes.set_xticks(_places(coordinate), labels, rotation=60 if long else 0,
                        ha="right" if long else "center", rotation_mode="anchor")
        axes.set_xlim(-0.4, coordinate.size - 0.6)


def _explain(axes: Axes, dataset: xr.Dataset, dim: str, dims: list[str]) -> None:
    """What lines or band of a column are, over its first panel."""
    others = [name for name in dims if name != dim]
    lines = math.prod(dataset.sizes[name] for name in others)
    if not others or lines == 1:
        return
    if lines > MOST_LINES:
        axes.set_title("median and range of the others", fontsize=8.0, loc="left")
        return
    grid = np.indices([dataset.sizes[name] for name in others]).reshape(len(others), -1).T
    labels = [
        ", ".join(_shown(dataset[name].values[i]) for name, i in zip(others, place, strict=True))
        for place in grid
    ]
    axes.legend(
        axes.lines, labels, title=", ".join(others), fontsize=7.5, title_fontsize=7.5,
        loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=min(len(labels), 3),
        borderaxespad=0.0, columnspacing=1.0, handlelength=1.2,
    )


def _shown(value: object) -> str:
    return format(value, "g") if isinstance(value, float) else str(value)
