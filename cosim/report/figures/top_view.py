"""The rig from above, to scale: springs and block, at rest and at its extreme positions."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Rectangle
from numpy.typing import NDArray
from stickslip import Parameters
from stickslip.kernel.layout import P_ANCHOR, P_ATTACH, P_CURVATURE

from cosim.report.bounds import WIDTH
from cosim.report.columns import Data
from cosim.report.contents import mechanics_of, value_of
from cosim.report.live import Live, packed
from cosim.report.style import (
    BLUE,
    DARK_RED,
    GREY,
    INK,
    PALE_BLUE,
    PALE_GREY,
    RED,
    plain_ticks,
    styled,
)

from .motion import SMALLEST_ANGLE_DEG
from .over_time import title, zoom_of

Array = NDArray[np.float64]


class Pose(NamedTuple):
    """Position (m) and rotation (rad) of the block in the frame of the rig."""

    x: float
    y: float
    phi: float


REST = Pose(0.0, 0.0, 0.0)
#: Of a spring that is drawn: turns, and its width, m.
TURNS, COIL = 9, 0.006


def anchors(parameters: Parameters) -> Array:
    """Fixed ends of the springs (4, 2), m."""
    return np.array(parameters.pack()[P_ANCHOR : P_ANCHOR + 8]).reshape(4, 2)


def attachments(parameters: Parameters, pose: Pose) -> Array:
    """Ends of the springs on the block (4, 2), m: (x, y) + R(phi) b_i."""
    arms = np.array(parameters.pack()[P_ATTACH : P_ATTACH + 8]).reshape(4, 2)
    c, s = np.cos(pose.phi), np.sin(pose.phi)
    return np.asarray(np.array([pose.x, pose.y]) + arms @ np.array([[c, s], [-s, c]]))


def coil(begin: Array, end: Array) -> Array:
    """A spring drawn as a zigzag from ``begin`` to ``end`` (2,), m: (2 TURNS + 4, 2)."""
    along = end - begin
    length = np.hypot(*along)
    across = np.array([-along[1], along[0]]) / length
    stations = np.concatenate([[0.0], np.linspace(0.12, 0.88, 2 * TURNS + 2), [1.0]])
    swing = np.zeros(stations.size)
    swing[2:-2] = 0.5 * COIL * np.where(np.arange(stations.size - 4) % 2, 1.0, -1.0)
    return np.asarray(begin + stations[:, None] * along + swing[:, None] * across)


MARGIN = 0.03  # m around everything drawn
SHEET_WIDTH, SHEET_HEIGHT = 9.5, 6.0  # of all panels, inches at most
ARROW = 0.06  # m, length of the arrow for the surface's direction
WORDS = 0.015  # m, for what stands below the rig

Box = tuple[float, float, float, float]


@styled
def draw_top_view(dataset: Data) -> Figure:
    """Block, springs and surface; a panel for each position, all to the same scale."""
    parameters = mechanics_of(dataset)
    poses = extreme_poses(dataset)
    box = _box(parameters, [pose for _, pose in poses])
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
    title(figure, "Block and springs from above, to scale", dataset)
    return figure


def _known(dataset: Data) -> Data:
    """The rows in which the block's place is known."""
    known = [np.isfinite(dataset[name].values) for name in Pose._fields]
    return dataset.isel(time=np.all(known, axis=0))


def extreme_poses(dataset: Data) -> list[tuple[str, Pose]]:
    """At rest, furthest along +-x, and the largest rotation where the block turns."""
    known = _known(dataset)
    times, poses = known["time"].values, [known[name].values for name in Pose._fields]
    found = [("at rest", REST)]
    for what, values in (("furthest from rest", poses[0]), ("largest rotation", poses[2])):
        turns = np.max(np.abs(np.degrees(poses[2])), initial=0.0) > SMALLEST_ANGLE_DEG
        if values.size and (turns or values is poses[0]):
            row = int(np.abs(values).argmax())
            pose = Pose(*(float(each[row]) for each in poses))
            found.append((f"{what}, t = {times[row]:.2f} s\n{_told(pose)}", pose))
    return found


def _told(pose: Pose) -> str:
    x, y, phi = 1e3 * pose.x, 1e3 * pose.y, np.degrees(pose.phi)
    return f"x = {x:z.1f} mm, y = {y:z.1f} mm, φ = {phi:z.1f}°".replace("-", "−")


def centre_of(parameters: Parameters) -> tuple[float, float] | None:
    """Centre of a turning slab, m; None for a belt."""
    curvature = parameters.pack()[P_CURVATURE]
    return (0.0, 1.0 / curvature) if curvature != 0.0 else None


