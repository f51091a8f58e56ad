"""The three pictures of an answer: the gap rung by rung, the law, one run before and after."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from cosim.gap.result import Gap, Law
from cosim.report.live import Curve, Panel, over_time, several
from cosim.report.page import Picture
from cosim.report.style import BLUE, GREY, INK, RED, logarithmic_x, panels, picture, readable

from .quantities import NINETY, digits
from .tracks import measured_run, modelled, starts, title, worst

#: inches: two beside each other on a wide screen, and large enough type on a phone.
WIDTH = 5.6
SCALES = {"x": (1e3, "x (mm)"), "y": (1e3, "y (mm)"), "phi": (1e3, "φ (mrad)")}
#: Rungs whose names stand upright.
UPRIGHT = 4
#: A law over so wide a range has a logarithmic axis.
WIDE = 30.0


@picture("ladder", (
    "The gap, rung by rung: root mean square of model less data in units of the tracker's noise, "
    "so that 1 (black line) is noise. Each rung adds one finding to the one before."
))  # fmt: skip
def draw_ladder(gap: Gap) -> Figure:
    """Treads of fitted and of held-out runs."""
    figure, axes = panels(1, 1, height=3.9, width=WIDTH)
    axis, count = axes[0, 0], len(gap.ladder)
    edges = np.arange(count + 1) - 0.5
    series: list[tuple[str, str, Any, list[float]]] = [
        ("fitted runs", BLUE, "-", [rung.gap.fit for rung in gap.ladder])
    ]
    held = [rung.gap.held_out for rung in gap.ladder]
    if None not in held:
        series.append(("held-out runs", RED, (0, (4, 2)), [float(one or 0.0) for one in held]))
    axis.axhline(1.0, color=INK, linewidth=1.0, label="noise")
    for label, colour, style, values in series:
        axis.stairs(
            values, edges, baseline=None, color=colour, linewidth=2.2, linestyle=style, label=label
        )
    for place in range(count):
        order = sorted(series, key=lambda one: one[3][place])
        for _, colour, _, values in order:
            is_top = values is order[-1][3]
            axis.annotate(
                digits(values[place]), (place, values[place]), (0.0, 4.0 if is_top else -4.0),
                textcoords="offset points", ha="center", va="bottom" if is_top else "top",
                color=colour, fontsize=9.0,
            )  # fmt: skip
    everything = [1.0, *(value for one in series for value in one[3])]
    axis.set_ylim(min(everything) / 1.35, 1.5 * max(everything))
    _logarithmic_y(axis)
    lean = {"rotation": 35, "ha": "right"} if count > UPRIGHT else {}
    axis.set_xticks(range(count), [_wrapped(rung.name) for rung in gap.ladder], **lean)
    axis.set_xlim(-0.5, count - 0.5)
    axis.grid(visible=False, axis="x")
    axis.set_ylabel("gap (units of the noise)")
    figure.legend(loc="outside upper center", ncols=3)
    return figure


def _wrapped(name: str) -> str:
    """A rung's name on lines of its own."""
    return name.replace("_", "_\n").replace(" ", "\n").replace("measurement.", "measurement.\n")


def _logarithmic_y(axis: Axes) -> None:
    low, high = axis.get_ylim()
    fine = high < 5.0 * low
    axis.set_yscale("log")
    axis.yaxis.set_major_locator(LogLocator(subs=(1, 1.5, 2, 3, 5, 7) if fine else (1, 2, 5)))
    axis.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.yaxis.set_minor_formatter(NullFormatter())


@picture("curve", (
    "What was found, as the runs themselves have it: a free curve with its 90 % band, and each run "
    "by itself (dots, one standard deviation to either side). Broken: the catalogue's law."
))  # fmt: skip
def draw_laws(gap: Gap) -> Figure:
    """A panel for each law."""
    figure, axes = panels(max(len(gap.laws), 1), 1, height=3.9, width=WIDTH)
    for axis, law in zip(axes.flat, gap.laws, strict=False):
        _law(axis, law)
    return figure


