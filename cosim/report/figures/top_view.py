"""The rig from above, to scale: springs and block, at rest and at its extreme positions."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Rectangle
from numpy.typing import NDArray
from stickslip import Parameters
from stickslip.kernel.layout import P_ANCHOR, P_ATTACH, P_CURVATURE

from cosim.report.contents import mechanics_of, value_of
from cosim.report.style import BLUE, GREY, INK, RED, plain_ticks, styled

from .motion import SMALLEST_ANGLE_DEG
from .over_time import title

Array = NDArray[np.float64]


class Pose(NamedTuple):
    """Position (m) and rotation (rad) of the block in the frame of the rig."""

    x: float
    y: float
    phi: float


REST = Pose(0.0, 0.0, 0.0)


def anchors(parameters: Parameters) -> Array:
    """Fixed ends of the springs (4, 2), m."""
    return np.array(parameters.pack()[P_ANCHOR : P_ANCHOR + 8]).reshape(4, 2)


def attachments(parameters: Parameters, pose: Pose) -> Array:
    """Ends of the springs on the block (4, 2), m: (x, y) + R(phi) b_i."""
    arms = np.array(parameters.pack()[P_ATTACH : P_ATTACH + 8]).reshape(4, 2)
    c, s = np.cos(pose.phi), np.sin(pose.phi)
    return np.array([pose.x, pose.y]) + arms @ np.array([[c, s], [-s, c]])


def coil(begin: Array, end: Array, turns: int = 9, width: float = 0.006) -> Array:
    """A spring drawn as a zigzag from ``begin`` to ``end`` (2,), m: (2 turns + 4, 2)."""
    along = end - begin
    length = np.hypot(*along)
    across = np.array([-along[1], along[0]]) / length
    stations = np.concatenate([[0.0], np.linspace(0.12, 0.88, 2 * turns + 2), [1.0]])
    swing = np.zeros(stations.size)
    swing[2:-2] = 0.5 * width * np.where(np.arange(stations.size - 4) % 2, 1.0, -1.0)
    return begin + stations[:, None] * along + swing[:, None] * across


MARGIN = 0.03  # m around everything drawn
FARTHEST_CENTRE = 1.0  # m; a slab's centre beyond it would shrink the rig to a dot
SHEET_WIDTH, SHEET_HEIGHT = 11.0, 8.5  # inches at most
SURFACE = "#EDEDED"
ARROW = 0.06  # m, length of the arrow for the surface's direction


@styled
def draw_top_view(dataset: xr.Dataset) -> Figure:
    """Block, springs and surface; a panel for each position, all to the same scale."""
    parameters = mechanics_of(dataset)
    poses = extreme_poses(dataset)
    box = _box(parameters, [pose for _, pose in poses])
    width, height = box[1] - box[0], box[3] - box[2]
    stacked = width > 1.6 * height
    figure = Figure(figsize=_sheet(width, height, len(poses), stacked), layout="compressed")
    panels = figure.subplots(
        *((len(poses), 1) if stacked else (1, len(poses))), squeeze=False, sharex=True, sharey=True
    )
    for panel, (text, pose) in zip(panels.flat, poses, strict=True):
        _draw_surface(panel, dataset, parameters, box)
        if pose != REST:
            _draw_outline(panel, parameters)
        _draw_rig(panel, parameters, pose)
        _frame(panel, text, box)
    for panel in panels[-1]:
        panel.set_xlabel("x [m]")
    for panel in panels[:, 0]:
        panel.set_ylabel("y [m]")
    title(figure, "Block and springs from above, to scale", dataset)
    return figure


def extreme_poses(dataset: xr.Dataset) -> list[tuple[str, Pose]]:
    """At rest, furthest along +-x, and the largest rotation where the block turns."""
    poses = [("at rest", REST)]
    finite = np.isfinite((dataset["x"] + dataset["y"] + dataset["phi"]).values)
    known = dataset.isel(time=finite)
    if known.sizes["time"] == 0:
        return poses
    row = known.isel(time=int(np.abs(known["x"].values).argmax()))
    poses.append((f"furthest from rest, {_told(row)}", _pose(row)))
    row = known.isel(time=int(np.abs(known["phi"].values).argmax()))
    if abs(np.degrees(float(row["phi"]))) > SMALLEST_ANGLE_DEG:
        poses.append((f"largest rotation, {_told(row)}", _pose(row)))
    return poses


def _pose(row: xr.Dataset) -> Pose:
    return Pose(float(row["x"]), float(row["y"]), float(row["phi"]))


def _told(row: xr.Dataset) -> str:
    x, y, phi = _pose(row)
    return (
        f"t = {float(row['time']):.2f} s\n"
        f"x = {1e3 * x:z.1f} mm, y = {1e3 * y:z.1f} mm, φ = {np.degrees(phi):z.1f}°"
    ).replace("-", "−")


def _centre(parameters: Parameters) -> tuple[float, float] | None:
    """Centre of a turning slab, m; None for a belt or where it is too far to be shown."""
    curvature = parameters.pack()[P_CURVATURE]
    if curvature == 0.0 or abs(curvature) < 1.0 / FARTHEST_CENTRE:
        return None
    return 0.0, 1.0 / curvature


def _box(parameters: Parameters, poses: list[Pose]) -> tuple[float, float, float, float]:
    """x from, to and y from, to of everything drawn, m."""
    reach = max(parameters.rig.attachment_radius, parameters.rig.contact_radius)
    points = [*anchors(parameters)]
    for pose in poses:
        points += [(pose.x - reach, pose.y - reach), (pose.x + reach, pose.y + reach)]
    centre = _centre(parameters)
    if centre is not None:
        points.append(centre)
    low, high = np.min(points, axis=0) - MARGIN, np.max(points, axis=0) + MARGIN
    return low[0], high[0], low[1], high[1]


def _sheet(width: float, height: float, panels: int, stacked: bool) -> tuple[float, float]:
    """Size of the figure, inches, that leaves little beside panels of equal scale."""
    across, down = (1, panels) if stacked else (panels, 1)
    # for labels and titles of two lines: left of a column, over a row, and once for the sheet
    left, over, sheet = (0.9, 0.6, 0.7) if stacked else (0.75, 0.6, 0.95)
    scale = min(
        (SHEET_WIDTH - left * across) / (across * width),
        (SHEET_HEIGHT - over * down - sheet) / (down * height),
    )
    return left * across + scale * across * width, sheet + over * down + scale * down * height


def _frame(axes: Axes, text: str, box: tuple[float, float, float, float]) -> None:
    axes.set_title(text)
    axes.set_xlim(box[0], box[1])
    axes.set_ylim(box[2], box[3])
    axes.set_aspect("equal")
    axes.grid(False)
    plain_ticks(axes)


def _draw_surface(
    axes: Axes, dataset: xr.Dataset, parameters: Parameters, box: tuple[float, float, float, float]
) -> None:
    """The belt as a band of its width (a slab fills the view) and where it moves to."""
    speed = parameters.surface.speed
    centre = _centre(parameters)
    belt = parameters.pack()[P_CURVATURE] == 0.0
    width = value_of(dataset, "belt", "width") if belt else None
    low, high = (-0.5 * width, 0.5 * width) if width else (box[2], box[3])
    axes.add_patch(Rectangle((box[0], low), box[1] - box[0], high - low, color=SURFACE, zorder=0))
    if centre is not None:
        _draw_centre(axes, centre)
    if speed != 0.0:
        # the lower left corner: neither springs nor block ever come there
        left, y = box[0] + 0.012, box[2] + 0.014
        ends = (left, left + ARROW) if speed > 0.0 else (left + ARROW, left)
        axes.annotate(
            "",
            (ends[1], y),
            (ends[0], y),
            arrowprops={
                "arrowstyle": "-|>",
                "color": RED,
                "linewidth": 1.8,
                "shrinkA": 0,
                "shrinkB": 0,
            },
        )
        axes.annotate(
            f"surface, {abs(speed):g} m/s" + _turning(parameters),
            (left + ARROW, y),
            xytext=(6, 0),
            textcoords="offset points",
            va="center",
            color=RED,
            fontsize=9,
        )


def _turning(parameters: Parameters) -> str:
    """Where a slab turns whose centre is out of sight."""
    curvature = parameters.pack()[P_CURVATURE]
    if curvature == 0.0 or _centre(parameters) is not None:
        return ""
    return f", turning about y = {1.0 / curvature:.4g} m".replace("-", "−")


def _draw_centre(axes: Axes, centre: tuple[float, float]) -> None:
    """The slab's centre and the circle about it on which the block rests."""
    radius = abs(centre[1])
    axes.plot(*centre, marker="+", markersize=12, markeredgewidth=1.6, color=RED)
    axes.annotate(
        "centre of the slab",
        centre,
        xytext=(9, 0),
        textcoords="offset points",
        va="center",
        color=RED,
        fontsize=9,
    )
    axes.add_patch(Arc(centre, 2 * radius, 2 * radius, color=RED, linewidth=0.8, linestyle=":"))


