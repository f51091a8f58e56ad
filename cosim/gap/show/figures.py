"""The figures of an answer: the gap rung by rung, the laws that were found, runs over time."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from cosim.gap.data import MeasuredRun
from cosim.gap.quantities import digits
from cosim.gap.result import NINETY, Gap, Law
from cosim.gap.windows import Fitted
from cosim.report.live import Live
from cosim.report.live_of_figure import live_of
from cosim.report.page import Picture
from cosim.report.palette import BLUE, GREY, INK, RED, readable
from cosim.report.style import logarithmic_x, panels, picture

from .tracks import channels, channels_of, modelled, residuals, shown_runs, starts, title, worst

#: Inches: two beside each other on a wide screen, and large enough type on a phone.
SIZE = {"height": 3.9, "width": 5.6}
#: Height of each of several laws, inches.
LOWER = 2.6
#: Rungs whose names stand upright.
UPRIGHT = 4
#: Letters of a name that needs no second line.
SHORT = 12
#: A law over so wide a range has a logarithmic axis.
WIDE = 30.0
SCALES = {"x": (1e3, "x [mm]"), "y": (1e3, "y [mm]"), "phi": (1e3, "φ [mrad]")}
WIDTH = 8.4
#: Noise units: linear up to here, logarithmic beyond.
LINEAR = 3.0
TICKS = (-1000, -100, -10, -2, 0, 2, 10, 100, 1000)


@picture("ladder", (
    "Gap after each step: root mean square of model minus data in units of the tracker's noise "
    "(thin line: 1, noise alone). Each step adds one finding to the one before."
))  # fmt: skip
def draw_ladder(gap: Gap) -> Figure:
    """Treads of fitted and of held-out runs."""
    figure, axes = panels(1, 1, **SIZE)
    axis, count = axes[0, 0], len(gap.ladder)
    fitted = [rung.gap.fit for rung in gap.ladder]
    series: list[tuple[str, str, Any, list[float]]] = [("fitted runs", BLUE, "-", fitted)]
    if gap.after.held_out is not None:
        held = [rung.gap.held_out or np.nan for rung in gap.ladder]
        series.append(("held-out runs", RED, (0, (4, 2)), held))
    highest = np.nanmax([values for *_, values in series], axis=0)
    axis.axhline(1.0, color=INK, linewidth=1.0, label="noise")
    for label, colour, dash, values in series:
        line: dict[str, Any] = {"color": colour, "linestyle": dash, "label": label}
        axis.stairs(values, np.arange(count + 1) - 0.5, baseline=None, linewidth=2.2, **line)
        for place, value in enumerate(values):
            up = 1.0 if value == highest[place] else -1.0
            axis.annotate(
                digits(value), (place, value), (0.0, 4.0 * up), textcoords="offset points",
                ha="center", va="bottom" if up > 0.0 else "top", fontsize=9.0, color=colour,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5},
            )  # fmt: skip
    lowest = min(1.0, *(float(np.nanmin(values)) for *_, values in series))
    _logarithmic_y(axis, lowest / 1.35, 1.5 * max(1.0, float(highest.max())))
    names = [rung.name.replace(" ", "\n").replace("measurement.", "measurement.\n")
             for rung in gap.ladder]  # fmt: skip
    names = [name if len(name) <= SHORT else name.replace("_", "_\n") for name in names]
    lean = {"rotation": 35, "ha": "right"} if count > UPRIGHT else {}
    axis.set_xticks(range(count), names, **lean)
    axis.set_xlim(-0.5, count - 0.5)
    axis.grid(visible=False, axis="x")
    axis.set_ylabel("gap [units of the noise]")
    figure.legend(loc="outside upper center", ncols=3)
    return figure


def _logarithmic_y(axis: Axes, low: float, high: float) -> None:
    axis.set_ylim(low, high)
    axis.set_yscale("log")
    subs = (1, 1.5, 2, 3, 5, 7, 8) if high < 5.0 * low else (1, 2, 5)
    axis.yaxis.set_major_locator(LogLocator(subs=subs))
    axis.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.yaxis.set_minor_formatter(NullFormatter())


@picture("curve", (
    "The effect without an assumed law: curve with its 90 % band, and each run by itself (points, "
    "± one standard deviation). Dashed, if any: the catalogue's law through the curve."
))  # fmt: skip
def draw_laws(gap: Gap) -> Figure:
    """A panel for each law."""
    height = SIZE["height"] if len(gap.laws) == 1 else LOWER
    figure, axes = panels(len(gap.laws), 1, height=height, width=SIZE["width"])
    for axis, law in zip(axes.flat, gap.laws, strict=True):
        _draw_law(axis, law)
    return figure


def _draw_law(axis: Axes, law: Law) -> None:
    scaled = readable(law.at, law.unit)
    symbol = {"mu_k": "$\\mu_k$", "mu_s": "$\\mu_s$"}.get(law.per, law.per)
    is_force = law.per == "N"
    factor = 1.0 if is_force else 100.0
    at, mean, band = scaled(law.at), factor * law.mean, NINETY * factor * law.sd
    axis.axhline(0.0, color=GREY, linewidth=0.6)
    axis.fill_between(at, mean - band, mean + band, color=RED, alpha=0.2, linewidth=0.0)
    axis.plot(at, mean, color=RED, label="free curve")
    if law.law is not None and not law.in_model:
        label = f"law: {law.form}" if law.form else "nearest law"
        axis.plot(at, factor * law.law, "--", color=INK, label=label)
    points = law.points.reshape(-1, 3)
    axis.errorbar(
        scaled(points[:, 0]), factor * points[:, 1], factor * points[:, 2], fmt="o", color=BLUE,
        markersize=4.0, linewidth=0.9, capsize=2.0, label="each run",
    )  # fmt: skip
    heights = np.concatenate([mean - band, mean + band, factor * points[:, 1]])
    low, high = np.nanmin(heights), np.nanmax(heights)
    room = 0.12 * (high - low) or 1.0
    axis.set_ylim(low - room, high + room)
    if at.min() > 0.0 and at.max() > WIDE * at.min():
        logarithmic_x(axis)
    axis.set_xlabel(law.quantity + (f" [{scaled.unit}]" if law.unit not in ("", "1") else ""))
    axis.set_ylabel("force along x [N]" if is_force else f"change of {symbol} [%]")
    axis.set_title(law.effect)
    axis.legend(loc="best", frameon=True, facecolor="white", edgecolor="none", framealpha=0.9)


def models(gap: Gap) -> list[tuple[str, Fitted, str]]:
    """Label, fit, colour; the user's model alone where nothing was added."""
    return [("before", gap.plain, BLUE), ("after", gap.extended, RED)][: len(gap.ladder)]


