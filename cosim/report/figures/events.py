"""A run with its break-aways and re-sticks as rows: curves then reach their peaks.

Between two events everything is smooth, so each side of an event is the parabola through the
nearest three rows of that side, drawn out over less than one row. Without these rows a peak is cut
at the last row before it, each time by another part: beats that are none. Friction jumps at an
event; all else goes on, and is what it is on the side of stick, where nothing changes fast.

The last moments of a slip are computed anew, as they are faster than rows are recorded. Sliding and
spinning come to rest together, and their proportion, on which the share of moment and side force in
friction depends, changes most in the last milliseconds. No curve through rows 10 ms apart knows of
it: it cuts the peak, or overshoots, each time by another part. So the model itself goes from a
recorded row to the re-stick once more, and says what lies between; where it does not meet the rows
on its way, as it cannot know what the run remembered, nothing is added.
"""

from typing import NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray
from stickslip.kernel import layout
from stickslip.restarted import Restarts, simulate_restarted

from cosim.report.columns import Array

from ..columns import Column, Columns, Data
from ..contents import SLIP, has_events, mechanics_of, mode_changes

#: Outputs of the model that are put between the rows, and where they stand in its own.
COLUMNS = {
    name: getattr(layout, f"O_{name.upper()}") for name in ("x", "y", "phi", "vx", "vy", "omega")
} | {
    "friction_force_x": layout.O_FRICTION_X,
    "friction_force_y": layout.O_FRICTION_X + 1,
    "friction_moment": layout.O_FRICTION_X + 2,
}
STATE = ("x", "y", "phi", "vx", "vy", "omega")
FRICTION = ("friction_force_x", "friction_force_y", "friction_moment")
#: Means over the interval that ends at a row: of that interval on both sides of an event in it.
MEANS = ("heat_flow", "melt_rate")
#: Rows before the re-stick from which the model sets out, and moments that it adds.
ROWS, MOMENTS = 3, 24
#: Moments lie the closer the nearer to the end: at these powers of equal steps.
CLOSER = 1.7
#: Of the largest friction in a slip: what the model may be off at a recorded row on its way. A
#: curve's width on a page is about a hundredth of its height.
OFF = 0.01
#: Of the way: how much sooner than the run the model may come to rest.
SOONER = 0.02


class Way(NamedTuple):
    """From a recorded row to a re-stick: the row, those behind it, all moments (k,), s."""

    row: int
    checks: NDArray[np.int64]
    times: Array


def with_moments(
    dataset: Columns, over_time: Columns, times: Array, slips: NDArray[np.bool_]
) -> Columns:
    """The rows and, where the model can say them, the last moments of every slip.

    times (k,), s, and slips (k,): the events, and whether a slip begins there.
    """
    if not {*COLUMNS, "mode"} <= {*over_time}:
        return over_time
    ways = _ways(over_time, times, slips)
    outputs = _gone_again(dataset, over_time, ways) if ways else []
    found = [
        _between(over_time, way, rows)
        for way, rows in zip(ways, outputs, strict=True)
        if _meets(over_time, way, rows)
    ]
    return over_time.with_rows(*found) if found else over_time


def _ways(over_time: Columns, times: Array, slips: NDArray[np.bool_]) -> list[Way]:
    """Of every slip that has at least two rows with all numbers."""
    time, mode = over_time["time"].values, over_time["mode"].values
    known = np.all([np.isfinite(over_time[name].values) for name in COLUMNS], axis=0)
    found: list[Way] = []
    for number in np.flatnonzero(~slips):
        begin = times[number - 1] if number else time[0]
        inside = np.flatnonzero((time > begin) & (time < times[number]) & known & (mode == SLIP))
        rows = inside[-ROWS:]
        if rows.size < 2 or (found and time[rows[0]] <= found[-1].times[-1]):
            continue
        span = times[number] - time[rows[0]]
        moments = times[number] - span * np.linspace(1.0, 0.0, MOMENTS + 1)[1:-1] ** CLOSER
        found.append(Way(rows[0], rows[1:], np.union1d(time[rows], moments)))
    return found


