"""Temperatures of contact and belt over time, and along the belt at several times."""

from __future__ import annotations

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cosim.report.contents import thermal_of, value_of
from cosim.report.heat_numbers import ambient_degC
from cosim.report.style import (
    BLUE,
    GREEN,
    GREY,
    INK,
    RED,
    Scaled,
    at_least,
    in_full,
    line,
    plain_ticks,
    readable,
    styled,
)

from .over_time import slip_patch, time_panels, title

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
            lambda rise: ambient + np.asarray(rise) / scaled.factor,
            lambda degC: (np.asarray(degC) - ambient) * scaled.factor,
        ),
    )
    in_full(right.yaxis)
    right.set_ylabel("temperature [°C]")
    right.spines["right"].set_visible(True)


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
