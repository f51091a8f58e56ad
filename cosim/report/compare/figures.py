"""Curves of two runs, one over the other: the wider, paler one is A, the thinner, darker one B."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from cosim.report.columns import Array
from cosim.report.contents import break_aways
from cosim.report.figures.events import through_events
from cosim.report.live import Curve, Panel, TimeFigure, panels_on_one_axis
from cosim.report.live import Series as CurveInTime
from cosim.report.page import Picture
from cosim.report.palette import BLUE, ORANGE, readable
from cosim.report.quantities import ROUNDING, TABLES
from cosim.report.style import panels, picture, picture_over_time

from .compare import Comparison, Series


class Channel(NamedTuple):
    """A time series: variable, what it is, its unit, and the size below which it is nothing."""

    name: str
    says: str
    unit: str
    nothing: float


CHANNELS = [Channel(name, *told) for name, told in TABLES["channels"].items()]
#: Colour and width of A and of B.
STROKES = ((ORANGE, 3.0), (BLUE, 1.1))
#: Ports by which break-aways are found.
COUNTED = ("mode", "slip_count")
#: Periods at the end that are drawn enlarged, and the part of the run where there are none.
CYCLES, PART = 4.0, 0.1
#: Panels that are below each other on a page.
MOST_BELOW = 3


class Drawn(NamedTuple):
    """A channel with the values of A and of B, in its unit; None where a run has none of it."""

    channel: Channel
    values: tuple[Array | None, Array | None]


def moving(both: Comparison) -> list[Drawn]:
    """Channels in which one of the runs moves at all; of any other system, what both have."""
    found = [_of_channel(both, one) for one in CHANNELS]
    there = [one for one in found if any(each is not None for each in one.values)]
    if not there:
        there = [
            _of_series(both, one, Channel(one.name, one.name, one.unit, ROUNDING.get(one.unit, 0)))
            for one in both.series
        ]
    return [one for one in there if _range(one.values) > one.channel.nothing][: len(CHANNELS)]


def _sets(both: Comparison) -> tuple[xr.Dataset, xr.Dataset]:
    return both.a.dataset, both.b.dataset


def _of_channel(both: Comparison, channel: Channel) -> Drawn:
    """A known channel: of a run by its name, of a system by the name of its port."""
    for one in both.series:
        if one.name.rpartition(".")[2] == channel.name:
            return _of_series(both, one, channel._replace(unit=one.unit))
    a, b = (
        np.asarray(one[channel.name].values, float)
        if channel.name in one and one[channel.name].dims == ("time",)
        else None
        for one in _sets(both)
    )
    return Drawn(channel, (a, b))


def _of_series(both: Comparison, series: Series, channel: Channel) -> Drawn:
    return Drawn(channel, (series.of_a(both.a.dataset), series.of_b(both.b.dataset)))


def _range(values: tuple[Array | None, ...]) -> float:
    """The larger span of the two."""
    finite = [one[np.isfinite(one)] for one in values if one is not None]
    return max((float(np.ptp(one)) for one in finite if one.size), default=0.0)


def _starts(dataset: xr.Dataset) -> Array:
    """Break-aways of a run, or of the one unit of a system that has any, s."""
    modes = [str(name) for name in dataset.data_vars if str(name).rpartition(".")[2] == "mode"]
    if not modes:
        return np.zeros(0)
    of = modes[0].rpartition("mode")[0]
    if f"{of}slip_count" not in dataset:
        return np.zeros(0)
    return break_aways(dataset.rename({f"{of}{port}": port for port in COUNTED} if of else {}))


def _window(both: Comparison) -> tuple[float, float]:
    """The last cycles that both runs have, s."""
    begin, end = (min(float(one["time"][row]) for one in _sets(both)) for row in (0, -1))
    starts = [each[each <= end] for each in map(_starts, _sets(both))]
    periods = [float(np.mean(np.diff(each[-6:]))) for each in starts if each.size > 2]
    length = CYCLES * max(periods) if periods else PART * (end - begin)
    return end - min(length, end - begin), end


def overlay(both: Comparison) -> Picture:
    """Where both have other times, each on the straight lines of its rows."""
    times, shown = _described(_with_events(both))
    part = (*_window(both), "the last cycles that both have")
    # of many, two beside each other: the figures below them stay on the first screen
    columns = 1 + (len(shown) > MOST_BELOW)
    figure = TimeFigure(times, shown, part=part, own_scale=True, columns=columns)
    return picture_over_time("overlay", **TABLES["compare"]["overlay"], shown=figure)


def _described(both: Comparison) -> tuple[Array, list[Panel]]:
    """All times of both, and a panel for each channel that moves."""
    labels = [
        one.label if one.label.endswith(f"({side})") else f"{side}: {one.label}"
        for side, one in (("A", both.a), ("B", both.b))
    ]
    shown = []
    for channel, both_values in moving(both):
        there = [one for one in both_values if one is not None]
        scale = readable(np.concatenate(there), channel.unit)
        own = [
            CurveInTime(one["time"].values, Curve(label, scale(values), colour, width=width))
            for one, values, label, (colour, width) in zip(
                _sets(both), both_values, labels, STROKES, strict=True
            )
            if values is not None
        ]
        label, span = f"{channel.says} [{scale.unit}]", scale.factor * channel.nothing
        shown.append((Panel(label, [], span=span), own))
    return panels_on_one_axis(shown)


def _with_events(both: Comparison) -> Comparison:
    """With the events as rows, where it is a run of the block."""
    a, b = (
        replace(one, dataset=through_events(one.dataset)[0].to_xarray())
        if "parameters" in one.dataset.attrs and "mode" in one.dataset and one.dataset.sizes["time"]
        else one
        for one in (both.a, both.b)
    )
    return replace(both, a=a, b=b)


@picture("phases", **TABLES["compare"]["phases"])
def draw_phases(both: Comparison) -> Figure:
    """The phase portraits in one panel; both must have x and vx."""
    begin, end = _window(both)
    figure, ((ax,),) = panels(1, 1, height=3.6, width=5.4)
    labels = (both.a.label, both.b.label)
    place, speed = _phase_series(both)
    late = [(one["time"].values >= begin) & (one["time"].values <= end) for one in _sets(both)]
    xs, vs = (
        [values[when] for values, when in zip(each.values, late, strict=True) if values is not None]
        for each in (place, speed)
    )
    x = readable(np.concatenate(xs), place.channel.unit)
    v = readable(np.concatenate(vs), speed.channel.unit)
    for x_one, v_one, (colour, width), label in zip(xs, vs, STROKES, labels, strict=True):
        ax.plot(x(x_one), v(v_one), color=colour, lw=width, label=label)
    ax.set(xlabel=f"x [{x.unit}]", ylabel=f"velocity along x [{v.unit}]")
    figure.legend(ncols=2, loc="outside upper center")
    return figure


def has_phases(both: Comparison) -> bool:
    """Whether both have what a phase portrait is drawn of."""
    return all(one is not None for each in _phase_series(both) for one in each.values)


def _phase_series(both: Comparison) -> tuple[Drawn, Drawn]:
    place, speed = Channel("x", "x", "m", 0.0), Channel("vx", "velocity", "m/s", 0.0)
    return _of_channel(both, place), _of_channel(both, speed)