def _gone_again(dataset: Columns, over_time: Columns, ways: list[Way]) -> list[Array]:
    """The model's outputs (k, O_SIZE) on each way, with friction as strong as in the first row."""
    states = [np.array([over_time[name].values[way.row] for name in STATE]) for way in ways]
    strength = np.ones((len(ways), 2))
    outputs = _outputs(dataset, over_time, ways, states, strength)
    for number, (way, rows) in enumerate(zip(ways, outputs, strict=True)):
        was = np.hypot(*(over_time[name].values[way.row] for name in FRICTION[:2]))
        is_now = np.hypot(*(rows[0, COLUMNS[name]] for name in FRICTION[:2]))
        if is_now > 0.0 and np.isfinite(was):
            strength[number, 1] = was / is_now
    if np.all(np.abs(strength - 1.0) < 0.1 * OFF):
        return outputs
    return _outputs(dataset, over_time, ways, states, strength)


def _outputs(
    dataset: Columns, over_time: Columns, ways: list[Way], states: list[Array], strength: Array
) -> list[Array]:
    parameters = mechanics_of(dataset)
    temperature = parameters.temperature_dependence.reference_degC
    if "interface_temperature" in over_time:
        temperature = float(np.nanmean(over_time["interface_temperature"].values))
    ends = np.cumsum([way.times.size for way in ways])
    restarts = Restarts.at([0, *ends[:-1].tolist()], states, friction=strength.tolist())
    times, speed = np.concatenate([way.times for way in ways]), parameters.surface.speed
    rows = simulate_restarted(parameters.pack(), speed, temperature, times, restarts)
    return np.split(rows, ends[:-1])


def _meets(over_time: Columns, way: Way, rows: Array) -> bool:
    """Whether the model slips to the end and has the friction of every recorded row on its way."""
    if not np.isfinite(rows[:, list(COLUMNS.values())]).all():
        return False
    slips = rows[:, layout.O_MODE] == SLIP
    late = way.times > way.times[-1] - SOONER * (way.times[-1] - way.times[0])
    if not slips[~late].all():
        return False
    at = np.searchsorted(way.times, over_time["time"].values[way.checks])
    return all(
        np.max(np.abs(rows[at, COLUMNS[name]] - over_time[name].values[way.checks]))
        <= OFF * np.max(np.abs(rows[slips, COLUMNS[name]]), initial=0.0)
        for name in FRICTION
    )


def _between(over_time: Columns, way: Way, rows: Array) -> Columns:
    """The moments alone; what the model does not say of them lies between the rows beside them,
    or is a mean that the next row has of them."""
    time = over_time["time"].values
    new = ~np.isin(way.times, time) & (rows[:, layout.O_MODE] == SLIP)
    at = way.times[new]
    filled = {
        name: np.interp(at, time, variable.values.astype(float))
        for name, variable in over_time.data_vars.items()
    }
    filled |= {name: rows[new, place] for name, place in COLUMNS.items()}
    means = [name for name in MEANS if name in over_time]
    filled |= {name: over_time[name].values[np.searchsorted(time, at)] for name in means}
    filled["mode"] = np.full(at.size, SLIP)
    columns = {name: Column(("time",), values) for name, values in filled.items()}
    return Columns(columns, {"time": Column(("time",), at)})


#: What jumps at an event.
FORCES = ("friction_force_x", "friction_force_y", "friction_moment")
#: A side is drawn out by no more than this many times what its curve changed between rows.
FARTHEST = 2.0


#: Of columns that are still there: made once.
_KEPT: WeakKeyDictionary[Columns, tuple[Columns, NDArray[np.bool_]]] = WeakKeyDictionary()


def through_events(data: Data) -> tuple[Columns, NDArray[np.bool_]]:
    """What there is over time, with two rows at each event: before and after; and which those are.

    The row after comes the smallest number later, so that time rises. Sides without rows (of phases
    shorter than the interval) have none.
    """
    columns = Columns.of(data)
    if columns not in _KEPT:
        _KEPT[columns] = _rows_through_events(columns)
    return _KEPT[columns]


