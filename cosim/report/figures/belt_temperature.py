"""Temperature along the belt at several times."""

from __future__ import annotations

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ..blocks import thermal_of, value_of
from ..heat_numbers import ambient_degC
from ..style import GREY, line, plain_ticks, readable, styled, title
from .temperatures import SMALLEST_RISE

MOST_PROFILES = 6
# ends of a map that stay legible on white
DARKEST, LIGHTEST = 0.0, 0.85


@styled
def draw_belt_temperature(dataset: xr.Dataset) -> Figure:
    """Contact face of the belt in its own coordinate; below, where the block stood each time."""
    shown = dataset.isel(snapshot_time=chosen_profiles(dataset.sizes["snapshot_time"]))
    rise = shown["belt_temperature"].values - ambient_degC(dataset)
    scaled = readable(rise.ravel(), "K", SMALLEST_RISE)
    figure = Figure(figsize=(11.0, 5.4), layout="constrained")
    profiles, contact = figure.subplots(2, 1, sharex=True, height_ratios=[4.0, 1.0])
    times = shown["snapshot_time"].values
    shades = matplotlib.colormaps["viridis"](np.linspace(DARKEST, LIGHTEST, times.size))
    for time, values, colour in zip(times, rise, shades, strict=True):
        line(
            profiles,
            shown["belt_position"].values,
            scaled(values),
            color=colour,
            linewidth=1.5,
            label=f"{time:.4g} s",
        )
    plain_ticks(profiles)
    profiles.set_ylabel(f"rise over the air [{scaled.unit}]")
    profiles.set_xlabel("")
    _contact_strip(contact, dataset, shown["contact_position"].values, times, shades)
    title(figure, f"Temperature along the {_surface(dataset)}", dataset)
    figure.legend(*profiles.get_legend_handles_labels(), loc="outside right center", title="time")
    return figure


def _surface(dataset: xr.Dataset) -> str:
    return str(value_of(dataset, "rig", "surface") or "belt")


def chosen_profiles(count: int) -> NDArray[np.int64]:
    """At most `MOST_PROFILES` of ``count`` profiles, evenly spread, the last one among them."""
    if count <= MOST_PROFILES:
        return np.arange(count)
    # the start is left out: the belt is at the temperature of the air
    return np.unique(np.linspace(0, count - 1, MOST_PROFILES + 1).round().astype(int)[1:])


def _contact_strip(
    axes: Axes,
    dataset: xr.Dataset,
    centres: NDArray[np.float64],
    times: NDArray[np.float64],
    shades: NDArray[np.float64],
) -> None:
    length = thermal_of(dataset).belt.length
    extent = dataset["contact_position"].attrs["contact_length"]
    for row, (centre, colour) in enumerate(zip(centres, shades, strict=True)):
        begin = (centre - 0.5 * extent) % length
        pieces = [(begin, min(extent, length - begin))]
        if begin + extent > length:
            pieces.append((0.0, begin + extent - length))
        axes.broken_barh(pieces, (row - 0.4, 0.8), facecolor=colour)
    axes.set_ylim(max(times.size, 1) - 0.5, -0.5)
    axes.set_xlim(0.0, length)
    plain_ticks(axes)
    axes.set_yticks([])
    axes.grid(axis="y", visible=False)
    axes.spines["left"].set_color(GREY)
    axes.set_ylabel("contact")
    axes.set_xlabel(f"position along the {_surface(dataset)}, fixed to its material [m]")
