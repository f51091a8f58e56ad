"""Velocity over position: the block's way in its phase plane, and the surface's speed."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from stickslip.kernel.layout import P_CURVATURE

from cosim.report.columns import Array, Data
from cosim.report.contents import break_aways, mechanics_of, ramp_end
from cosim.report.live import Live, packed
from cosim.report.palette import BLUE, GREY, INK, RED, Scaled, readable

from .events import through_events
from .over_time import DEGREES, SMALLEST_ANGLE_DEG, zoom_of

DEGREES_PER_SECOND = Scaled(180.0 / np.pi, "°/s")
RAMP = "speed ramp"
#: Points of a way on a page: more than a wide screen tells apart.
MOST_POINTS = 20_000


@dataclass(frozen=True)
class Way:
    """Points (n,) joined by a line; x None: all across at the one y. fades: in from the paper."""

    label: str
    x: Array | None
    y: Array
    colour: str
    width: float
    fades: bool = False
    dash: bool = False


class PhasePlane(NamedTuple):
    """Labels of its axes, and what is in it."""

    across: str
    upwards: str
    ways: list[Way]


def phase_portrait(dataset: Data) -> list[PhasePlane]:
    """(x, vx) with the speed of the surface, and (phi, omega) where the block turns."""
    run, (dataset, _) = dataset, through_events(dataset)
    surface = local_surface_speed(dataset)
    x = readable(dataset["x"].values, "m")
    vx = readable(np.append(dataset["vx"].values, surface[-1:]), "m/s")
    parts = _parts(run, dataset["time"].values)
    ways = _ways(dataset, parts, ("x", x), ("vx", vx))
    ways.append(_surface_speed(dataset, surface, x, vx, break_aways(run)))
    planes = [PhasePlane(f"x [{x.unit}]", f"velocity along x [{vx.unit}]", ways)]
    if np.degrees(np.nanmax(np.abs(dataset["phi"].values), initial=0.0)) > SMALLEST_ANGLE_DEG:
        turning = _ways(dataset, parts, ("phi", DEGREES), ("omega", DEGREES_PER_SECOND))
        planes.append(PhasePlane("φ [°]", "angular velocity [°/s]", turning))
    return planes


def phase_portrait_live(dataset: Data) -> Live:
    """The same for a page's scripts."""
    planes = [
        plane._asdict() | {"ways": [_live(way) for way in plane.ways]}
        for plane in phase_portrait(dataset)
    ]
    return {"kind": "phase_plane", "planes": planes}


def _live(way: Way) -> Live:
    each = slice(None, None, -(-way.y.size // MOST_POINTS))
    across = None if way.x is None else packed(way.x[each])
    return vars(way) | {"x": across, "y": packed(way.y[each])}


def local_surface_speed(dataset: Data) -> Array:
    """Speed of the surface along x below the middle of the block, m/s: (times,).

    A slab that turns about (0, 1 / curvature) is slower the nearer to that centre.
    """
    parameters = mechanics_of(dataset)
    speed: float | Array = parameters.surface.speed
    if "surface_speed_actual" in dataset:
        speed = dataset["surface_speed_actual"].values
    return np.asarray(speed * (1.0 - parameters.pack()[P_CURVATURE] * dataset["y"].values))


def _surface_speed(dataset: Data, surface: Array, x: Scaled, vx: Scaled, starts: Array) -> Way:
    """Where the block sticks: a line on a belt; on a slab it goes with the place of the block."""
    late = dataset["time"].values >= ramp_end(dataset)
    speeds = vx(surface[late] if late.any() else surface[-1:])
    if np.ptp(speeds) <= 1e-6 * np.max(np.abs(speeds), initial=1e-12):
        return Way("speed of the surface", None, speeds[:1], INK, 1.0, dash=True)
    # one cycle and one way: else the dashes would fill each other's gaps
    time = dataset["time"].values
    shown = (time >= starts[-2]) & (time <= starts[-1]) if starts.size > 1 else late
    shown &= dataset["vx"].values > 0.0
    below = "speed of the surface below the block"
    return Way(below, x(dataset["x"].values[shown]), vx(surface[shown]), INK, 1.0, dash=True)


class _Part(NamedTuple):
    """A part of a run: rows of its time, its colour and width."""

    label: str
    rows: slice
    colour: str
    width: float


def _ways(
    dataset: Data, parts: list[_Part], across: tuple[str, Scaled], upwards: tuple[str, Scaled]
) -> list[Way]:
    x, y = (scaled(dataset[name].values) for name, scaled in (across, upwards))
    return [
        Way(part.label, x[part.rows], y[part.rows], part.colour, part.width, part.label == RAMP)
        for part in parts
        if x[part.rows].size
    ]


def _parts(run: Data, time: Array) -> list[_Part]:
    """Each ends where the next begins."""
    ramp, zoom = ramp_end(run), zoom_of(run)
    first = int(np.searchsorted(time, ramp, side="right")) if ramp else 0
    late = end = time.size
    if zoom:
        late = int(np.searchsorted(time, zoom.begin))
        end = int(np.searchsorted(time, zoom.end, side="right"))
    first = min(first, late)
    rest = "after the speed ramp" if ramp else "run"
    parts = [
        _Part(RAMP, slice(0, first + 1 if first else 0), GREY, 0.8),
        _Part(rest, slice(first, late + 1), BLUE, 0.9),
        _Part(zoom.title if zoom else "", slice(late, end), RED, 1.3),
    ]
    if end < time.size:
        parts.append(_Part("", slice(end - 1, None), BLUE, 0.9))
    return parts
