"""Velocity over position."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ..blocks import mechanics_of
from ..phases import run_up_time
from ..style import BLUE, GREY, INK, RED, Scaled, line, plain_ticks, readable, styled, title
from ..zoom import zoom_of
from .motion import SMALLEST_ANGLE_DEG

DEGREES = Scaled(180.0 / np.pi, "°")
DEGREES_PER_SECOND = Scaled(180.0 / np.pi, "°/s")


@styled
def draw_phase_portrait(dataset: xr.Dataset) -> Figure:
    """(x, vx) with the speed of the surface, and (phi, omega) where the block turns."""
    turns = np.degrees(np.nanmax(np.abs(dataset["phi"].values), initial=0.0)) > SMALLEST_ANGLE_DEG
    figure = Figure(figsize=(11.0 if turns else 7.5, 5.0), layout="constrained")
    panels = figure.subplots(1, 2 if turns else 1, squeeze=False)[0]
    speed = mechanics_of(dataset).surface.speed
    x = readable(dataset["x"].values, "m")
    vx = readable(np.append(dataset["vx"].values, speed), "m/s")
    _path(panels[0], dataset, ("x", x), ("vx", vx))
    panels[0].axhline(
        vx.factor * speed, color=INK, linewidth=1.0, linestyle="--", label="speed of the surface"
    )
    panels[0].set_xlabel(f"x [{x.unit}]")
    panels[0].set_ylabel(f"velocity along x [{vx.unit}]")
    if turns:
        _path(panels[1], dataset, ("phi", DEGREES), ("omega", DEGREES_PER_SECOND))
        panels[1].set_xlabel("φ [°]")
        panels[1].set_ylabel("angular velocity [°/s]")
    title(figure, "Phase portrait", dataset)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(handles))
    return figure


def _path(
    axes: Axes,
    dataset: xr.Dataset,
    across: tuple[str, Scaled],
    upwards: tuple[str, Scaled],
) -> None:
    plain_ticks(axes)
    values = [scaled(dataset[name].values) for name, scaled in (across, upwards)]
    for text, chosen, colour, width in _parts(dataset):
        if chosen.any():
            # left out rather than dropped: the line must not jump across what another part shows
            x, y = (np.where(chosen, v, np.nan) if chosen.size > 1 else v for v in values)
            line(axes, x, y, color=colour, linewidth=width, label=text)


def _parts(dataset: xr.Dataset) -> list[tuple[str, NDArray[np.bool_], str, float]]:
    """Name, rows (n,), colour and width of the parts of a run."""
    time = dataset["time"].values
    run_up, zoom = run_up_time(dataset), zoom_of(dataset)
    rising = time <= run_up if run_up else np.zeros(time.size, bool)
    late = (time >= zoom.begin) & (time <= zoom.end) if zoom else np.zeros(time.size, bool)
    rest = "after the run-up" if run_up else "run"
    return [
        ("run-up", rising & ~late, GREY, 0.7),
        (rest, ~rising & ~late, BLUE, 0.9),
        (zoom.title if zoom else "", late, RED, 1.3),
    ]
