"""Friction heat and melting over time."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from stickslip.friction.law import feels_water

from cosim.report.contents import mechanics_of
from cosim.report.heat_numbers import SINKS, Film, all_other_heat, film_of, held
from cosim.report.style import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    PURPLE,
    RED,
    SKY,
    Scaled,
    line,
    readable,
    styled,
)

from .over_time import slip_patch, time_panels, title

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
    beside = all_other_heat(dataset)
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
    handles: list[Artist] = [Line2D([], [], color=INK, label="friction heat")]
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
    received = dataset["heat_received"].values + all_other_heat(dataset)
    known = received > 0.0
    for sink, name in sinks.items():
        share = 100.0 * held(dataset, name)[known] / received[known]
        line(axes, dataset["time"].values[known], share, color=COLOURS[sink], linewidth=1.8)


@styled
def draw_melting(dataset: xr.Dataset) -> Figure:
    """Stresses in the contact, thickness of the film, melted and frozen mass."""
    figure, axes = time_panels(dataset, rows=3, height=2.3, share_y=False)
    film, time = film_of(dataset), dataset["time"].values
    parts = feels_water(mechanics_of(dataset))
    stress = readable(film.friction, "Pa")
    thickness = readable(film.thickness, "m")
    mass = readable(1e3 * dataset["melted_mass"].values, "g")
    for column in range(axes.shape[1]):
        top, middle, bottom = axes[:, column]
        _stresses(top, time, film, stress, parts)
        line(middle, time, thickness(film.thickness), color=BLUE, label="film")
        line(
            middle,
            time,
            thickness(film.fed),
            color=GREY,
            linestyle="--",
            label="film that melting alone\nwould feed",
        )
        line(bottom, time, mass(1e3 * dataset["melted_mass"].values), color=PURPLE, label="melted")
        line(
            bottom,
            time,
            mass(1e3 * dataset["refrozen_mass"].values),
            color=SKY,
            label="of it, ice on the belt",
        )
        if dataset["wiped_ice_mass"].max() > 0.0:
            line(
                bottom,
                time,
                mass(1e3 * dataset["wiped_ice_mass"].values),
                color=GREY,
                label="of it, ice wiped off",
            )
    axes[0, 0].set_ylabel(f"stress [{stress.unit}]")
    axes[1, 0].set_ylabel(f"water [{thickness.unit}]")
    axes[2, 0].set_ylabel(f"mass [{mass.unit}]")
    for panel in axes.flat:
        panel.set_ylim(bottom=0.0)
    figure.align_ylabels(axes[:, 0])
    title(figure, "Melting", dataset)
    for panel in axes[:, -1]:
        panel.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    figure.legend(handles=[slip_patch()], loc="outside upper right")
    return figure


def _stresses(axes: Axes, time: np.ndarray, film: Film, scaled: Scaled, parts: bool) -> None:
    """Friction, its parts where it feels the water, and what a film over all would be sheared with.

    The latter has no bound as the film thins; the axis is that of friction.
    """
    line(axes, time, scaled(film.friction), color=INK, label="friction")
    if parts:
        water = np.nan_to_num(film.water)
        line(axes, time, scaled(film.friction - water), color=ORANGE, label="dry part of it")
        line(axes, time, scaled(film.water), color=BLUE, label="shear of the water")
    line(
        axes,
        time,
        scaled(film.whole),
        color=GREY,
        linestyle=":",
        label="shear of the film if it\ncovered the whole contact",
    )
    axes.set_ylim(top=1.3 * scaled.factor * float(np.nanmax(film.friction, initial=0.0)) or 1.0)
