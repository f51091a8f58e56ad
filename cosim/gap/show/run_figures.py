"""Every run: measured beside modelled, and what the models leave, over time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from cosim.gap.result import Gap
from cosim.report.live import Curve, Panel, over_time, several
from cosim.report.page import Picture
from cosim.report.style import BLUE, GREEN, PALE_GREY, PURPLE, panels, picture

from .answer_figures import SCALES, models, run_curves
from .quantities import digits
from .tracks import channels, excerpt, measured_run, residuals, run_names, seen, title

COLOURS = {"x": BLUE, "y": GREEN, "phi": PURPLE}
#: Noise units: linear up to here, logarithmic beyond.
LINEAR = 3.0
TICKS = (-1000, -100, -10, -2, 0, 2, 10, 100, 1000)


def overlay(gap: Gap, channel: str) -> Picture:
    """A channel of every run; on the page a button shows where the user's model is worst."""
    factor, label = SCALES[channel]
    panels_of_runs = {}
    for name in _runs_with(gap, channel):
        run = measured_run(gap, name)
        (_, _, begin, end), _ = excerpt(run, gap.plain.run(name))
        panel = Panel(_bracketed(label), run_curves(gap, name, channel, factor))
        part = (begin, end, "where the user's model is farthest off")
        panels_of_runs[title(run)] = over_time(run.motion.time, [panel], part=part)
    return replace(
        draw_overlay(gap, channel), name=f"overlay_{channel}",
        alt=f"{label} of every run over time: measured, and the models.",
        live=several(panels_of_runs),
    )  # fmt: skip


def _runs_with(gap: Gap, channel: str) -> list[str]:
    return [
        name for name in run_names(gap)
        if channel in seen(measured_run(gap, name), gap.plain.run(name))
    ]  # fmt: skip


def _bracketed(label: str) -> str:
    return label.replace("(", "[").replace(")", "]")


@picture("overlay", (
    "Every run: measured (dots), the user's model (before) and the model with everything that was "
    "found (after). The models set out anew from the data every few cycles, where their lines are "
    "cut."
))  # fmt: skip
def draw_overlay(gap: Gap, channel: str) -> Figure:
    """A row for each run."""
    names, (factor, label) = _runs_with(gap, channel), SCALES[channel]
    figure, axes = panels(len(names), 1, height=1.7, width=8.4)
    for axis, name in zip(axes[:, 0], names, strict=True):
        run = measured_run(gap, name)
        for curve in run_curves(gap, name, channel, factor):
            style = {"marker": ".", "linestyle": "", "markersize": 1.5} if curve.dots else {}
            style |= {"linewidth": 0.8}
            axis.plot(run.motion.time, curve.values, color=curve.colour, label=curve.label, **style)
        axis.set_title(title(run))
        axis.set_ylabel(label)
    axes[-1, 0].set_xlabel("time in the run (s)")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=3, markerscale=4.0)
    return figure


def residual_picture(gap: Gap) -> Picture:
    """What is left of every run."""
    found = {}
    for name in run_names(gap):
        run = measured_run(gap, name)
        shown = [
            _panel(f"{label}, gap {digits(model.run(name).gap)}", residuals(run, model.run(name)))
            for label, model, _ in models(gap)
        ]
        found[f"{title(run)}: model less data"] = over_time(run.motion.time, shown)
    return replace(
        draw_residuals(gap), alt="Model less data of every run over time, before and after.",
        live=several(found),
    )  # fmt: skip


def _panel(label: str, left: dict[str, np.ndarray]) -> Panel:
    """Dots, and two standard deviations of the noise as levels."""
    dots = [
        Curve(f"{channel.replace('phi', 'φ')} {label}", values, COLOURS[channel], dots=True)
        for channel, values in left.items()
    ]
    largest = max(float(np.nanmax(np.abs(values), initial=0.0)) for values in left.values())
    levels = [(2.0, "2 σ"), (-2.0, "−2 σ")]
    far = LINEAR if largest > 10.0 * LINEAR else 0.0
    return Panel("model less data [noise]", dots, levels=levels, linear_to=far)


@picture("residuals", (
    "Model less data of every run in units of the noise, before and after; grey: two standard "
    "deviations of the noise. Linear up to 3, logarithmic beyond."
))  # fmt: skip
def draw_residuals(gap: Gap) -> Figure:
    """A row for each run, a column for each model, a colour for each channel."""
    names, columns = run_names(gap), models(gap)
    figure, axes = panels(len(names), len(columns), height=1.7, width=8.4, sharey="row")
    for row, name in zip(axes, names, strict=True):
        run, limit = measured_run(gap, name), LINEAR
        for axis, (label, model, _) in zip(row, columns, strict=True):
            axis.axhspan(-2.0, 2.0, color=PALE_GREY, zorder=0)
            for channel, left in residuals(run, model.run(name)).items():
                axis.plot(
                    run.motion.time, left, ".", markersize=1.5, color=COLOURS[channel],
                    label=channel.replace("phi", "φ"),
                )  # fmt: skip
                limit = max(limit, float(np.nanmax(np.abs(left))))
            axis.set_title(f"{name}, {label}: gap {digits(model.run(name).gap)}")
        for axis in row:
            axis.set_yscale("symlog", linthresh=LINEAR)
            ticks = [t for t in TICKS if abs(t) < 1.4 * limit and (abs(t) != 2 or limit < 100.0)]
            axis.set_yticks(ticks, [f"{tick:g}".replace("-", "−") for tick in ticks])
            axis.minorticks_off()
            axis.set_ylim(-1.4 * limit, 1.4 * limit)
        row[0].set_ylabel("noise units")
    for axis in axes[-1]:
        axis.set_xlabel("time in the run (s)")
    if len(channels(gap)) > 1:
        handles, labels = axes[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper right", ncols=3, markerscale=5.0)
    return figure
