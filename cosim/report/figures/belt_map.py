"""Temperature of the belt over place and time: a map, with the way of the block on it.

The belt is known at the run's pictures, some a revolution. Between two of them a place of the belt
changes much only while it is below the block. So each place keeps the earlier picture's temperature
until the block comes, has the later one's once the block has left, and goes evenly from one to the
other where the block does not come by. Below the block stands the mean of the contact: at its
edges, where single cells of the mesh are half in contact, pictures have spikes that are the mesh's.
What the block left just before a picture is hot in it, and has cooled by the next: it takes that.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cosim.report.columns import Array, Data
from cosim.report.contents import thermal_of, value_of
from cosim.report.heat_numbers import ambient_degC
from cosim.report.live import Curve, Map, Panel, TimeFigure
from cosim.report.palette import HEAT_MAP, SKY, readable

from .over_time import titled

#: Of the map: times and places.
MOST_TIMES, MOST_PLACES = 500, 400
# below this (K) a rise is rounding
SMALLEST_RISE = 1e-9


class BeltMap(NamedTuple):
    """rise (times, places) K over the air at time (s) and place (m) of the belt's material.

    contact (times,) m: the place below the middle of the block, in 0 to length. contact_length m.
    """

    time: Array
    place: Array
    rise: Array
    contact: Array
    contact_length: float
    length: float


def belt_map(dataset: Data) -> BeltMap:
    """The map of a coupled run that has pictures of its belt."""
    length = float(thermal_of(dataset).belt.length)
    pictures = dataset["snapshot_time"].values
    rows = dataset["time"].values
    time = _times(rows, pictures)
    position, rise = _places(
        dataset["belt_position"].values, dataset["belt_temperature"].values - ambient_degC(dataset)
    )
    reach = float(dataset["contact_position"].attrs["contact_length"])
    way = (dataset["surface_travel"].values - dataset["x"].values).astype(float)
    known = np.isfinite(way)
    way_at = np.interp(time, rows[known], way[known])
    way_then = np.interp(pictures, rows[known], way[known])
    start = float(dataset["contact_position"].values[0]) + way_then[0]
    contact = (start - way_at) % length
    field = _field(time, position, pictures, rise, (way_at, way_then, start), reach, length)
    return BeltMap(time, position, field, contact, reach, length)


def _times(rows: Array, pictures: Array) -> Array:
    """Evenly spread over what there are pictures of."""
    begin, end = float(pictures[0]), float(pictures[-1])
    inside = rows[(rows >= begin) & (rows <= end)]
    if inside.size <= MOST_TIMES:
        return inside if inside.size else pictures[:1].astype(float)
    return np.linspace(begin, end, MOST_TIMES)


def _places(position: Array, rise: Array) -> tuple[Array, Array]:
    """Means of neighbours, where there are more places than a map shows."""
    many = -(-position.size // MOST_PLACES)
    count = position.size // many
    place, rises = (each[..., : count * many] for each in (position, rise))
    return place.reshape(count, many).mean(axis=1), rises.reshape(-1, count, many).mean(axis=2)


def _field(
    time: Array,
    place: Array,
    pictures: Array,
    rise: Array,
    ways: tuple[Array, Array, float],
    reach: float,
    length: float,
) -> Array:
    """rise (pictures, places) K at all times: (times, places)."""
    way_at, way_then, start = ways
    forwards = 1.0 if way_then[-1] >= way_then[0] else -1.0
    # a place that is half in contact counts as in contact: its mean is that of both
    touched = reach + 2.0 * (place[1] - place[0] if place.size > 1 else 0.0)
    below = _below(place, start - way_then[:, None], touched, length)
    # the mean below the block, of the places that are wholly there
    weight = _below(place, start - way_then[:, None], 0.8 * reach, length)
    means = [
        row[inner].mean() if inner.any() else row.max()
        for row, inner in zip(rise, weight, strict=True)
    ]
    contact = np.array(means)
    rise = np.where(below, contact[:, None], rise)

    def behind(k: int) -> Array:
        """How far the surface must go from picture k on until the block has left each place."""
        return np.asarray((0.5 * touched - forwards * (place - (start - way_then[k]))) % length)

    field = np.empty((time.size, place.size))
    for row, (now, way) in enumerate(zip(time, way_at, strict=True)):
        k = min(max(int(np.searchsorted(pictures, now, side="right")) - 1, 0), pictures.size - 1)
        after = min(k + 1, pictures.size - 1)
        span = pictures[after] - pictures[k]
        part = (now - pictures[k]) / span if span > 0.0 else 0.0
        left = behind(k)
        gone = forwards * (way - way_then[k]) >= left
        comes = forwards * (way_then[after] - way_then[k]) >= left
        if k > 0:
            # hot at the picture just before, for it was left right then: it has cooled since
            gone = gone | (forwards * (way_then[k] - way_then[k - 1]) >= behind(k - 1)) & ~below[k]
        early, late = rise[k], rise[after]
        blend = (1.0 - part) * early + part * late
        field[row] = np.where(gone, late, np.where(comes | below[after], early, blend))
        here = _below(place, start - way, touched, length)
        field[row, here] = (1.0 - part) * contact[k] + part * contact[after]
    return field


def _below(place: Array, centre: Array | float, reach: float, length: float) -> NDArray[np.bool_]:
    """Which places of the loop are within a contact around its centre."""
    return np.abs((place - centre + 0.5 * length) % length - 0.5 * length) <= 0.5 * reach


def surface_word(dataset: Data) -> str:
    """belt or slab."""
    return str(value_of(dataset, "rig", "surface") or "belt")


def belt_temperature(dataset: Data) -> TimeFigure:
    """The map, and the way of the middle of the block."""
    found = belt_map(dataset)
    scaled = readable(found.rise.ravel(), "K", SMALLEST_RISE)
    surface = surface_word(dataset)
    least = scaled.factor * SMALLEST_RISE
    name, unit = "rise over the air", scaled.unit
    field = Map(scaled(found.rise), found.length, name, unit, HEAT_MAP, least)
    way = [Curve("middle of the block", found.contact, SKY)]
    look: Any = {"shaded": False, "from_zero": True, "top": found.length, "map": field}
    panel = Panel(f"place on the {surface} [m]", way, **look)
    title = titled(f"Temperature of the {surface}", dataset)
    return TimeFigure(found.time, [panel], title=title, height=4.1)