def _box(parameters: Parameters, poses: list[Pose]) -> Box:
    """x from, to and y from, to of block and springs, m; a slab's far centre is not part of it."""
    reach = max(parameters.rig.attachment_radius, parameters.rig.contact_radius)
    points = [*anchors(parameters)]
    for pose in poses:
        points += [(pose.x - reach, pose.y - reach), (pose.x + reach, pose.y + reach)]
    low, high = np.min(points, axis=0) - MARGIN, np.max(points, axis=0) + MARGIN
    # room for the words on the surface below the rig
    return low[0], high[0], low[1] - WORDS, high[1]


def belt_width(dataset: Data) -> float | None:
    """Width of the belt, m; None for a slab, or where it is not known."""
    if mechanics_of(dataset).pack()[P_CURVATURE] != 0.0:
        return None
    width = dataset.attrs.get(WIDTH, value_of(dataset, "belt", "width"))
    return float(width) if width else None


def _draw_surface(axes: Axes, dataset: Data, parameters: Parameters, box: Box) -> None:
    """The belt as a band of its width (a slab fills the view), its name and where it moves to."""
    width = belt_width(dataset)
    low, high = (-0.5 * width, 0.5 * width) if width else (box[2], box[3])
    axes.add_patch(Rectangle((box[0], low), box[1] - box[0], high - low, color=PALE_GREY, zorder=0))
    centre = centre_of(parameters)
    if centre is not None:
        radius = abs(centre[1])
        axes.add_patch(Arc(centre, 2 * radius, 2 * radius, color=RED, linewidth=0.8, linestyle=":"))
    # the lower left corner: neither springs nor block ever come there
    left, y, speed = box[0] + 0.012, box[2] + 0.012, parameters.surface.speed
    if speed != 0.0:
        ends = ((left, y), (left + ARROW, y))[:: 1 if speed > 0.0 else -1]
        look = {"arrowstyle": "-|>", "color": RED, "linewidth": 1.8, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", ends[1], ends[0], arrowprops=look)
    place = (left + (ARROW if speed else 0.0) + 0.005, y)
    words = surface_words(dataset, " (grey)")
    axes.annotate(words, place, va="center", color=DARK_RED, fontsize=9)


def surface_words(dataset: Data, look: str = "") -> str:
    """What the surface is, and how fast it goes."""
    parameters = mechanics_of(dataset)
    centre, speed = centre_of(parameters), f"{abs(parameters.surface.speed):g} m/s"
    if centre is not None:
        return f"slab{look}, {speed}, turns about (0, {centre[1]:.4g} m)".replace("-", "−")
    width = belt_width(dataset)
    if width is None:
        return f"belt{look}, of unknown width, {speed}"
    block = 2.0 * parameters.rig.contact_radius
    wide = f", below a block of {1e3 * block:g} mm" if block > width else ""
    return f"belt{look}, {1e3 * width:g} mm wide{wide}; {speed}"


def _compared(dataset: Data) -> str:
    """That the block is wider than the belt, where it is."""
    width, block = belt_width(dataset), 2.0 * mechanics_of(dataset).rig.contact_radius
    if width is None or block <= width:
        return ""
    return f"; the block stands {0.5e3 * (block - width):.3g} mm over each edge of the belt"


def _draw_rig(axes: Axes, parameters: Parameters, pose: Pose) -> None:
    """Anchors, springs, the contact disc and where it is at rest, its arms and a mark that turns
    with it.
    """
    fixed, moving = anchors(parameters), attachments(parameters, pose)
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


#: Frames of an animation at most: ten a second of a run of five minutes, all rows of a short one.
MOST_FRAMES = 3000


def top_view_live(dataset: Data) -> Live:
    """The rig in motion, for the page: positions over time, and what does not change.

    The belt's colours are taken from the map of its temperature, where the page has one.
    """
    parameters = mechanics_of(dataset)
    poses = extreme_poses(dataset)
    known = _known(dataset)
    every = max(-(-known.sizes["time"] // MOST_FRAMES), 1)
    rows = known.isel(time=slice(None, None, every))
    curvature = parameters.pack()[P_CURVATURE]
    return {
        "kind": "top_view",
        "time": packed(rows["time"].values, "f8"),
        "x": packed(rows["x"].values),
        "y": packed(rows["y"].values),
        "phi": packed(rows["phi"].values),
        "travel": packed(rows["surface_travel"].values),
        "mode": packed(np.nan_to_num(rows["mode"].values), "u1"),
        "anchors": anchors(parameters).ravel().tolist(),
        "arms": attachments(parameters, REST).ravel().tolist(),
        "radius": parameters.rig.contact_radius,
        "width": belt_width(dataset),
        # of a slab, of which the contact warms a ring
        "ring": 2.0 * parameters.rig.contact_radius,
        "curvature": float(curvature),
        "speed": parameters.surface.speed,
        "box": [float(edge) for edge in _box(parameters, [pose for _, pose in poses])],
        "words": surface_words(dataset) + _compared(dataset),
        "start": zoom.begin if (zoom := zoom_of(dataset)) else 0.0,
        "map": "belt_temperature" if "belt_temperature" in dataset else None,
    }
