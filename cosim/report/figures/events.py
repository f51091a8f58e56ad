"""A run with its break-aways and re-sticks as rows: curves then reach their peaks.

Between two events everything is smooth, so each side of an event is the parabola through the
nearest three rows of that side, drawn out over less than one row. Without these rows a peak is cut
at the last row before it, each time by another part: beats that are none. Friction jumps at an
event; all else goes on, and is what it is on the side of stick, where nothing changes fast.
"""

from __future__ import annotations

from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from cosim.report.columns import Column, Columns, Data
from cosim.report.contents import SLIP, has_events, mode_changes

from .end_of_slip import moments

Array = NDArray[np.float64]

#: Means over the interval that ends at a row: of that interval on both sides of an event in it.
MEANS = ("heat_flow", "melt_rate")
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
    over_time = _with_moments(dataset, over_time, times, slips)
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
        if name in FORCES:  # see `end_of_slip`: what no row knows is not made up
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


def _with_moments(
    dataset: Columns, over_time: Columns, times: Array, slips: NDArray[np.bool_]
) -> Columns:
    """The rows and, where the model can say them, the last moments of every slip."""
    found = moments(dataset, over_time, times, slips)
    if found.sizes["time"] == 0:
        return over_time
    time = over_time["time"].values
    row = np.searchsorted(time, found["time"].values)
    for name in MEANS:
        if name in over_time:
            found.data_vars[name] = Column(("time",), over_time[name].values[row])
    return over_time.with_rows(found)


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
