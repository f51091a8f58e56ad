"""Curves of two runs, one over the other: the wider, paler one is A, the thinner, darker one B."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cosim.report.contents import break_aways
from cosim.report.style import BLUE, ORANGE, panels, picture, readable

from .compare import Comparison

Array = NDArray[np.float64]


class Channel(NamedTuple):
    """A time series: variable, what it is, its unit, and the size below which it is nothing."""

    name: str
    says: str
    unit: str
    nothing: float


CHANNELS = (
    Channel("x", "x", "m", 1e-7),
    Channel("y", "y", "m", 1e-7),
    Channel("phi", "rotation", "rad", 1e-6),
    Channel("friction_force_x", "friction along x", "N", 1e-6),
    Channel("heat", "friction heat", "J", 1e-9),
    Channel("interface_temperature", "interface", "degC", 1e-6),
    Channel("belt_entry_temperature", "belt at entry", "degC", 1e-6),
    Channel("ice_face_temperature", "ice face", "degC", 1e-6),
)
#: Colour and width of A and of B.
STROKES = ((ORANGE, 3.0), (BLUE, 1.1))
#: Periods at the end that are drawn enlarged, and the part of the run where there are none.
CYCLES, PART = 4.0, 0.1


def moving(both: Comparison) -> list[Channel]:
    """Channels in which one of the runs moves at all; of any other system, what both have."""
    known = [one for one in CHANNELS if _there(both, one.name)]
    if not known:
        known = [
            Channel(str(name), str(name), str(series.attrs.get("units", "1")), 0.0)
            for name, series in both.a.dataset.data_vars.items()
            if series.dims == ("time",) and _there(both, str(name))
        ][:8]
    return [
        one for one in known if max(_range(each, one.name) for each in _sets(both)) > one.nothing
    ]


def _sets(both: Comparison) -> tuple[xr.Dataset, xr.Dataset]:
    return both.a.dataset, both.b.dataset


def _there(both: Comparison, name: str) -> bool:
    return any(name in one and one[name].dims == ("time",) for one in _sets(both))


def _range(dataset: xr.Dataset, name: str) -> float:
    if name not in dataset:
        return 0.0
    values = np.asarray(dataset[name].values, float)
    values = values[np.isfinite(values)]
    return float(np.ptp(values)) if values.size else 0.0


def _window(both: Comparison) -> tuple[float, float]:
    """The last cycles that both runs have, s."""
    end = min(float(one["time"][-1]) for one in _sets(both))
    lengths = []
    for one in _sets(both):
        starts = break_aways(one) if "mode" in one else np.zeros(0)
        starts = starts[starts <= end]
        if starts.size > 2:
            lengths.append(CYCLES * float(np.mean(np.diff(starts[-6:]))))
    begin = min(float(one["time"][0]) for one in _sets(both))
    return end - min(max(lengths, default=PART * (end - begin)), end - begin), end


@picture(
    "overlay",
    "Both runs over time, the whole of them and the last cycles that both have. The wide, orange"
    " line is A, the thin, blue one B: where only blue is seen on orange they are the same. What is"
    " flat in both is left out.",
)
def draw_overlay(both: Comparison) -> Figure:
    """A row for each channel that moves, over all time and enlarged."""
    channels = moving(both)
    begin, end = _window(both)
    figure, axes = panels(
        max(len(channels), 1), 2, height=1.9, width=11.0, width_ratios=[1.6, 1.0], sharex="col"
    )
    for row, channel in zip(axes, channels, strict=False):
        _draw(row, both, channel, begin, end)
    axes[0, 1].set_xlim(begin, end)
    for ax in axes[-1]:
        ax.set_xlabel("time [s]")
    handles = axes[0, 0].lines[:2]
    figure.legend(
        handles, [f"A: {both.a.label}", f"B: {both.b.label}"], ncols=2, loc="outside upper center"
    )
    return figure


def _draw(row: NDArray, both: Comparison, channel: Channel, begin: float, end: float) -> None:
    series = [
        np.asarray(one[channel.name].values, float) if channel.name in one else None
        for one in _sets(both)
    ]
    there = np.concatenate([one for one in series if one is not None])
    scale = readable(there, channel.unit)
    seen = []
    for one, values, (colour, width) in zip(_sets(both), series, STROKES, strict=True):
        time = one["time"].values
        shown = np.full(time.shape, np.nan) if values is None else scale(values)
        for ax in row:
            ax.plot(time, shown, color=colour, linewidth=width)
        seen.append(shown[(time >= begin) & (time <= end)])
    row[0].set_ylabel(f"{channel.says} [{scale.unit}]")
    inside = np.concatenate(seen)
    inside = inside[np.isfinite(inside)]
    if inside.size and np.ptp(inside) > 0.0:
        margin = 0.05 * float(np.ptp(inside))
        row[1].set_ylim(inside.min() - margin, inside.max() + margin)


@picture(
    "phases",
    "Velocity over position in the last cycles: a closed loop is a stick-slip cycle. A wide and"
    " orange, B thin and blue.",
)
def draw_phases(both: Comparison) -> Figure:
    """The phase portraits in one panel; both must have x and vx."""
    begin, end = _window(both)
    figure, axes = panels(1, 1, height=3.6, width=5.4)
    ax = axes[0, 0]
    labels = (both.a.label, both.b.label)
    late = [one.sel(time=slice(begin, end)) for one in _sets(both)]
    x = readable(np.concatenate([one["x"].values for one in late]), "m")
    v = readable(np.concatenate([one["vx"].values for one in late]), "m/s")
    for one, (colour, width), label in zip(late, STROKES, labels, strict=True):
        ax.plot(x(one["x"].values), v(one["vx"].values), color=colour, lw=width, label=label)
    ax.set(xlabel=f"x [{x.unit}]", ylabel=f"velocity along x [{v.unit}]")
    figure.legend(ncols=2, loc="outside upper center")
    return figure


def has_phases(both: Comparison) -> bool:
    """Whether both have what a phase portrait is drawn of."""
    return all({"x", "vx"} <= set(one.data_vars) for one in _sets(both))