def _whole_run(figure: Figure) -> Live:
    """The figure of a few cycles for the page: they are seen first, and then the whole run."""
    (axis,) = figure.axes
    begin, end = axis.get_xlim()
    axis.autoscale(axis="x")
    live = live_of(figure)
    part = [begin, end, "where the user's model is worst"]
    shown = [{**one, "part": part, "opens_at_part": True} for one in live["figures"]]
    return {**live, "figures": shown}


@picture("run", (
    "The run with the largest gap, at its worst cycles: measured (points), the user's model "
    "(before), and the model with all findings (after). At dotted lines the models restart from "
    "the data; what comes before the first of a run is not compared."
), live=_whole_run)  # fmt: skip
def draw_run(gap: Gap) -> Figure:
    """Measured, before and after over time."""
    run, channel, begin, end = worst(gap)
    figure, axes = panels(1, 1, height=3.4, width=WIDTH)
    _motion(axes[0, 0], gap, run, channel, 4.0)
    axes[0, 0].set_xlim(begin, end)
    return _labelled(figure, axes)


@picture("overlay", (
    "Every run: measured (points), the user's model (before) and the model with all findings "
    "(after). At dotted lines the models restart from the data; "
    "what comes before the first is not compared."
), live=live_of)  # fmt: skip
def draw_overlay(gap: Gap, channel: str) -> Figure:
    """A row for each run."""
    return _rows(gap, channel, partial(_motion, size=1.5))