def _draw_outline(axes: Axes, parameters: Parameters) -> None:
    """Where the block is at rest."""
    axes.add_patch(
        Circle(
            (0.0, 0.0),
            parameters.rig.contact_radius,
            fill=False,
            edgecolor=GREY,
            linestyle=":",
            linewidth=1.0,
            zorder=4,
        )
    )


def _draw_rig(axes: Axes, parameters: Parameters, pose: Pose) -> None:
    """Anchors, springs, the contact disc, its arms and a mark that turns with it."""
    fixed, moving = anchors(parameters), attachments(parameters, pose)
    middle = np.array([pose.x, pose.y])
    springs = [coil(begin, end) for begin, end in zip(fixed, moving, strict=True)]
    axes.add_collection(LineCollection(springs, colors=INK, linewidths=1.0, zorder=3))
    arms = [np.array([middle, end]) for end in moving]
    axes.add_collection(LineCollection(arms, colors=BLUE, linewidths=2.2, zorder=1))
    axes.add_patch(
        Circle(
            (pose.x, pose.y),
            parameters.rig.contact_radius,
            facecolor="#CFE3F1",
            edgecolor=BLUE,
            linewidth=1.6,
            zorder=2,
        )
    )
    tip = middle + 0.8 * parameters.rig.contact_radius * np.array(
        [np.cos(pose.phi), np.sin(pose.phi)]
    )
    axes.plot([middle[0], tip[0]], [middle[1], tip[1]], color=BLUE, linewidth=1.4, zorder=4)
    axes.plot(*middle, "o", color=BLUE, markersize=4, zorder=5)
    axes.plot(*moving.T, "o", color=INK, markersize=4, zorder=5)
    axes.plot(*fixed.T, "s", color=INK, markersize=7, zorder=5)
