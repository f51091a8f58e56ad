"""Melting over time: friction, the film and its shear, and what has melted."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..blocks import mechanics_of
from ..melting_numbers import Film, film_of, floods
from ..style import (
    BLUE,
    GREY,
    INK,
    ORANGE,
    PURPLE,
    SKY,
    Scaled,
    line,
    readable,
    slip_patch,
    styled,
    time_panels,
    title,
)


@styled
def draw_melting(dataset: xr.Dataset) -> Figure:
    """Stresses in the contact, thickness of the film, melted and frozen mass."""
    figure, axes = time_panels(dataset, rows=3, height=2.3, share_y=False)
    film, time = film_of(dataset), dataset["time"].values
    parts = floods(mechanics_of(dataset))
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
