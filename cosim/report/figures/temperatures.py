"""Temperatures of contact and belt over time."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..heat_numbers import ambient_degC
from ..style import (
    BLUE,
    GREEN,
    INK,
    RED,
    Scaled,
    at_least,
    line,
    plain_ticks,
    readable,
    slip_patch,
    styled,
    time_panels,
    title,
)

GROUPS = (
    (
        ("interface_temperature", "contact, mean of both faces", RED, "-"),
        ("ice_face_temperature", "face of the ice", INK, (0, (2, 2))),
    ),
    (
        ("belt_entry_temperature", "belt before the contact", BLUE, "-"),
        ("belt_exit_temperature", "belt behind the contact", GREEN, "-"),
    ),
)
# below this (K) a rise is rounding
SMALLEST_RISE = 1e-9


@styled
def draw_temperatures(dataset: xr.Dataset) -> Figure:
    """Rise over the air, in a unit that shows it; the thermometer's scale on the right."""
    ambient = ambient_degC(dataset)
    names = [name for group in GROUPS for name, *_ in group if name in dataset]
    rises = np.concatenate([dataset[name].values - ambient for name in names])
    scaled = readable(rises, "K", SMALLEST_RISE)
    figure, axes = time_panels(dataset, rows=len(GROUPS), height=2.5, share_y=False)
    for row, group in enumerate(GROUPS):
        for panel in axes[row]:
            _draw_group(panel, dataset, group, ambient, scaled)
            at_least(panel, scaled.factor * SMALLEST_RISE)
        axes[row, 0].set_ylabel(f"rise over the air [{scaled.unit}]")
        _thermometer(axes[row, -1], ambient, scaled)
    figure.align_ylabels(axes[:, 0])
    air = f"{ambient:g}".replace("-", "−")
    title(figure, f"Temperatures in air at {air} °C", dataset)
    handles = [h for row in axes[:, 0] for h in row.get_legend_handles_labels()[0]]
    handles.append(slip_patch())
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure


def _draw_group(
    axes: Axes, dataset: xr.Dataset, group: tuple, ambient: float, scaled: Scaled
) -> None:
    time = dataset["time"].values
    seen = (time >= axes.get_xlim()[0]) & (time <= axes.get_xlim()[1])
    for name, label, colour, dashes in group:
        if name in dataset:
            rise = scaled(dataset[name].values - ambient)
            line(axes, time[seen], rise[seen], color=colour, linestyle=dashes, label=label)


def _thermometer(axes: Axes, ambient: float, scaled: Scaled) -> None:
    """A second scale in degC beside an axis that shows the rise."""
    right = axes.secondary_yaxis(
        "right",
        functions=(
            lambda rise: ambient + rise / scaled.factor,
            lambda degC: (degC - ambient) * scaled.factor,
        ),
    )
    plain_ticks(right)
    right.set_ylabel("temperature [°C]")
    right.spines["right"].set_visible(True)
