"""Figures over the time of a run: panels, slip shaded, a part of a long run enlarged."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from cosim.report.contents import break_aways, mechanics_of, run_up_time, slip_intervals
from cosim.report.style import INK, SLIP, plain_ticks

Array = NDArray[np.float64]

MOST_CYCLES = 4
# of the run: a longer part shows little that the whole run does not
LARGEST_PART = 0.3
# of a cycle, so that the first break-away does not stand on the frame
MARGIN = 0.15
# cycles shown behind the last break-away, where the run goes on without any
AFTERWARDS = 2.0


class Zoom(NamedTuple):
    """A part of the run, s, and what it is."""

    begin: float
    end: float
    title: str


def zoom_of(dataset: xr.Dataset) -> Zoom | None:
    """The last stick-slip cycles, else the last vibrations; None where a zoom is of no use."""
    return _last_cycles(dataset) or _last_vibrations(dataset)


def _last_cycles(dataset: xr.Dataset) -> Zoom | None:
    """As many cycles, up to `MOST_CYCLES`, as fit into `LARGEST_PART` of the run."""
    starts = break_aways(dataset)
    if starts.size < MOST_CYCLES + 1:
        return None
    time = dataset["time"].values
    for cycles in range(MOST_CYCLES, 0, -1):
        period = (starts[-1] - starts[-cycles - 1]) / cycles
        begin = max(starts[-cycles - 1] - MARGIN * period, time[0])
        end = min(starts[-1] + AFTERWARDS * period, time[-1])
        if 0.0 < end - begin <= LARGEST_PART * (time[-1] - time[0]):
            return Zoom(float(begin), float(end), "the last stick-slip cycles")
    return None


def _last_vibrations(dataset: xr.Dataset) -> Zoom | None:
    """Some periods of the free vibration at the end, in a run too long to show single ones."""
    time = dataset["time"].values
    frequency = mechanics_of(dataset).natural_frequency
    if time.size == 0 or frequency == 0.0:
        return None
    length = 2.0 * MOST_CYCLES / frequency
    if length > 0.5 * LARGEST_PART * (time[-1] - time[0]) or np.sum(time > time[-1] - length) < 3:
        return None
    return Zoom(float(time[-1] - length), float(time[-1]), "the end of the run")


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
        list(np.stack([corners, heights], axis=2)),
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
) -> tuple[Figure, NDArray[Any]]:
    """Panels (rows, columns) over time: the whole run and, if it is long, a part enlarged.

    Slip is shaded, the end of the speed ramp dotted. height: of a row, inches.
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


def _limits(dataset: xr.Dataset, axes: NDArray[Any], zoom: Zoom | None) -> None:
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
            "speed ramp ends",
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
