"""Features against the varied keys."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Collection, Sequence
from itertools import product
from typing import Any, Literal

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cosim.names import nearest
from cosim.report.page import unit_text
from cosim.report.palette import BLUE, FAINT_BLUE, INK, LIGHT_BLUE
from cosim.report.style import at_least, picture

from .axis import SweepError
from .features import ALL

Array = NDArray[np.float64]

#: What varies less than this, in parts of its size, is told in a line and not drawn.
STILL = 1e-3
# more lines than this in a panel are a tangle: their median and their range instead
MOST_LINES = 7
HALF, BAND = LIGHT_BLUE, FAINT_BLUE
COLOURS = matplotlib.colormaps["viridis"]
#: As far as it is seen on white, and in the dark on black.
DARKEST, LIGHTEST = 0.1, 0.65
#: Inches: height of a panel, width of the figure, which is the page's.
HEIGHT, WIDTH = 1.75, 10.0
#: Panels side by side where one key is varied.
ABREAST = 3
#: Of the values: what varies by less is a nearly level line, and no zigzag over the whole panel.
SMALLEST_SPAN = 0.25


def shown_features(dataset: xr.Dataset, asked: Sequence[str] = ()) -> tuple[list[str], list[str]]:
    """Features to be drawn, and those that are the same in all runs; asked: by name."""
    if asked:
        return list(dict.fromkeys(asked)), []
    there = [name for name, one in ALL.items() if one.usual and name in dataset]
    drawn = [name for name in there if _varies(dataset[name])]
    return drawn or there[:1], [name for name in there if name not in drawn]


def check_shown(asked: Sequence[str], features: Collection[str]) -> None:
    """SweepError for a name that is none of the features of a sweep."""
    known = [name for name in ALL if name in features]
    for name in asked:
        if name not in known:
            near = nearest(name, known)
            hint = f"nearest: {near}" if near else f"allowed: {', '.join(known)}"
            raise SweepError(f"--show {name}: is no feature of this sweep, {hint}")


def _varies(values: xr.DataArray) -> bool:
    known = values.values[np.isfinite(values.values)]
    if known.size < 2:
        return False
    size = max(float(np.abs(known).max()), ALL[str(values.name)].nothing)
    return bool(np.ptp(known) > STILL * size)


def still_sentence(dataset: xr.Dataset, names: Sequence[str]) -> str:
    """What is the same in all runs, in a sentence; "" where nothing is."""
    said, none = [], []
    for name in names:
        feature = ALL[name]
        words, _, unit = feature.label.removesuffix("]").partition(" [")
        known = dataset[name].values[np.isfinite(dataset[name].values)]
        if not known.size:
            none.append(words)
        elif name == "frequency" and not known.any():
            said.append("no stick-slip")
        else:
            value = float(np.mean(known)) * feature.factor
            nothing = abs(value) <= feature.nothing * feature.factor
            of_unit = f" {unit}" if unit != "1" else ""
            where = " (where there is one)" if known.size < dataset[name].size else ""
            said.append(f"{words} {'0' if nothing else f'{value:.3g}'}{of_unit}{where}")
    sentences = [f"The same in all runs: {', '.join(said)}."] if said else []
    if none:
        absent = "In no run, for want of cycles at constant speed"
        sentences.append(f"{absent}: {', '.join(none)}.")
    return " ".join(sentences)


@picture(
    "sweep",
    "Features of the motion over the varied keys; what does not vary is left out, and so are runs"
    " that failed. A cross at the foot of a frequency: the block does not stick and slip there."
    " Where lines lie on each other, the thinner is on the wider.",
)
def draw_sweep(dataset: xr.Dataset, features: Sequence[str] = ()) -> Figure:
    """One row for each feature, one column for each varied dimension (three columns for one).

    features: by name; those that vary when left out. With few lines in a panel there is one for
    each combination of the other dimensions, else their median, the middle half of them (darker)
    and their range. Runs that failed are left out.
    """
    dims = [str(name) for name in dataset["status"].dims]
    names = list(features) or shown_features(dataset)[0]
    figure, panels = _panels(dims, len(names))
    for row, feature in zip(panels, names, strict=True):
        for axes, dim in zip(row, dims, strict=True):
            _draw(axes, ALL[feature].factor * _moving(dataset, feature), dim)
        # a range that is a small part of the values is not blown up to fill the axis
        at_least(row[0], SMALLEST_SPAN * max(map(abs, row[0].get_ylim())))
        row[0].set_ylabel(ALL[feature].label)
        for axes, dim in zip(row, dims, strict=True) if feature == "frequency" else ():
            _mark_none(axes, dataset, dim)
    columns = len(dims) if len(dims) > 1 else min(ABREAST, len(names))
    for column, dim in enumerate(dims):
        lowest = len(names) - (1 if len(dims) > 1 else columns)
        for i, axes in enumerate(panels[:, column]):
            _name_axis(axes, dataset[dim], i >= lowest)
        _explain(panels[0, column], dataset, dim, dims)
    complete = int(np.count_nonzero(dataset["status"] == 0))
    said = f"{dataset.attrs['title']}: {complete} of {dataset['status'].size} combinations"
    title = textwrap.fill(said, 100, break_long_words=False)
    figure.suptitle(title, x=0.01, ha="left")
    return figure


def _moving(dataset: xr.Dataset, feature: str) -> xr.DataArray:
    """A feature; no frequency where the block does not stick and slip, for 0 Hz is none."""
    values = dataset[feature]
    return values.where(values > 0.0) if feature == "frequency" else values


def _mark_none(axes: Axes, dataset: xr.Dataset, dim: str) -> None:
    """Crosses where a complete run has no stick-slip."""
    none = (dataset["frequency"] == 0.0) & (dataset["status"] == 0)
    at = none.any([name for name in none.dims if name != dim]).values
    places = _places(dataset[dim])[at]
    foot: Any = {"transform": axes.get_xaxis_transform(), "clip_on": False}
    if places.size:
        axes.plot(places, np.zeros(places.size), "x", color=INK, label="_none", **foot)


def _panels(dims: list[str], features: int) -> tuple[Figure, NDArray[Any]]:
    """A figure and its panels (features, dims)."""
    several = len(dims) > 1
    columns = len(dims) if several else min(ABREAST, features)
    rows = features if several else math.ceil(features / columns)
    figure = Figure((WIDTH, 1.2 + HEIGHT * rows), layout="constrained")
    share: Literal["row", "none"] = "row" if several else "none"
    panels = figure.subplots(rows, columns, sharex="col", sharey=share, squeeze=False)
    if several:
        return figure, panels
    for spare in panels.ravel()[features:]:
        spare.set_visible(False)
    for axes in panels.ravel()[max(features - columns, 0) : features]:
        axes.tick_params(labelbottom=True)
    return figure, panels.ravel()[:features].reshape(features, 1)


def _draw(axes: Axes, values: xr.DataArray, dim: str) -> None:
    if not np.isfinite(values).any():
        axes.text(0.5, 0.5, "none in these runs", ha="center", transform=axes.transAxes)
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


def _colours(count: int) -> list[Any]:
    return [BLUE] if count == 1 else [COLOURS(c) for c in np.linspace(DARKEST, LIGHTEST, count)]


def _is_numeric(coordinate: xr.DataArray) -> bool:
    return np.issubdtype(coordinate.dtype, np.number)


def _places(coordinate: xr.DataArray) -> Array:
    """Where the values stand: at themselves, names side by side."""
    if _is_numeric(coordinate):
        return coordinate.values.astype(float)
    return np.arange(coordinate.size, dtype=float)


def _name_axis(axes: Axes, coordinate: xr.DataArray, last: bool) -> None:
    if last:
        axes.set_xlabel(titled(coordinate))
    if not _is_numeric(coordinate):
        labels = [str(label) for label in coordinate.values]
        long = sum(map(len, labels)) > 24
        style: Any = {"rotation": 60, "ha": "right"} if long else {"rotation": 0, "ha": "center"}
        axes.set_xticks(_places(coordinate), labels, rotation_mode="anchor", **style)
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
    places = product(*(dataset[name].values for name in others))
    labels = [", ".join(_shown(value) for value in place) for place in places]
    axes.legend(
        axes.lines[: len(labels)],
        labels,
        title=", ".join(titled(dataset[name]) for name in others),
        fontsize=7.5,
        title_fontsize=7.5,
        loc="lower left",
        bbox_to_anchor=(0.0, 1.0),
        ncols=min(len(labels), 3),
        borderaxespad=0.0,
        columnspacing=1.0,
        handlelength=1.2,
    )


def titled(coordinate: xr.DataArray) -> str:
    """A dimension with its unit."""
    unit = unit_of(coordinate).strip()
    return f"{coordinate.name} [{unit}]" if unit else str(coordinate.name)


def unit_of(coordinate: xr.DataArray) -> str:
    """As it stands behind a number; nothing for a plain number or a name."""
    unit = unit_text(coordinate.attrs["units"])
    return "" if unit == "1" else f" {unit}"


def _shown(value: object) -> str:
    return format(value, "g") if isinstance(value, float) else str(value)