def _rows_through_events(dataset: Columns) -> tuple[Columns, NDArray[np.bool_]]:
    columns = [n for n, v in dataset.data_vars.items() if v.dims == ("time",)]
    over_time = dataset[columns]
    time = dataset["time"].values.astype(float)
    times, slips = _events(dataset)
    if times.size == 0:
        return over_time, np.zeros(time.size, bool)
    over_time = with_moments(dataset, over_time, times, slips)
    time = over_time["time"].values.astype(float)
    edges = np.searchsorted(time, times, side="left")
    begins, ends = np.append(0, edges[:-1]), np.append(edges[1:], time.size)
    last, following = np.maximum(edges - 1, 0), np.minimum(edges, time.size - 1)
    # a row at the event itself is what comes after
    before, after = edges > begins, (ends > edges) & (time[following] != times)
    from_left = np.where(slips, before | ~after, before & ~after)
    added = np.concatenate([times[before], np.nextafter(times, np.inf)[after]])
    rows = np.concatenate([time, added])
    order = np.argsort(rows, kind="stable")
    fixed = _positions(dataset, times)

    def sides(name: str, values: Array) -> tuple[Array, Array]:
        """At the events, what is before them and after."""
        if name in fixed:
            return fixed[name], fixed[name]
        if name in MEANS:
            return values[following], values[following]
        if over_time[name].dtype.kind != "f" or name == "mode":
            return values[last], values[following]
        left = _drawn_out(time, values, times, edges - 1, -1, edges - begins)
        right = _drawn_out(time, values, times, edges, 1, ends - edges)
        if name in FORCES:  # see `with_moments`: what no row knows is not made up
            return np.where(slips, left, values[last]), right
        both = np.where(from_left, left, right)
        return both, both

    filled = {}
    for name in columns:
        values = over_time[name].values.astype(float)
        left, right = sides(name, values)
        there = np.concatenate([values, left[before], right[after]])[order]
        filled[name] = Column(("time",), there, dataset[name].attrs)
    new = Columns(filled, {"time": Column(("time",), rows[order])}, dataset.attrs)
    return new, order >= time.size


def _events(dataset: Columns) -> tuple[Array, NDArray[np.bool_]]:
    """Times (k,), s, within the rows, and whether a slip begins there."""
    time = dataset["time"].values
    times, modes = (known[1:] for known in mode_changes(dataset))
    times, first = np.unique(times, return_index=True)
    inside = (times > time[0]) & (times < time[-1]) if time.size else np.zeros(0, bool)
    return times[inside], modes[first][inside] == SLIP


def _positions(dataset: Columns, times: Array) -> dict[str, Array]:
    """What is known at the events themselves."""
    if not has_events(dataset):
        return {}
    place = np.searchsorted(dataset["event_time"].values, times)
    return {"x": dataset["event_x"].values[np.minimum(place, dataset.sizes["event_time"] - 1)]}


def _drawn_out(
    time: Array, values: Array, at: Array, nearest: NDArray[np.int64], step: int, count: Array
) -> Array:
    """The curve at times (k,), from the rows on one side; count: of rows on that side."""
    last = time.size - 1
    rows = [np.clip(nearest + step * n, 0, last) for n in range(3)]
    t, v = [time[row] for row in rows], [values[row] for row in rows]
    with np.errstate(divide="ignore", invalid="ignore"):
        first = (v[0] - v[1]) / (t[0] - t[1])
        second = ((v[0] - v[2]) / (t[0] - t[2]) - first) / (t[2] - t[1])
        linear = (at - t[0]) * first
        bent = linear + (at - t[0]) * (at - t[1]) * second
    reach = FARTHEST * np.maximum(np.abs(v[0] - v[1]), np.abs(v[1] - v[2]))
    bent = np.clip(bent, -reach, reach)
    out = np.select([count >= 3, count == 2], [bent, linear], 0.0)
    return v[0] + np.where(np.isfinite(out), out, 0.0)
