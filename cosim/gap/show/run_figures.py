"""Runs over time: one where the user's model is worst, every one, and what the models leave."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cosim.gap.data import MeasuredRun
from cosim.gap.result import Gap
from cosim.gap.windows import Fitted
from cosim.report.live import Live, live_of
from cosim.report.style import BLUE, GREY, INK, RED, panels, picture

from .quantities import digits
from .tracks import channels_of, modelled, residuals, shown_runs, starts, title, worst

SCALES = {"x": (1e3, "x (mm)"), "y": (1e3, "y (mm)"), "phi": (1e3, "φ (mrad)")}
WIDTH = 8.4
#: Noise units: linear up to here, logarithmic beyond.
LINEAR = 3.0
TICKS = (-1000, -100, -10, -2, 0, 2, 10, 100, 1000)


def models(gap: Gap) -> list[tuple[str, Fitted, str]]:
    """Label, fit, colour; the user's model alone where nothing was added."""
    return [("before", gap.plain, BLUE), ("after", gap.extended, RED)][: len(gap.ladder)]


def _whole_run(figure: Figure) -> Live:
    """The figure of a few cycles for the page: they are seen first, and then the whole run."""
    (axis,) = figure.axes
    begin, end = axis.get_xlim()
    axis.autoscale(axis="x")
    live = live_of(figure)
    part = [begin, end, "where the user's model is farthest off"]
    shown = [{**one, "part": part, "opens_at_part": True} for one in live["figures"]]
    return {**live, "figures": shown}


@picture("run", (
    "Where the user's model is farthest off, a few cycles: measured (dots), the user's model "
    "(before), and the model with everything that was found (after). At broken lines the models "
    "set out anew from the data."
), live=_whole_run)  # fmt: skip
def draw_run(gap: Gap) -> Figure:
    """Measured, before and after over time."""
    run, channel, begin, end = worst(gap)
    figure, axes = panels(1, 1, height=3.4, width=WIDTH)
    _motion(axes[0, 0], gap, run, channel, 4.0)
    axes[0, 0].set_xlim(begin, end)
    return _labelled(figure, axes)


@picture("overlay", (
    "Every run: measured (dots), the user's model (before) and the model with everything that was "
    "found (after). At broken lines the models set out anew from the data."
), live=live_of)  # fmt: skip
def draw_overlay(gap: Gap, channel: str) -> Figure:
    """A row for each run."""
    runs = _runs(gap, channel)
    figure, axes = panels(len(runs), 1, height=1.7, width=WIDTH)
    for axis, run in zip(axes[:, 0], runs, strict=True):
        _motion(axis, gap, run, channel, 1.5)
    return _labelled(figure, axes)


@picture("residuals", (
    "Model less data of every run in units of the noise, before and after; broken lines: two "
    "standard deviations of the noise."
), live=live_of)  # fmt: skip
def draw_residuals(gap: Gap, channel: str) -> Figure:
    """A row for each run."""
    runs = _runs(gap, channel)
    figure, axes = panels(len(runs), 1, height=1.7, width=WIDTH)
    for axis, run in zip(axes[:, 0], runs, strict=True):
        largest = LINEAR
        for label, model, colour in models(gap):
            left = residuals(run, model.run(run.name), channel)
            axis.plot(run.motion.time, left, ".", color=colour, markersize=1.5, label=label)
            largest = max(largest, float(np.nanmax(np.abs(left))))
        for level in (-2.0, 2.0):
            axis.axhline(level, color=GREY, linewidth=0.8, linestyle="--")
        axis.set_yscale("symlog", linthresh=LINEAR)
        ticks = [t for t in TICKS if abs(t) < 1.4 * largest and (abs(t) != 2 or largest < 100.0)]
        axis.set_yticks(ticks, [f"{tick:g}".replace("-", "−") for tick in ticks])
        axis.minorticks_off()
        axis.set_ylim(-1.4 * largest, 1.4 * largest)
        gaps = " → ".join(digits(model.run(run.name).gap) for _, model, _ in models(gap))
        axis.set_title(f"{run.name}: gap {gaps}")
        axis.set_ylabel(f"{channel.replace('phi', 'φ')} (noise)")
    return _labelled(figure, axes)


def _runs(gap: Gap, channel: str) -> list[MeasuredRun]:
    return [run for run in shown_runs(gap) if channel in channels_of(run, gap.plain.run(run.name))]


def _motion(axis: Axes, gap: Gap, run: MeasuredRun, channel: str, size: float) -> None:
    """Measured and modelled, all of a run."""
    (factor, label), time = SCALES[channel], run.motion.time
    measured: dict[str, Any] = {"color": INK, "markersize": size, "label": "measured"}
    axis.plot(time, factor * run.motion[channel], ".", zorder=3.0, **measured)
    for name, model, colour in models(gap):
        values = factor * modelled(run, model.run(run.name), channel)
        axis.plot(time, values, color=colour, label=name, linewidth=min(1.3, 0.5 * size))
    for start in time[starts(run, gap.plain.run(run.name))]:
        axis.axvline(start, color=GREY, linewidth=0.6, linestyle=":")
    axis.set_title(title(run))
    axis.set_ylabel(label)


def _labelled(figure: Figure, axes: Any) -> Figure:
    """With a time axis and a legend."""
    axes[-1, 0].set_xlabel("time in the run (s)")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=3)
    return figure
