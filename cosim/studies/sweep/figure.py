"""Features against the varied keys."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Collection, Sequence
from typing import Any, Literal

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cosim.names import nearest
from cosim.report.style import BLUE, FAINT_BLUE, INK, LIGHT_BLUE, picture

from .errors import SweepError

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
    "interface_rise": ("interface's rise [K]", 1.0),
    "belt_entry_rise": ("belt's rise at entry [K]", 1.0),
    "ice_face_rise": ("ice face's rise [K]", 1.0),
    "belt_share": ("belt's share of heat [1]", 1.0),
    "melted_mass": ("melted ice [g]", 1e3),
    # where they are asked for
    "x_min": ("smallest x [mm]", 1e3),
    "x_max": ("largest x [mm]", 1e3),
    "y_mean": ("mean y [mm]", 1e3),
    "kinetic_coefficient": ("friction in slip / N [1]", 1.0),
    "sliding_distance": ("sliding distance [m]", 1.0),
    "interface_drift": ("interface's drift [K]", 1.0),
    "energy_residual": ("energy residual [J]", 1.0),
    "heat_residual": ("heat residual [J]", 1.0),
}
#: Those that nobody has to ask for.
USUAL = list(SHOWN)[:13]
#: What varies less than this, in parts of its size, is told in a line and not drawn.
STILL = 1e-3
#: Sizes below which a feature is nothing: its own unit's, not the label's.
NOTHING = {"phi_max": 1e-4, "melted_mass": 1e-9, "x_mean": 1e-7, "x_std": 1e-7}
# more lines than this in a panel are a tangle: their median and their range instead
MOST_LINES = 7
HALF, BAND = LIGHT_BLUE, FAINT_BLUE
COLOURS = matplotlib.colormaps["viridis"]
PANEL = (2.9, 1.75)  # inches
SMALLEST_SPAN = 0.05


def shown_features(dataset: xr.Dataset, asked: Sequence[str] = ()) -> tuple[list[str], list[str]]:
    """Features to be drawn, and those that are the same in all runs; asked: by name."""
    if asked:
        return list(dict.fromkeys(asked)), []
    there = [name for name in USUAL if name in dataset]
    drawn = [name for name in there if _varies(dataset[name])]
    return drawn or there[:1], [name for name in there if name not in drawn]


def check_shown(asked: Sequence[str], features: Collection[str]) -> None:
    """SweepError for a name that is none of the features of a sweep."""
    known = [one for one in SHOWN if one in features]
    for name in asked:
        if name not in known:
            near = nearest(name, known)
            hint = f"nearest: {near}" if near else f"allowed: {', '.join(known)}"
            raise SweepError(f"--show {name}: is no feature of this sweep, {hint}")


def _varies(values: xr.DataArray) -> bool:
    known = values.values[np.isfinite(values.values)]
    if known.size < 2:
        return False
    size = max(float(np.abs(known).max()), NOTHING.get(str(values.name), 0.0))
    return bool(np.ptp(known) > STILL * size)


def still_sentence(dataset: xr.Dataset, names: Sequence[str]) -> str:
    """What is the same in all runs, in a sentence; "" where nothing is."""
    said, none = [], []
    for name in names:
        label, factor = SHOWN[name]
        words, _, unit = label.removesuffix("]").partition(" [")
        known = dataset[name].values[np.isfinite(dataset[name].values)]
        if not known.size:
            none.append(words)
            continue
        if name == "frequency" and not known.any():
            said.append("no stick-slip")
            continue
        value = float(np.mean(known)) * factor
        nothing = abs(value) <= NOTHING.get(name, 0.0) * factor
        number = "0" if nothing else f"{value:.3g}"
        where = " (where there is one)" if known.size < dataset[name].size else ""
        said.append(f"{words} {number}{f' {unit}' if unit != '1' else ''}{where}")
    same = [f"The same in all runs: {', '.join(said)}."] if said else []
    absent = (
        [f"In no run, for want of cycles at constant speed: {', '.join(none)}."] if none else []
    )
    return " ".join(same + absent)


@picture(
    "sweep",
    "Features of the motion over the varied keys; what does not vary is left out, and so are runs"
    " that failed. A cross at the foot of a frequency: the block does not stick and slip there."
    " Where lines lie on each other, the thinner is on the wider.",
)
def draw_sweep(dataset: xr.Dataset, features: Sequence[str] = ()) -> Figure:
    """One row for each feature, one column for each varied dimension (two columns for one).

    features: by name; those that vary when left out. With few lines in a panel there is one for
    each combination of the other dimensions, else their median, the middle half of them (darker)
    and their range. Runs that failed are left out.
    """
    dims = [str(name) for name in dataset["status"].dims]
    names = list(features) or shown_features(dataset)[0]
    figure, panels = _panels(dims, len(names))
    for row, feature in zip(panels, names, strict=True):
        label, factor = SHOWN[feature]
        for axes, dim in zip(row, dims, strict=True):
            _draw(axes, factor * _moving(dataset, feature), dim)
        _widen(row[0])
        row[0].set_ylabel(label)
    for row, feature in zip(panels, names, strict=True):
        if feature == "frequency":
            for axes, dim in zip(row, dims, strict=True):
                _mark_none(axes, dataset, dim)
    for column, dim in enumerate(dims):
        lowest = len(names) - (1 if len(dims) > 1 else min(2, len(names)))
        for i, axes in enumerate(panels[:, column]):
            _name_axis(axes, dataset, dim, i >= lowest)
        _explain(panels[0, column], dataset, dim, dims)
    complete = int(np.count_nonzero(dataset["status"] == 0))
    columns = panels.shape[1] if len(dims) > 1 else min(2, len(names))
    said = f"{dataset.attrs['title']}: {complete} of {dataset['status'].size} combinations"
    figure.suptitle(
        textwrap.fill(said, 12 + 32 * columns, break_long_words=False),
        x=0.01,
        ha="left",
    )
    return figure


def _moving(dataset: xr.Dataset, feature: str) -> xr.DataArray:
    """A feature; no frequency where the block does not stick and slip, for 0 Hz is none."""
    values = dataset[feature]
    return values.where(values > 0.0) if feature == "frequency" else values


def _mark_none(axes: Axes, dataset: xr.Dataset, dim: str) -> None:
    """Crosses where a complete run has no stick-slip."""
    none = (dataset["frequency"] == 0.0) & (dataset["status"] == 0)
    others = [name for name in none.dims if name != dim]
    at = none.any(others).values
    if at.any():
        axes.plot(
            _places(dataset[dim])[at],
            np.zeros(np.count_nonzero(at)),
            "x",
            color=INK,
            transform=axes.get_xaxis_transform(),
            clip_on=False,
            label="_none",
        )


def _panels(dims: list[str], features: int) -> tuple[Figure, NDArray[Any]]:
    """A figure and its panels (features, dims)."""
    columns = len(dims) if len(dims) > 1 else min(2, features)
    rows = features if len(dims) > 1 else math.ceil(features / columns)
    width, height = PANEL
    figure = Figure((1.0 + width * columns, 1.2 + height * rows), layout="constrained")
    share_y: Literal["row", "none"] = "row" if len(dims) > 1 else "none"
    panels = figure.subplots(rows, columns, sharex="col", sharey=share_y, squeeze=False)
    if len(dims) > 1:
        return figure, panels
    for spare in panels.ravel()[features:]:
        spare.set_visible(False)
    for axes in panels.ravel()[max(features - columns, 0) : features]:
        axes.tick_params(labelbottom=True)
    return figure, panels.ravel()[:features].reshape(features, 1)


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
        # the first is the widest, so that one which lies below another is seen beside it
        extra = np.linspace(2.4, 0.0, len(table)) if len(table) > 1 else [0.0]
        for line, colour, more in zip(table, _colours(len(table)), extra, strict=True):
            size, wide = 3.0 + 2.0 * more, width + more if numeric else width
            axes.plot(places, line, color=colour, marker="o", markersize=size, linewidth=wide)
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


def _name_axis(axes: Axes, dataset: xr.Dataset, dim: str, last: bool) -> None:
    coordinate = dataset[dim]
    unit = coordinate.attrs["units"].replace("degC", "°C")
    if last:
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
        axes.lines[: len(labels)],
        labels,
        title=", ".join(_titled(dataset[name]) for name in others),
        fontsize=7.5,
        title_fontsize=7.5,
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        ncols=min(len(labels), 3),
        borderaxespad=0.0,
        columnspacing=1.0,
        handlelength=1.2,
    )


def _titled(coordinate: xr.DataArray) -> str:
    """A dimension with its unit."""
    unit = coordinate.attrs["units"].replace("degC", "°C")
    return str(coordinate.name) if unit == "1" else f"{coordinate.name} [{unit}]"


def _shown(value: object) -> str:
    return format(value, "g") if isinstance(value, float) else str(value)
