"""The rig from above, to scale: springs and block, at rest and at its extreme positions."""

from typing import NamedTuple

import numpy as np
from stickslip import Parameters
from stickslip.kernel.layout import P_CURVATURE

from cosim.report.bounds import WIDTH, known_rows, spring_ends
from cosim.report.columns import Array, Data
from cosim.report.contents import mechanics_of, value_of
from cosim.report.live import Live, packed

from .over_time import SMALLEST_ANGLE_DEG, zoom_of


class Pose(NamedTuple):
    """Position (m) and rotation (rad) of the block in the frame of the rig."""

    x: float
    y: float
    phi: float


REST = Pose(0.0, 0.0, 0.0)


def anchors(parameters: Parameters) -> Array:
    """Fixed ends of the springs (4, 2), m."""
    return spring_ends(parameters)[0]


def attachments(parameters: Parameters, pose: Pose) -> Array:
    """Ends of the springs on the block (4, 2), m: (x, y) + R(phi) b_i."""
    c, s = np.cos(pose.phi), np.sin(pose.phi)
    turned = spring_ends(parameters)[1] @ np.array([[c, s], [-s, c]])
    return np.asarray(np.array([pose.x, pose.y]) + turned)


MARGINS = 0.03, 0.008  # m, around everything drawn, along and across

Box = tuple[float, float, float, float]


def extreme_poses(dataset: Data) -> list[tuple[str, Pose]]:
    """At rest, furthest along +-x, and the largest rotation where the block turns."""
    known = known_rows(dataset)
    found = [("at rest", REST)]
    for what, name in (("furthest from rest", "x"), ("largest rotation", "phi")):
        sizes = np.abs(known[name].values)
        turns = name == "phi" and np.degrees(np.max(sizes, initial=0.0)) > SMALLEST_ANGLE_DEG
        if sizes.size and (turns or name == "x"):
            row = int(sizes.argmax())
            pose = Pose(*(float(known[each][row]) for each in Pose._fields))
            found.append((f"{what}, t = {float(known['time'][row]):.2f} s\n{_told(pose)}", pose))
    return found


def _told(pose: Pose) -> str:
    x, y, phi = 1e3 * pose.x, 1e3 * pose.y, np.degrees(pose.phi)
    return f"x = {x:z.1f} mm, y = {y:z.1f} mm, φ = {phi:z.1f}°".replace("-", "−")


def centre_of(parameters: Parameters) -> tuple[float, float] | None:
    """Centre of a turning slab, m; None for a belt."""
    curvature = parameters.pack()[P_CURVATURE]
    return (0.0, 1.0 / curvature) if curvature != 0.0 else None


def box_of(parameters: Parameters, poses: list[Pose]) -> Box:
    """x from, to and y from, to of block and springs, m; a slab's far centre is not part of it."""
    radius = parameters.rig.contact_radius
    points = [*anchors(parameters)]
    for pose in poses:
        points += [(pose.x - radius, pose.y - radius), (pose.x + radius, pose.y + radius)]
        points += [*attachments(parameters, pose)]
    low, high = np.min(points, axis=0) - MARGINS, np.max(points, axis=0) + MARGINS
    return low[0], high[0], low[1], high[1]


def belt_width(dataset: Data) -> float | None:
    """Width of the belt, m; None for a slab, or where it is not known."""
    if mechanics_of(dataset).pack()[P_CURVATURE] != 0.0:
        return None
    width = dataset.attrs.get(WIDTH, value_of(dataset, "belt", "width"))
    return float(width) if width else None


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


#: Frames of an animation at most: ten a second of a run of five minutes, all rows of a short one.
MOST_FRAMES = 3000


def top_view_live(dataset: Data) -> Live:
    """The rig in motion, for the page: positions over time, and what does not change.

    The belt's colours are taken from the map of its temperature, where the page has one.
    """
    parameters = mechanics_of(dataset)
    poses = extreme_poses(dataset)
    known = known_rows(dataset)
    every = max(-(-known.sizes["time"] // MOST_FRAMES), 1)
    rows = known.isel(time=slice(None, None, every))
    return {
        "kind": "top_view",
        "time": packed(rows["time"].values, "f8"),
        **{name: packed(rows[name].values) for name in Pose._fields},
        "travel": packed(rows["surface_travel"].values),
        "mode": packed(np.nan_to_num(rows["mode"].values), "u1"),
        "anchors": anchors(parameters).ravel().tolist(),
        "arms": attachments(parameters, REST).ravel().tolist(),
        "radius": parameters.rig.contact_radius,
        "width": belt_width(dataset),
        # of a slab, of which the contact warms a ring
        "ring": 2.0 * parameters.rig.contact_radius,
        "curvature": float(parameters.pack()[P_CURVATURE]),
        "speed": parameters.surface.speed,
        "box": [float(edge) for edge in box_of(parameters, [pose for _, pose in poses])],
        "words": surface_words(dataset) + _compared(dataset),
        "start": zoom.begin if (zoom := zoom_of(dataset)) else 0.0,
        "map": "belt_temperature" if "belt_temperature" in dataset else None,
    }
