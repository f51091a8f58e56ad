"""Figures over the time of a run: panels, slip shaded, a part of a long run enlarged.

What a figure shows is a `TimeFigure`, which is drawn (for a file, for paper) and goes into the page
(to hover over and to zoom) from the same numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from cosim.report.columns import Data
from cosim.report.contents import break_aways, mechanics_of, ramp_end, slip_intervals
from cosim.report.live import Live, Panel, over_time
from cosim.report.style import (
    INK,
    SLIP,
    curve_handles,
    draw_panel,
    fit_to_part,
    in_full,
    plain_ticks,
    styled,
)

from .events import through_events

Array = NDArray[np.float64]

MOST_CYCLES = 4
# of the run: a longer part shows little that the whole run does not
LARGEST_PART = 0.3
# of a cycle, so that the first break-away does not stand on the frame
MARGIN = 0.15
# cycles shown behind the last break-away, where the run goes on without any
AFTERWARDS = 2.0


@dataclass(frozen=True)
class TimeFigure:
    """Title, panels one below the other, a line of text below them; height: of a panel, inches.

    share_y: the enlarged part has the scale of the whole run.
    """

    title: str
    panels: Sequence[Panel]
    note: str = ""
    height: float = 2.0
    share_y: bool = True


Describe = Callable[[Data], TimeFigure]


def drawn(describe: Describe) -> Callable[[Data], Figure]:
    """A function that draws a run's figure."""

    return styled(partial(_draw, describe))


def _draw(describe: Describe, dataset: Data) -> Figure:
    rows, _ = through_events(dataset)
    described = describe(rows)
    count = len(described.panels)
    figure, axes = time_panels(dataset, count, described.height, described.share_y)
    for panel, row in zip(described.panels, axes, strict=True):
        for column in row:
            for shading in () if panel.shaded else list(column.collections):
                shading.remove()
            draw_panel(column, rows["time"].values, panel)
        row[0].set_ylabel(panel.label)
        if panel.thermometer:
            _thermometer(row[-1], *panel.thermometer)
        if len(row) > 1 and not described.share_y:
            fit_to_part(row[-1], rows["time"].values, panel)
    figure.align_ylabels(axes[:, 0])
    title(figure, described.title, dataset)
    if described.note:
        figure.supxlabel(described.note, x=0.008, ha="left", fontsize=9)
    _legend(figure, described)
    return figure


def _thermometer(axes: Axes, ambient: float, factor: float) -> None:
    """A second scale in degC beside an axis that shows the rise, factor times K."""
    right = axes.secondary_yaxis(
        "right",
        functions=(
            lambda rise: ambient + np.asarray(rise) / factor,
            lambda degC: (np.asarray(degC) - ambient) * factor,
        ),
    )
    in_full(right.yaxis)
    right.set_ylabel("temperature [°C]")
    right.spines["right"].set_visible(True)


def _legend(figure: Figure, described: TimeFigure) -> None:
    """Curves by name where a panel has several, and the shading."""
    handles = [*curve_handles(described.panels), slip_patch()]
    place: Any = "outside upper right" if len(handles) < 3 else "outside lower center"
    figure.legend(handles=handles, loc=place, ncols=min(len(handles), MOST_IN_A_ROW))


def live(describe: Describe) -> Callable[[Data], Live]:
    """A function that gives a run's figure to the page, see `cosim.report.live`."""

    return partial(_given, describe)


def _given(describe: Describe, dataset: Data) -> Live:
    rows, events = through_events(dataset)
    described = describe(rows)
    ramp, time = ramp_end(dataset), dataset["time"].values
    return over_time(
        rows["time"].values,
        described.panels,
        keep=events,
        phases=slip_intervals(dataset),
        phase="slip",
        marks=[(ramp, "speed ramp ends")] if time[0] < ramp < time[-1] else (),
        part=zoom_of(dataset),
        note=described.note,
    )


#: Entries of a legend beside each other.
MOST_IN_A_ROW = 6


class Zoom(NamedTuple):
    """A part of the run, s, and what it is."""

    begin: float
    end: float
    title: str


def zoom_of(dataset: Data) -> Zoom | None:
    """The last stick-slip cycles, else the last vibrations; None where a zoom is of no use."""
    return _last_cycles(dataset) or _last_vibrations(dataset)


def _last_cycles(dataset: Data) -> Zoom | None:
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


def _last_vibrations(dataset: Data) -> Zoom | None:
    """Some periods of the free vibration at the end, in a run too long to show single ones."""
    time = dataset["time"].values
    frequency = mechanics_of(dataset).natural_frequency
    if time.size == 0 or frequency == 0.0:
        return None
    length = 2.0 * MOST_CYCLES / frequency
    if length > 0.5 * LARGEST_PART * (time[-1] - time[0]) or np.sum(time > time[-1] - length) < 3:
        return None
    return Zoom(float(time[-1] - length), float(time[-1]), "the end of the run")


def title(figure: Figure, text: str, dataset: Data) -> None:
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
    dataset: Data, rows: int, height: float = 2.0, share_y: bool = True
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


def _limits(dataset: Data, axes: NDArray[Any], zoom: Zoom | None) -> None:
    time = dataset["time"].values
    begin, end = (time[0], time[-1]) if time.size else (0.0, 0.0)
    margin = 0.0 if end > begin else 0.5
    ramp = ramp_end(dataset)
    for panel in axes[:, 0]:
        panel.set_xlim(begin - margin, end + margin)
        if begin < ramp < end:
            panel.axvline(ramp, color=INK, linewidth=0.9, linestyle=":")
    for panel in axes[-1]:
        panel.set_xlabel("time [s]")
    if begin < ramp < end:
        axes[0, 0].annotate(
            "speed ramp ends",
            (ramp, 1.0),
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
