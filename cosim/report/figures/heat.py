"""Friction heat over time: power, total and where it went."""

from __future__ import annotations

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from ..heat_numbers import SINKS, held, other_heat
from ..style import (
    BLUE,
    GREEN,
    INK,
    ORANGE,
    PURPLE,
    RED,
    SKY,
    Scaled,
    line,
    readable,
    slip_patch,
    styled,
    time_panels,
    title,
)

COLOURS = {"belt": BLUE, "ice": SKY, "air": ORANGE, "supports": GREEN, "melting": PURPLE}
LABELS = {
    "belt": "in the belt",
    "ice": "in the ice",
    "air": "in the air",
    "supports": "in the supports",
    "melting": "melting",
}
#: Sinks that most runs do not have.
RARE = ("supports", "melting")


@styled
def draw_heat(dataset: xr.Dataset) -> Figure:
    """Heat flow, cumulative heat and, where there is a thermal model, the shares."""
    sinks = sinks_of(dataset)
    figure, axes = time_panels(dataset, rows=3 if sinks else 2)
    time = dataset["time"].values
    flow = readable(dataset["heat_flow"].values, "W")
    beside = sum(other_heat(dataset).values())
    heat = readable(dataset["heat"].values + beside, "J")
    for column in range(axes.shape[1]):
        line(axes[0, column], time, flow(dataset["heat_flow"].values), color=RED)
        _stack(axes[1, column], dataset, sinks, heat)
        line(axes[1, column], time, heat(dataset["heat"].values), color=INK)
        if beside.any():
            line(
                axes[1, column],
                time,
                heat(dataset["heat"].values + beside),
                color=INK,
                linestyle="--",
            )
        if sinks:
            _shares(axes[2, column], dataset, sinks)
    axes[0, 0].set_ylabel(f"friction heat [{flow.unit}]")
    axes[1, 0].set_ylabel(f"heat since start [{heat.unit}]")
    axes[0, 0].set_ylim(bottom=0.0)
    axes[1, 0].set_ylim(bottom=0.0)
    if sinks:
        axes[2, 0].set_ylabel("share of the heat [%]")
        axes[2, 0].set_ylim(0.0, 100.0)
    figure.align_ylabels(axes[:, 0])
    title(figure, "Friction heat", dataset)
    handles = [Line2D([], [], color=INK, label="friction heat")]
    if beside.any():
        handles += [Line2D([], [], color=INK, linestyle="--", label="with railing's, rollers'")]
    handles += [Patch(facecolor=COLOURS[sink], alpha=0.75, label=LABELS[sink]) for sink in sinks]
    handles += [slip_patch()]
    figure.legend(handles=handles, loc="outside upper right", ncols=len(handles))
    return figure


def sinks_of(dataset: xr.Dataset) -> dict[str, str]:
    """Sinks that the dataset knows -> variable; the rare ones only where they took heat."""
    return {
        sink: name
        for sink, name in SINKS.items()
        if name in dataset and (sink not in RARE or float(dataset[name].max()) > 0.0)
    }


def _stack(axes: Axes, dataset: xr.Dataset, sinks: dict[str, str], heat: Scaled) -> None:
    if sinks:
        axes.stackplot(
            dataset["time"].values,
            *(heat(held(dataset, name)) for name in sinks.values()),
            colors=[COLOURS[sink] for sink in sinks],
            alpha=0.75,
            linewidth=0.0,
        )


def _shares(axes: Axes, dataset: xr.Dataset, sinks: dict[str, str]) -> None:
    received = dataset["heat_received"].values + sum(other_heat(dataset).values())
    known = received > 0.0
    for sink, name in sinks.items():
        share = 100.0 * held(dataset, name)[known] / received[known]
        line(axes, dataset["time"].values[known], share, color=COLOURS[sink], linewidth=1.8)
