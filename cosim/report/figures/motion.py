"""The block's motion: position and rotation over time, velocity over position, friction."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from numpy.typing import NDArray
from stickslip.kernel.layout import P_CURVATURE, P_MU_K, P_MU_S, P_NORMAL_FORCE

from cosim.report.columns import Data
from cosim.report.contents import break_aways, mechanics_of, ramp_end
from cosim.report.live import Curve, Panel, TimeFigure
from cosim.report.style import (
    BLUE,
    GREEN,
    GREY,
    INK,
    RED,
    Scaled,
    line,
    plain_ticks,
    readable,
    styled,
)

from .events import through_events
from .over_time import title, zoom_of

Array = NDArray[np.float64]
#: Name, rows, colour and width of a part of a run.
Part = tuple[str, NDArray[np.int64], str, float]

# what a camera over the rig would just see; smaller motions are not blown up to fill the axis
SMALLEST_LENGTH = 1e-4
SMALLEST_ANGLE_DEG = 0.1
# of these: a channel that moves less is told in words instead of drawn as a flat line
FLAT = 0.05


def motion(dataset: Data) -> TimeFigure:
    """x, y and phi over time; where the block keeps to its line or does not turn, words say so."""
    x, y = (readable(dataset[name].values, "m", floor=1e-3) for name in ("x", "y"))
    shown = [
        ("x", BLUE, x, SMALLEST_LENGTH),
        ("y", GREEN, y, SMALLEST_LENGTH),
        ("phi", RED, DEGREES, np.radians(SMALLEST_ANGLE_DEG)),
    ]
    panels, said = [], []
    for name, colour, scaled, smallest in shown:
        symbol = {"phi": "φ"}.get(name, name)
        values = scaled(dataset[name].values)
        known = values[np.isfinite(values)]
        if name != "x" and (known.size == 0 or np.ptp(known) < FLAT * scaled.factor * smallest):
            said.append(_flat(symbol, known, scaled, FLAT * smallest))
            continue
        panels.append(
            Panel(
                f"{symbol} [{scaled.unit}]",
                [Curve(symbol, values, colour)],
                span=scaled.factor * smallest,
            )
        )
    note = f"Not drawn, as flat: {'; '.join(said)}." if said else ""
    return TimeFigure(
        dataset["time"].values, panels, title="Motion of the block", note=note, height=2.0
    )


def _flat(symbol: str, values: Array, scaled: Scaled, least: float) -> str:
    """What a channel that does not move is."""
    level = float(values.mean()) if values.size else 0.0
    if abs(level) < scaled.factor * least:
        return f"{symbol} is 0 throughout"
    return f"{symbol} is {level:.3g} {scaled.unit} throughout".replace("-", "−")


DEGREES = Scaled(180.0 / np.pi, "°")
DEGREES_PER_SECOND = Scaled(180.0 / np.pi, "°/s")


@styled
def draw_phase_portrait(dataset: Data) -> Figure:
    """(x, vx) with the speed of the surface, and (phi, omega) where the block turns."""
    run, (dataset, _) = dataset, through_events(dataset)
    turns = np.degrees(np.nanmax(np.abs(dataset["phi"].values), initial=0.0)) > SMALLEST_ANGLE_DEG
    figure = Figure(figsize=(11.0 if turns else 7.5, 5.0), layout="constrained")
    panels = figure.subplots(1, 2 if turns else 1, squeeze=False)[0]
    surface = local_surface_speed(dataset)
    x = readable(dataset["x"].values, "m")
    vx = readable(np.append(dataset["vx"].values, surface[-1:]), "m/s")
    parts = _parts(run, dataset["time"].values)
    _path(panels[0], dataset, parts, ("x", x), ("vx", vx))
    _surface_speed(panels[0], dataset, surface, x, vx, break_aways(run))
    panels[0].set_xlabel(f"x [{x.unit}]")
    panels[0].set_ylabel(f"velocity along x [{vx.unit}]")
    if turns:
        _path(panels[1], dataset, parts, ("phi", DEGREES), ("omega", DEGREES_PER_SECOND))
        panels[1].set_xlabel("φ [°]")
        panels[1].set_ylabel("angular velocity [°/s]")
    title(figure, "Phase portrait", dataset)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(handles))
    return figure


def local_surface_speed(dataset: Data) -> Array:
    """Speed of the surface along x below the middle of the block, m/s: (times,).

    A slab that turns about (0, 1 / curvature) is slower the nearer to that centre.
    """
    parameters = mechanics_of(dataset)
    curvature = parameters.pack()[P_CURVATURE]
    if "surface_speed_actual" in dataset:
        speed = dataset["surface_speed_actual"].values
    else:
        speed = np.full(dataset.sizes["time"], parameters.surface.speed)
    return speed * (1.0 - curvature * dataset["y"].values)


def _surface_speed(
    axes: Axes, dataset: Data, surface: Array, x: Scaled, vx: Scaled, starts: Array
) -> None:
    """Where the block sticks: a line on a belt; on a slab it goes with the place of the block."""
    late = dataset["time"].values >= ramp_end(dataset)
    speeds = vx(surface[late] if late.any() else surface[-1:])
    look: dict[str, Any] = {"color": INK, "linewidth": 1.0, "linestyle": "--", "zorder": 3}
    if np.ptp(speeds) <= 1e-6 * np.max(np.abs(speeds), initial=1e-12):
        axes.axhline(float(speeds[0]), label="speed of the surface", **look)
        return
    # one cycle and one way: else the dashes would fill each other's gaps
    time = dataset["time"].values
    shown = (time >= starts[-2]) & (time <= starts[-1]) if starts.size > 1 else late
    shown &= dataset["vx"].values > 0.0
    look |= {"label": "speed of the surface below the block"}
    axes.plot(x(dataset["x"].values[shown]), vx(surface[shown]), **look)


def _path(
    axes: Axes,
    dataset: Data,
    parts: list[Part],
    across: tuple[str, Scaled],
    upwards: tuple[str, Scaled],
) -> None:
    plain_ticks(axes)
    x, y = (scaled(dataset[name].values) for name, scaled in (across, upwards))
    for text, rows, colour, width in parts:
        if rows.size == 0:
            continue
        if text == RAMP:
            _fading(axes, x[rows], y[rows], colour, width, text)
        else:
            line(axes, x[rows], y[rows], color=colour, linewidth=width, label=text)
    axes.autoscale_view()


RAMP = "speed ramp"
#: Opacity of the ramp's beginning and end.
FAINT, FULL = 0.15, 0.9


def _fading(axes: Axes, x: Array, y: Array, colour: str, width: float, text: str) -> None:
    """A path that comes out of the paper: its beginning is of the least weight."""
    ends = np.stack([x, y], axis=1)
    colours = np.empty((max(x.size - 1, 0), 4))
    colours[:, :3] = to_rgb(colour)
    colours[:, 3] = np.linspace(FAINT, FULL, colours.shape[0])
    pieces = np.stack([ends[:-1], ends[1:]], axis=1)
    axes.add_collection(LineCollection(list(pieces), colors=colours, linewidths=width))
    axes.update_datalim(ends[np.isfinite(ends).all(axis=1)])
    axes.plot([], [], color=colour, linewidth=width, label=text)


def _parts(run: Data, time: Array) -> list[Part]:
    """Name, rows of the time, colour and width of the parts of a run.

    Each ends where the next begins.
    """
    ramp, zoom = ramp_end(run), zoom_of(run)
    first = int(np.searchsorted(time, ramp, side="right")) if ramp else 0
    late = int(np.searchsorted(time, zoom.begin)) if zoom else time.size
    end = int(np.searchsorted(time, zoom.end, side="right")) if zoom else time.size
    first = min(first, late)
    rest = "after the speed ramp" if ramp else "run"
    parts = [
        (RAMP, np.arange(0, min(first + 1, time.size)) if first else np.arange(0), GREY, 0.8),
        (rest, np.arange(first, min(late + 1, time.size)), BLUE, 0.9),
        (zoom.title if zoom else "", np.arange(late, end), RED, 1.3),
    ]
    if end < time.size:
        parts.append(("", np.arange(end - 1, time.size), BLUE, 0.9))
    return parts


COMPONENTS = (
    ("friction_force_x", "N", "friction along x", BLUE),
    ("friction_force_y", "N", "friction along y", GREEN),
    ("friction_moment", "N.m", "friction moment", RED),
)
# of the limit of static friction: a component below it is left out
SMALLEST_SHARE = 1e-6


def friction_force(dataset: Data) -> TimeFigure:
    """Friction along x with the limits of stick and slip; the other components where they act."""
    p = mechanics_of(dataset).pack()
    limits = {"μₛ m g": P_MU_S, "μₖ m g": P_MU_K}
    sizes = {text: p[place] * p[P_NORMAL_FORCE] for text, place in limits.items()}
    panels, left_out = [], []
    for name, unit, label, colour in COMPONENTS:
        values = dataset[name].values
        acts = np.nanmax(np.abs(values), initial=0.0) > SMALLEST_SHARE * max(sizes.values())
        if name != "friction_force_x" and not acts:
            left_out.append(label)
            continue
        scaled = readable(values, unit)
        levels = _levels(scaled(values), scaled, sizes) if name == "friction_force_x" else ()
        panels.append(
            Panel(
                f"{label} [{scaled.unit}]",
                [Curve(label, scaled(values), colour)],
                levels=levels,
                span=1e-6,
            )
        )
    note = f"Not drawn, as 0 throughout: {', '.join(left_out)}." if left_out else ""
    height = 2.6 if len(panels) == 1 else 2.0
    return TimeFigure(
        dataset["time"].values, panels, title="Friction on the block", note=note, height=height
    )


def _levels(values: Array, scaled: Scaled, sizes: dict[str, float]) -> list[tuple[float, str]]:
    """The limits that the curve comes near to, of either sign."""
    known = values[np.isfinite(values)]
    low, high = (float(known.min()), float(known.max())) if known.size else (0.0, 0.0)
    return [
        (sign * scaled.factor * size, mark + text)
        for text, size in sizes.items()
        for sign, mark in ((1.0, ""), (-1.0, "−"))
        if size != 0.0
        and min(low, 0.0) * 1.1 <= sign * scaled.factor * size <= max(high, 0.0) * 1.1
    ]
