"""The block's motion: position and rotation over time, velocity over position, friction."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray
from stickslip.kernel.layout import P_MU_K, P_MU_S, P_NORMAL_FORCE

from cosim.report.contents import mechanics_of, run_up_time
from cosim.report.style import (
    BLUE,
    GREEN,
    GREY,
    INK,
    RED,
    Scaled,
    at_least,
    line,
    plain_ticks,
    readable,
    styled,
)

from .over_time import slip_patch, time_panels, title, zoom_of

# what a camera over the rig would just see; smaller motions are not blown up to fill the axis
SMALLEST_LENGTH = 1e-4
SMALLEST_ANGLE_DEG = 0.1
# m or rad: below this a motion is told in words instead of drawn as a flat line
NOTHING = 1e-7
COLOURS = {"x": BLUE, "y": GREEN, "phi": RED}


@styled
def draw_motion(dataset: xr.Dataset) -> Figure:
    """x, y and phi over time, slip shaded; the last cycles beside the whole run.

    Where the block does not leave its line or does not turn, a line of text says so.
    """
    still = [name for name in ("y", "phi") if not _moves(dataset, name)]
    shown = [(name, colour) for name, colour in COLOURS.items() if name not in still]
    figure, axes = time_panels(dataset, rows=len(shown))
    time = dataset["time"].values
    for row, (name, colour) in enumerate(shown):
        if name == "phi":
            values, label, smallest = np.degrees(dataset[name].values), "φ [°]", SMALLEST_ANGLE_DEG
        else:
            scaled = readable(dataset[name].values, "m", floor=1e-3)
            values = scaled(dataset[name].values)
            label, smallest = f"{name} [{scaled.unit}]", scaled.factor * SMALLEST_LENGTH
        for panel in axes[row]:
            line(panel, time, values, color=colour)
        at_least(axes[row, 0], smallest)
        axes[row, 0].set_ylabel(label)
    figure.align_ylabels(axes[:, 0])
    title(figure, "Motion of the block", dataset)
    if still:
        words = " and ".join({"y": "y", "phi": "φ"}[name] for name in still)
        figure.supxlabel(f"{words}: 0 throughout, not drawn", x=0.008, ha="left", fontsize=9)
    figure.legend(handles=[slip_patch()], loc="outside upper right")
    return figure


def _moves(dataset: xr.Dataset, name: str) -> bool:
    return bool(np.nanmax(np.abs(dataset[name].values), initial=0.0) > NOTHING)


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
    rest = "after the speed ramp" if run_up else "run"
    return [
        ("speed ramp", rising & ~late, GREY, 0.7),
        (rest, ~rising & ~late, BLUE, 0.9),
        (zoom.title if zoom else "", late, RED, 1.3),
    ]


COMPONENTS = (
    ("friction_force_x", "N", "friction along x", BLUE),
    ("friction_force_y", "N", "friction along y", GREEN),
    ("friction_moment", "N.m", "friction moment", RED),
)
# of the limit of static friction: a component below it is left out
SMALLEST_SHARE = 1e-6


@styled
def draw_friction_force(dataset: xr.Dataset) -> Figure:
    """Friction along x with the limits of stick and slip; the other components where they act."""
    p = mechanics_of(dataset).pack()
    limits = {"μ_s m g": p[P_MU_S] * p[P_NORMAL_FORCE], "μ_k m g": p[P_MU_K] * p[P_NORMAL_FORCE]}
    shown = _acting(dataset, SMALLEST_SHARE * max(limits.values()))
    figure, axes = time_panels(dataset, rows=len(shown), height=2.6 if len(shown) == 1 else 2.0)
    for row, (name, unit, label, colour) in enumerate(shown):
        scaled = readable(dataset[name].values, unit)
        for panel in axes[row]:
            line(panel, dataset["time"].values, scaled(dataset[name].values), color=colour)
        axes[row, 0].set_ylabel(f"{label} [{scaled.unit}]")
        at_least(axes[row, 0], 1e-6)
        if name == "friction_force_x":
            for panel in axes[row]:
                _mark_limits(panel, {text: scaled.factor * size for text, size in limits.items()})
    figure.align_ylabels(axes[:, 0])
    title(figure, "Friction on the block", dataset)
    figure.legend(handles=[slip_patch()], loc="outside upper right")
    return figure


def _acting(dataset: xr.Dataset, smallest: float) -> list[tuple[str, str, str, str]]:
    return [
        component
        for component in COMPONENTS
        if component[0] == "friction_force_x"
        or np.nanmax(np.abs(dataset[component[0]].values), initial=0.0) > smallest
    ]


def _mark_limits(axes: Axes, limits: dict[str, float]) -> None:
    """Dashed lines where friction reaches its limits, named behind the right edge."""
    low, high = axes.dataLim.intervaly
    reach = 1.1 * max(abs(low), abs(high))
    for text, size in limits.items():
        for sign, mark in ((1.0, ""), (-1.0, "−")):
            level = sign * size
            if size == 0.0 or not min(low, 0.0) * 1.1 <= level <= max(high, 0.0) * 1.1 <= reach:
                continue
            axes.axhline(level, color=GREY, linewidth=0.9, linestyle="--", zorder=1)
            axes.annotate(
                mark + _mathtext(text),
                (1.0, level),
                xycoords=("axes fraction", "data"),
                xytext=(3, 0),
                textcoords="offset points",
                va="center",
                fontsize=9,
                color=INK,
            )


def _mathtext(text: str) -> str:
    symbol, rest = text.split(" ", 1)
    greek, index = symbol.split("_")
    return rf"${{\mu}}_{{\mathrm{{{index}}}}}\,{rest.replace(' ', chr(92) + ',')}$"
