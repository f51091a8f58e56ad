"""Figures of a system's run over time: what went across, energy, and the steps taken."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cosim.coupling import Ledger
from cosim.report.style import (
    BLUE,
    FAINT_BLUE,
    INK,
    SERIES,
    SPELLING,
    Scaled,
    at_least,
    line,
    panels,
    picture,
    plain_ticks,
    readable,
)

#: Panels of a figure; of more signals the first are drawn.
MOST_PANELS = 24
COLUMNS = 3
#: Units that a prefix is put before.
PREFIXED = ("m", "s", "N", "J", "W", "Pa", "A", "V", "rad", "m/s", "m/s2", "rad/s", "N.m", "J/kg")
#: Change of a signal that is none, as a part of it.
NOTHING = 1e-6


@picture(
    "signals",
    f"Outputs over time at the recorded times, those that are connected first, and of more than"
    f" {MOST_PANELS} the first; the numbers below and the files have all.",
)
def signals(dataset: xr.Dataset) -> Figure:
    """A panel for every output, up to `MOST_PANELS`."""
    names = _drawn(dataset)
    rows = -(-len(names) // COLUMNS)
    figure, axes = panels(rows, COLUMNS, height=1.7, width=10.5, sharex=True)
    time = dataset["time"].values
    for panel, name in zip(axes.flat, names, strict=False):
        values = dataset[name].values
        unit = dataset[name].attrs["units"]
        scaled = readable(values, unit) if unit in PREFIXED else Scaled(1.0, unit)
        line(panel, time, scaled(values), color=BLUE)
        panel.set_title(f"{name} [{SPELLING.get(scaled.unit, scaled.unit)}]", fontsize=9)
        plain_ticks(panel)
        # else the last bits of what stays the same would fill the panel
        at_least(panel, NOTHING * scaled.factor * float(np.max(np.abs(values))))
    _end(axes, len(names))
    return figure


def _drawn(dataset: xr.Dataset) -> list[str]:
    sources = {each.attrs.get("fed_by", "") for each in dataset.data_vars.values()}
    outputs = [
        str(name)
        for name, each in dataset.data_vars.items()
        if each.attrs.get("causality") == "output"
    ]
    connected = [name for name in outputs if dataset[name].attrs["long_name"] in sources]
    return [*connected, *(name for name in outputs if name not in connected)][:MOST_PANELS]


def _end(axes: NDArray[Any], used: int) -> None:
    """Time below the lowest panel of each column; no empty panels."""
    for number, panel in enumerate(axes.flat):
        if number >= used:
            panel.set_visible(False)
        elif number + COLUMNS >= used:
            panel.set_xlabel("time [s]")
            panel.tick_params(labelbottom=True)


@picture(
    "energy",
    "Energy across each connection in J: handed over by the one unit, and taken up by the other. "
    "Below: what has been handed over and not taken up.",
)
def energy(time: NDArray[np.float64], ledger: Ledger) -> Figure:
    """Handed over and taken up, and what is between."""
    figure, axes = panels(2, 1, height=2.2, width=9.0, sharex=True)
    for flow, colour in zip(ledger.flows, _colours(len(ledger.flows)), strict=True):
        line(axes[0, 0], time, flow.handed, color=colour, label=str(flow.connection))
        axes[0, 0].plot(time, flow.taken, color=INK, linewidth=0.8, linestyle=":")
        line(axes[1, 0], time, flow.in_transit, color=colour)
    axes[0, 0].legend()
    axes[0, 0].set_ylabel("handed over [J]")
    axes[1, 0].set_ylabel("in transit [J]")
    axes[1, 0].set_xlabel("time [s]")
    plain_ticks(axes[0, 0])
    return figure


def _colours(count: int) -> Sequence[str]:
    return [SERIES[number % len(SERIES)] for number in range(count)]


@picture(
    "steps",
    "Sizes of the macro steps that were accepted. In a run of very many steps neighbours are drawn "
    "as one band, from the smallest to the largest of them.",
)
def steps(dataset: xr.Dataset, start: float) -> Figure:
    """Step size over time, on a logarithmic axis where the steps differ much."""
    figure, axes = panels(1, 1, height=2.4, width=9.0)
    panel = axes[0, 0]
    ends = dataset["step_time"].values
    edges = np.concatenate([[start], ends])
    shortest, longest = dataset["shortest_step"].values, dataset["longest_step"].values
    if np.any(longest > shortest * (1.0 + 1e-6)):
        panel.fill_between(
            edges, np.append(shortest, shortest[-1]), np.append(longest, longest[-1]),
            step="post", color=FAINT_BLUE,
        )  # fmt: skip
    panel.stairs(longest, edges, color=BLUE, baseline=None, linewidth=1.2)
    if longest.max() > 5.0 * shortest.min():
        panel.set_yscale("log")
    else:
        panel.set_ylim(0.0, 1.25 * longest.max())
    panel.set_xlabel("time [s]")
    panel.set_ylabel("macro step [s]")
    return figure
