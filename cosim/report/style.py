"""What all figures share: type, colours, units on axes, panels over time."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import NamedTuple

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.ticker import ScalarFormatter
from numpy.typing import NDArray

from .phases import run_up_time, slip_intervals
from .zoom import Zoom, zoom_of

Array = NDArray[np.float64]

# Okabe and Ito's palette: told apart with any kind of colour vision
BLUE, RED, GREEN = "#0072B2", "#D55E00", "#009E73"
PURPLE, SKY, ORANGE = "#CC79A7", "#56B4E9", "#E69F00"
INK, GREY, SLIP = "#222222", "#8A8A8A", "#F8EAD0"

RC = {
    "font.family": "DejaVu Sans",
    "font.size": 10.0,
    "axes.labelsize": 10.0,
    "axes.titlesize": 10.0,
    "axes.titlelocation": "left",
    "axes.edgecolor": GREY,
    "axes.labelcolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": "#D9D9D9",
    "grid.linewidth": 0.6,
    "xtick.labelsize": 9.0,
    "ytick.labelsize": 9.0,
    "xtick.color": INK,
    "ytick.color": INK,
    "legend.fontsize": 9.0,
    "legend.frameon": False,
    "figure.titlesize": 12.0,
    "lines.linewidth": 1.3,
    "lines.solid_joinstyle": "round",
}

DPI = 150  # of the PNG files

PREFIXES = ((1e-9, "n"), (1e-6, "µ"), (1e-3, "m"), (1.0, ""), (1e3, "k"), (1e6, "M"))
SPELLING = {"N.m": "N m", "1": "1", "degC": "°C"}


def styled(draw: Callable[..., Figure]) -> Callable[..., Figure]:
    """Draw with the house style, whatever the user's own matplotlib settings."""

    @wraps(draw)
    def drawn(*args: object, **options: object) -> Figure:
        with matplotlib.rc_context(RC):
            return draw(*args, **options)

    return drawn


class Scaled(NamedTuple):
    """Values in the unit that makes them readable: value [unit] = factor * SI value."""

    factor: float
    unit: str

    def __call__(self, values: Array) -> Array:
        return self.factor * np.asarray(values, float)


def readable(values: Array, unit: str, floor: float = 0.0) -> Scaled:
    """The SI prefix with which the largest magnitude lies in 1 ... 1000.

    floor: magnitude (SI) below which values are nothing and choose no smaller prefix.
    """
    spelled = SPELLING.get(unit, unit)
    finite = np.abs(values[np.isfinite(values)])
    largest = max(float(finite.max(initial=0.0)), floor)
    if spelled in ("1", "°C", "°") or largest == 0.0:
        return Scaled(1.0, spelled)
    size, prefix = PREFIXES[0]
    for candidate in PREFIXES[1:]:
        if largest >= candidate[0]:
            size, prefix = candidate
    return Scaled(1.0 / size, prefix + spelled)


def plain_ticks(axes: Axes) -> None:
    """Digits in full: no offset and no power of ten beside the axis."""
    for axis in (axes.xaxis, axes.yaxis):
        formatter = ScalarFormatter(useOffset=False)
        formatter.set_scientific(False)
        axis.set_major_formatter(formatter)


def at_least(axes: Axes, span: float) -> None:
    """Widen the y axis to a span, so that rounding noise is not magnified to a signal."""
    low, high = axes.get_ylim()
    if high - low < span:
        middle = 0.5 * (low + high)
        axes.set_ylim(middle - 0.5 * span, middle + 0.5 * span)


def line(axes: Axes, x: Array, y: Array, **options: object) -> None:
    """A line; dots as well where there are too few points to see one."""
    marker = "o" if np.size(x) < 3 else None
    axes.plot(x, y, marker=marker, markersize=4, **options)


def title(figure: Figure, text: str, dataset: xr.Dataset) -> None:
    """Title at the left, with the case's name and how a run ended that is not complete."""
    status = dataset.attrs["status"]
    ending = "" if status == "complete" else f"  ({status})"
    figure.suptitle(f"{text}: {dataset.attrs['title']}{ending}", x=0.008, ha="left", color=INK)


def shade_slip(axes: Axes, intervals: Array) -> None:
    """Slip phases (k, 2) s as one collection behind the lines, over the full height."""
    if intervals.size == 0:
        return
    begin, end = intervals.T
    corners = np.stack([begin, end, end, begin], axis=1)
    heights = np.broadcast_to([0.0, 0.0, 1.0, 1.0], corners.shape)
    bars = PolyCollection(
        np.stack([corners, heights], axis=2),
        facecolor=SLIP,
        edgecolor="none",
        transform=axes.get_xaxis_transform(),
        zorder=0.1,
        # phases narrower than a pixel then tint it by their share instead of all or nothing
        snap=False,
    )
    axes.add_collection(bars, autolim=False)


def slip_patch() -> Patch:
    """The shading's entry in a legend."""
    return Patch(facecolor=SLIP, edgecolor="none", label="slip")


def time_panels(
    dataset: xr.Dataset, rows: int, height: float = 2.0, share_y: bool = True
) -> tuple[Figure, NDArray[np.object_]]:
    """Panels (rows, columns) over time: the whole run and, if it is long, a part enlarged.

    Slip is shaded, the end of the run-up dotted. height: of a row, inches.
    """
    zoom = zoom_of(dataset)
    figure = Figure(figsize=(11.0, 0.9 + height * rows), layout="constrained")
    columns = 1 if zoom is None else 2
    axes = figure.subplots(
        rows,
        columns,
        sharex="col",
        sharey="row" if share_y else False,
        squeeze=False,
        width_ratios=[1.0] if zoom is None else [1.6, 1.0],
    )
    intervals = slip_intervals(dataset)
    for panel in axes.flat:
        shade_slip(panel, intervals)
        plain_ticks(panel)
    _limits(dataset, axes, zoom)
    return figure, axes


def _limits(dataset: xr.Dataset, axes: NDArray[np.object_], zoom: Zoom | None) -> None:
    time = dataset["time"].values
    begin, end = (time[0], time[-1]) if time.size else (0.0, 0.0)
    margin = 0.0 if end > begin else 0.5
    run_up = run_up_time(dataset)
    for panel in axes[:, 0]:
        panel.set_xlim(begin - margin, end + margin)
        if begin < run_up < end:
            panel.axvline(run_up, color=INK, linewidth=0.9, linestyle=":")
    for panel in axes[-1]:
        panel.set_xlabel("time [s]")
    if begin < run_up < end:
        axes[0, 0].annotate(
            "run-up ends",
            (run_up, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 2),
            textcoords="offset points",
            ha="center",
            va="bottom",
            fontsize=9,
        )
    if zoom is not None:
        for panel in axes[:, 1]:
            panel.set_xlim(zoom.begin, zoom.end)
        axes[0, 1].set_title(zoom.title)