def _law(axis: Axes, law: Law) -> None:
    scaled = readable(law.at, law.unit)
    factor, label = _ordinate(law)
    at, mean, sd = scaled(law.at), factor * law.mean, factor * law.sd
    axis.axhline(0.0, color=GREY, linewidth=0.6)
    axis.fill_between(
        at, mean - NINETY * sd, mean + NINETY * sd, color=RED, alpha=0.2, linewidth=0.0,
    )  # fmt: skip
    axis.plot(at, mean, color=RED, label="free curve")
    if law.law is not None:
        axis.plot(at, factor * law.law, "--", color=INK, label=f"law: {law.form}")
    heights = [mean - NINETY * sd, mean + NINETY * sd]
    if len(law.points):
        where, value, error = scaled(law.points[:, 0]), *(factor * law.points[:, 1:].T)
        axis.errorbar(
            where, value, error, fmt="o", color=BLUE, markersize=4.0, linewidth=0.9, capsize=2.0,
            label="each run",
        )  # fmt: skip
        heights.append(value)
    span = np.concatenate(heights)
    low, high = np.nanmin(span), np.nanmax(span)
    room = 0.12 * (high - low) or 1.0
    axis.set_ylim(low - room, high + room)
    if at.min() > 0.0 and at.max() > WIDE * at.min():
        logarithmic_x(axis)
    axis.set_xlabel(f"{law.quantity}{f' ({scaled.unit})' if scaled.unit != '1' else ''}")
    axis.set_ylabel(label)
    axis.set_title(law.effect)
    axis.legend(loc="best")


def _ordinate(law: Law) -> tuple[float, str]:
    """Factor and label of the values."""
    if law.per == "N":
        return 1.0, "force along x (N)"
    name = {"mu_k": "$\\mu_k$", "mu_s": "$\\mu_s$"}.get(law.per, law.per)
    return 100.0, f"change of {name} (%)"


def run_picture(gap: Gap) -> Picture:
    """One run where the user's model is worst; on a page it can be zoomed."""
    found = worst(gap)
    run, (factor, label) = measured_run(gap, found.run), SCALES[found.channel]
    panel = Panel(
        label.replace("(", "[").replace(")", "]"), run_curves(gap, found.run, found.channel, factor)
    )
    part = (found.begin, found.end, "where the user's model is farthest off")
    live = over_time(run.motion.time, [panel], part=part, opens_at_part=True)
    alt = f"{title(run)}: measured, and the model before and after."
    return replace(draw_run(gap), alt=alt, live=several({title(run): live}))


def run_curves(gap: Gap, name: str, channel: str, factor: float) -> list[Curve]:
    """Measured, before, after, of a whole run."""
    run = measured_run(gap, name)
    curves = [Curve("measured", factor * run.motion[channel], INK, dots=True)]
    for label, model, colour in models(gap):
        values = factor * modelled(run, model.run(name), channel)
        curves.append(Curve(label, values, colour))
    return curves


def models(gap: Gap) -> list:
    """Label, fit, colour; the user's model alone where nothing was added."""
    after = [("after", gap.extended, RED)] if len(gap.ladder) > 1 else []
    return [("before", gap.plain, BLUE), *after]


@picture("run", (
    "Where the user's model is farthest off, a few cycles: measured (dots), the user's model "
    "(before), and the model with everything that was found (after). Where the lines are cut the "
    "models set out anew from the data."
))  # fmt: skip
def draw_run(gap: Gap) -> Figure:
    """Measured, before and after over time."""
    found = worst(gap)
    run, (factor, label) = measured_run(gap, found.run), SCALES[found.channel]
    figure, axes = panels(1, 1, height=3.4, width=8.4)
    axis, time = axes[0, 0], run.motion.time
    rows = (time >= found.begin) & (time <= found.end)
    for curve in run_curves(gap, found.run, found.channel, factor):
        style = {"marker": ".", "linestyle": "", "zorder": 3.0} if curve.dots else {}
        axis.plot(time[rows], curve.values[rows], color=curve.colour, label=curve.label, **style)
    for start in time[starts(run, gap.plain.run(run.name))]:
        if found.begin < start < found.end:
            axis.axvline(start, color=GREY, linewidth=0.8, linestyle=":")
    axis.set_title(title(run))
    axis.set_xlabel("time in the run (s)")
    axis.set_ylabel(label)
    axis.set_xlim(found.begin, found.end)
    figure.legend(loc="outside upper right", ncols=3)
    return figure
