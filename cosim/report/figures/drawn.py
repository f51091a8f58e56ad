"""A run's figures as drawings: a page's scripts draw most of them by themselves."""

from collections.abc import Callable
from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Rectangle
from stickslip import Parameters, friction_coefficient

from cosim.report.columns import Array

from ..columns import Data
from ..contents import mechanics_of
from ..live import Live, TimeFigure
from ..palette import BLUE, DARK_RED, GREY, INK, PALE_BLUE, PALE_GREY, RED, SERIES, SLIP
from ..style import draw_over_time, legend, line, panels, plain_ticks, styled
from . import top_view
from .over_time import titled
from .phase_portrait import Way, phase_portrait
from .top_view import REST, Box, Pose

POINTS = 300
#: Part of the way between two points, and beyond the last, that is drawn.
BEYOND = 1.15


@styled
def draw_friction_table(dataset: Data) -> Figure:
    """mu over the sliding speed, a line for each temperature of the table, with its points.

    Shaded: the speeds at which the run slid. Grey: at the run's own interface temperature at its
    end, where the table is over temperatures too.
    """
    parameters = mechanics_of(dataset)
    friction = parameters.friction
    degrees = friction.table_temperature_degC
    fastest = BEYOND * max(friction.table_speed[-1], float(dataset["sliding_speed"].max()))
    speeds = np.linspace(0.0, fastest, POINTS + 1)[1:]
    figure, ((ax,),) = panels(1, 1, height=3.0, width=7.0)
    sliding = dataset["sliding_speed"].values[dataset["mode"].values == 1]
    if sliding.size:
        ax.axvspan(float(sliding.min()), float(sliding.max()), color=SLIP, label="the run's slips")
    for number, temperature in enumerate(degrees or (None,)):
        colour = SERIES[number % len(SERIES)]
        mu = friction_coefficient(parameters, speeds, temperature)
        row = slice(number * len(friction.table_speed), (number + 1) * len(friction.table_speed))
        said = "table" if temperature is None else f"{temperature:g} °C"
        ax.plot(speeds, mu, color=colour, label=said)
        ax.plot(friction.table_speed, friction.table_mu[row], "o", color=colour)
    if degrees and "interface_temperature" in dataset:
        end = float(dataset["interface_temperature"].values[-1])
        mu = friction_coefficient(parameters, speeds, end)
        ax.plot(speeds, mu, color=GREY, linestyle="--", label=f"{end:.3g} °C, of the run's end")
    ax.axhline(friction.mu_s, color=INK, linewidth=0.8, linestyle=":")
    ax.annotate(
        "μ_s", (1.0, friction.mu_s), xycoords=("axes fraction", "data"), va="bottom", ha="right"
    )
    ax.set(xlabel="sliding speed [m/s]", ylabel="friction coefficient [1]", xlim=(0.0, fastest))
    ax.set_ylim(bottom=0.0)
    figure.suptitle("Table of friction", x=0.01, ha="left")
    figure.legend(loc="outside right upper")
    return figure


#: Of a spring that is drawn: turns, and its width, m.
TURNS, COIL = 9, 0.006
SHEET_WIDTH, SHEET_HEIGHT = 9.5, 6.0  # of all panels, inches at most
WORDS = 0.025  # m, for what stands below the rig
ARROW = 0.06  # m, length of the arrow for the surface's direction
#: Opacity of what fades in on a page.
FAINT = 0.5


@styled
def draw_top_view(dataset: Data) -> Figure:
    """Block, springs and surface; a panel for each position, all to the same scale."""
    parameters = mechanics_of(dataset)
    poses = top_view.extreme_poses(dataset)
    left, right, low, high = top_view.box_of(parameters, [pose for _, pose in poses])
    box = left, right, low - WORDS, high
    width, height = box[1] - box[0], box[3] - box[2]
    across, down = (1, len(poses)) if width > 1.6 * height else (len(poses), 1)
    # beside panels of equal scale there is room for labels, for titles of two lines, for the title
    scale = min(SHEET_WIDTH / across / width, SHEET_HEIGHT / down / height)
    size = across * (scale * width + 0.8), down * (scale * height + 0.6) + 0.8
    figure = Figure(figsize=size, layout="compressed")
    panels = figure.subplots(down, across, squeeze=False, sharex=True, sharey=True)
    for axes, (text, pose) in zip(panels.flat, poses, strict=True):
        _draw_surface(axes, dataset, parameters, box)
        _draw_rig(axes, parameters, pose)
        axes.set(title=text, xlim=box[:2], ylim=box[2:], aspect="equal")
        axes.grid(visible=False)
        plain_ticks(axes)
        axes.label_outer()
        axes.set(xlabel="x [m]", ylabel="y [m]")
    _title(figure, "Block and springs from above, to scale", dataset)
    return figure