@picture("residuals", (
    "Model minus data of every run in units of the noise, before and after; dashed lines: two "
    "standard deviations of the noise."
), live=live_of)  # fmt: skip
def draw_residuals(gap: Gap, channel: str) -> Figure:
    """A row for each run."""
    return _rows(gap, channel, _residuals)


def _rows(gap: Gap, channel: str, draw: Callable[[Axes, Gap, MeasuredRun, str], None]) -> Figure:
    runs = [run for run in shown_runs(gap) if channel in channels_of(gap.plain.run(run.name))]
    figure, axes = panels(len(runs), 1, height=1.7, width=WIDTH)
    for axis, run in zip(axes[:, 0], runs, strict=True):
        draw(axis, gap, run, channel)
    return _labelled(figure, axes)


def _residuals(axis: Axes, gap: Gap, run: MeasuredRun, channel: str) -> None:
    """What both models leave of a run."""
    largest, gaps = LINEAR, []
    for label, model, colour in models(gap):
        fitted = model.run(run.name)
        left = residuals(run, fitted, channel)
        axis.plot(run.motion.time, left, ".", color=colour, markersize=1.5, label=label)
        largest = max(largest, float(np.nanmax(np.abs(left))))
        gaps.append(digits(fitted.gap))
    for level in (-2.0, 2.0):
        axis.axhline(level, color=GREY, linewidth=0.8, linestyle="--")
    axis.set_yscale("symlog", linthresh=LINEAR)
    ticks = [t for t in TICKS if abs(t) < 1.4 * largest and (abs(t) != 2 or largest < 100.0)]
    axis.set_yticks(ticks, [f"{tick:g}".replace("-", "−") for tick in ticks])
    axis.minorticks_off()
    axis.set_ylim(-1.4 * largest, 1.4 * largest)
    axis.set_title(f"{run.name}: gap {' → '.join(gaps)}")
    axis.set_ylabel(f"{channel.replace('phi', 'φ')} [noise]")


def _motion(axis: Axes, gap: Gap, run: MeasuredRun, channel: str, size: float) -> None:
    """Measured and modelled, all of a run."""
    (factor, label), time = SCALES[channel], run.motion.time
    measured: dict[str, Any] = {"color": INK, "markersize": size, "label": "measured"}
    axis.plot(time, factor * run.motion[channel], ".", zorder=3.0, **measured)
    for name, model, colour in models(gap):
        values = factor * modelled(run, model.run(run.name), channel)
        axis.plot(time, values, color=colour, label=name, linewidth=min(1.3, 0.5 * size))
    for start in time[starts(gap.plain.run(run.name))]:
        axis.axvline(start, color=GREY, linewidth=0.6, linestyle=":")
    axis.set_title(title(run))
    axis.set_ylabel(label)


def _labelled(figure: Figure, axes: Any) -> Figure:
    """With a time axis and a legend."""
    axes[-1, 0].set_xlabel("time in the run [s]")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=3)
    return figure


def figures_of(gap: Gap) -> dict[str, partial[Picture]]:
    """name -> what draws it, in the page's order."""
    first = {"ladder": draw_ladder, "curve": draw_laws, "run": draw_run}
    drawn = {
        name: partial(draw, gap) for name, draw in first.items() if name != "curve" or gap.laws
    }
    for kind, draw in (("residuals", draw_residuals), ("overlay", draw_overlay)):
        drawn |= {f"{kind}_{one}": partial(draw, gap, one) for one in channels(gap)}
    return drawn