def _draw_surface(axes: Axes, dataset: Data, parameters: Parameters, box: Box) -> None:
    """The belt as a band of its width (a slab fills the view), its name and where it moves to."""
    width = top_view.belt_width(dataset)
    low, high = (-0.5 * width, 0.5 * width) if width else (box[2], box[3])
    axes.add_patch(Rectangle((box[0], low), box[1] - box[0], high - low, color=PALE_GREY, zorder=0))
    centre = top_view.centre_of(parameters)
    if centre is not None:
        radius = abs(centre[1])
        axes.add_patch(Arc(centre, 2 * radius, 2 * radius, color=RED, linewidth=0.8, linestyle=":"))
    # the lower left corner: neither springs nor block ever come there
    left, y, speed = box[0] + 0.012, box[2] + 0.012, parameters.surface.speed
    if speed != 0.0:
        start, end = ((left, y), (left + ARROW, y))[:: 1 if speed > 0.0 else -1]
        look = {"arrowstyle": "-|>", "color": RED, "linewidth": 1.8, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", end, start, arrowprops=look)
    place = (left + (ARROW if speed else 0.0) + 0.005, y)
    words = top_view.surface_words(dataset, " (grey)")
    axes.annotate(words, place, va="center", color=DARK_RED, fontsize=9)


def _draw_rig(axes: Axes, parameters: Parameters, pose: Pose) -> None:
    """Anchors, springs, the contact disc and where it is at rest, its arms and a mark that turns
    with it.
    """
    fixed, moving = top_view.anchors(parameters), top_view.attachments(parameters, pose)
    middle, radius = np.array(pose[:2]), parameters.rig.contact_radius
    springs = [coil(begin, end) for begin, end in zip(fixed, moving, strict=True)]
    axes.add_collection(LineCollection(springs, colors=INK, linewidths=1.0, zorder=3))
    arms = [np.array([middle, end]) for end in moving]
    axes.add_collection(LineCollection(arms, colors=BLUE, linewidths=2.2, zorder=1))
    look = {"facecolor": PALE_BLUE, "edgecolor": BLUE, "linewidth": 1.6, "zorder": 2}
    axes.add_patch(Circle(pose[:2], radius, **look))
    if pose != REST:
        axes.add_patch(Circle((0.0, 0.0), radius, fill=False, edgecolor=GREY, ls=":", zorder=4))
    tip = middle + 0.8 * radius * np.array([np.cos(pose.phi), np.sin(pose.phi)])
    axes.plot(*np.array([middle, tip]).T, color=BLUE, linewidth=1.4, zorder=4)
    axes.plot(*middle, "o", color=BLUE, markersize=4, zorder=5)
    axes.plot(*moving.T, "o", color=INK, markersize=4, zorder=5)
    axes.plot(*fixed.T, "s", color=INK, markersize=7, zorder=5)


def coil(begin: Array, end: Array) -> Array:
    """A spring drawn as a zigzag from ``begin`` to ``end`` (2,), m: (2 TURNS + 4, 2)."""
    along = end - begin
    length = np.hypot(*along)
    across = np.array([-along[1], along[0]]) / length
    stations = np.concatenate([[0.0], np.linspace(0.12, 0.88, 2 * TURNS + 2), [1.0]])
    swing = np.zeros(stations.size)
    swing[2:-2] = 0.5 * COIL * np.where(np.arange(stations.size - 4) % 2, 1.0, -1.0)
    return np.asarray(begin + stations[:, None] * along + swing[:, None] * across)


@styled
def draw_phase_portrait(dataset: Data) -> Figure:
    """Its planes side by side."""
    planes = phase_portrait(dataset)
    figure = Figure(figsize=(11.0 if len(planes) > 1 else 7.5, 5.0), layout="constrained")
    panels = figure.subplots(1, len(planes), squeeze=False)[0]
    for axes, plane in zip(panels, planes, strict=True):
        plain_ticks(axes)
        for way in plane.ways:
            _draw_way(axes, way)
        axes.set(xlabel=plane.across, ylabel=plane.upwards)
    _title(figure, "Phase portrait", dataset)
    legend(figure, panels[0].get_legend_handles_labels()[0], "outside lower center")
    return figure


def _draw_way(axes: Axes, way: Way) -> None:
    look: dict[str, Any] = {"color": way.colour, "linewidth": way.width, "label": way.label}
    look |= {"linestyle": "--", "zorder": 3} if way.dash else {}
    look |= {"alpha": FAINT} if way.fades else {}
    if way.x is None:
        axes.axhline(float(way.y[0]), **look)
    else:
        line(axes, way.x, way.y, **look)


def _title(figure: Figure, text: str, dataset: Data) -> None:
    """At the left, with the case's name."""
    figure.suptitle(titled(text, dataset), x=0.008, ha="left", color=INK)


#: Of the figures that are not over time.
DRAWN = {
    "top_view": draw_top_view,
    "phase_portrait": draw_phase_portrait,
    "friction_table": draw_friction_table,
}


def drawing(name: str, show: Callable[[Data], TimeFigure | Live] | None, dataset: Data) -> Figure:
    """A figure by its name, or what is shown over time."""
    if name in DRAWN or show is None:
        return DRAWN[name](dataset)
    return draw_over_time(cast(TimeFigure, show(dataset)))
