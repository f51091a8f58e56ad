"""Figures of the runs: measured beside modelled, and what is left of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cosim.gap.estimation.preparation import period
from cosim.gap.result import FittedRun, Gap
from cosim.report.live import Curve, Live, Panel, over_time, several
from cosim.report.page import Picture
from cosim.report.style import BLUE, GREEN, GREY, INK, PALE_GREY, PURPLE, RED, panels, picture

#: Runs that a figure shows: more rows than these nobody reads.
MOST_RUNS = 8
#: Cycles in an excerpt.
CYCLES = 5.0
SCALES = {"x": (1e3, "x (mm)"), "y": (1e3, "y (mm)"), "phi": (1e3, "φ (mrad)")}
#: Noise units: linear up to here, logarithmic beyond.
LINEAR = 3.0
#: On a page, which can be zoomed, only from here on.
FAR = 30.0
COLOURS = {"x": INK, "y": GREEN, "phi": PURPLE}
TICKS = (-1000, -100, -10, -2, 0, 2, 10, 100, 1000)


def shown_runs(gap: Gap) -> list[str]:
    """Names of the runs drawn: those held out, then those in which the plain model is worst."""
    order = sorted(
        gap.plain.runs, key=lambda run: (not run.track.run.hold_out, -run.gap)
    )  # fmt: skip
    chosen = {run.name for run in order[:MOST_RUNS]}
    return [run.name for run in gap.plain.runs if run.name in chosen]


def channels(gap: Gap) -> tuple[str, ...]:
    """Channels that every drawn run has, and in which some model moves."""
    common = {*gap.plain.degrees_of_freedom, *gap.model.degrees_of_freedom}
    for name in shown_runs(gap):
        common &= set(gap.plain.of(name).track.channels)
    return tuple(name for name in SCALES if name in common)


def overlays(gap: Gap) -> list[Picture]:
    """Of every channel: an excerpt and the whole of each run."""
    return [
        replace(
            draw_overlay(gap, channel),
            name=f"overlay_{channel}",
            alt=f"{SCALES[channel][1]} over time: measured, and as the models have it.",
            live=_overlay_live(gap, channel),
        )
        for channel in channels(gap)
    ]


def _overlay_live(gap: Gap, channel: str) -> Live:
    """The same for the page: a figure for each run, the excerpt a button away."""
    found = {}
    for name in shown_runs(gap):
        plain = gap.plain.of(name)
        track, (factor, label) = plain.track, SCALES[channel]
        models = [("plain model", plain, BLUE)]
        models += [("extended model", gap.extended.of(name), RED)] if gap.extended else []
        curves = [Curve("measured", factor * track.run.motion[channel], INK, dots=True)]
        curves += [
            Curve(text, factor * getattr(run.track, channel), colour)
            for text, run, colour in models
        ]
        panel = Panel(label.replace("(", "[").replace(")", "]"), curves)
        part = (*excerpt(plain, channel), "where the plain model is farthest off")
        found[title(plain)] = over_time(track.time, [panel], part=part)
    return several(found)


OVERLAY = (
    "Measured (dots), the plain model (blue) and the extended one (dark orange). Left: the cycles "
    "in which the plain model is farthest off; right: the whole run. The models start anew from "
    "the data at the dotted lines."
)


@picture("overlay", OVERLAY)
def draw_overlay(gap: Gap, channel: str) -> Figure:
    names = shown_runs(gap)
    figure, axes = panels(
        len(names), 2, height=1.9, width=11.0, gridspec_kw={"width_ratios": (1.6, 1.0)}
    )
    for row, name in zip(axes, names, strict=True):
        plain = gap.plain.of(name)
        extended = gap.extended.of(name) if gap.extended else None
        _motion(row[0], plain, extended, channel, excerpt(plain, channel))
        _motion(row[1], plain, extended, channel, None)
        row[0].set_title(title(plain))
        row[0].set_ylabel(SCALES[channel][1])
    for axis in axes[-1]:
        axis.set_xlabel("time in the run (s)")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper right", ncols=3)
    return figure


def title(run: FittedRun) -> str:
    """Name, operating point, and whether it was held out."""
    measured = run.track.run
    held = ", held out" if measured.hold_out else ""
    return (
        f"{run.name}: {measured.mass:.3g} kg, {measured.stiffness:.4g} N/m, "
        f"{measured.surface_speed:.3g} m/s{held}"
    )


def excerpt(plain: FittedRun, channel: str) -> tuple[float, float]:
    """Start and end (s) of the stretch of some cycles in which the plain model is worst."""
    time = plain.track.time
    length = min(CYCLES * period(plain.track.run), time[-1] - time[0])
    squares = np.nan_to_num(plain.track.residual(channel)) ** 2
    total = np.concatenate([[0.0], np.cumsum(squares)])
    ends = np.searchsorted(time, time + length, side="right")
    starts = np.flatnonzero(time + length <= time[-1] + 1e-9)
    first = starts[np.argmax(total[ends[starts]] - total[starts])] if starts.size else 0
    return float(time[first]), float(time[first] + length)


def _motion(
    axis: Axes,
    plain: FittedRun,
    extended: FittedRun | None,
    channel: str,
    span: tuple[float, float] | None,
) -> None:
    track, factor = plain.track, SCALES[channel][0]
    low, high = span or (track.time[0], track.time[-1])
    rows = (track.time >= low) & (track.time <= high)
    size = 2.6 if span else 0.8
    time = track.time[rows]
    axis.plot(
        time,
        factor * track.run.motion[channel][rows],
        ".",
        color=INK,
        markersize=size,
        label="measured",
    )
    for run, colour, label in ((plain, BLUE, "plain model"), (extended, RED, "extended model")):
        if run is not None:
            model = factor * getattr(run.track, channel)[rows]
            axis.plot(time, model, color=colour, linewidth=1.1 if span else 0.6, label=label)
    if span:
        for start in track.time[np.flatnonzero(np.diff(track.segments)) + 1]:
            if low < start < high:
                axis.axvline(start, color=GREY, linewidth=0.8, linestyle=":")
    axis.set_xlim(low, high)


RESIDUALS = (
    "What the models leave, measured less modelled in units of the noise, before and after. "
    "Grey, or broken lines: two standard deviations of the noise. Linear within ±3, logarithmic "
    "beyond where there is much."
)


def residuals(gap: Gap) -> Picture:
    """Of every run, before and after."""
    return replace(
        draw_residuals(gap),
        alt="What the models leave of each run over time, in units of the noise.",
        live=_residuals_live(gap),
    )


def _residuals_live(gap: Gap) -> Live:
    """The same for the page: a figure for each run, a panel for each model."""
    models = [("plain model", gap.plain)]
    models += [("extended model", gap.extended)] if gap.extended else []
    found = {}
    for name in shown_runs(gap):
        plain = gap.plain.of(name)
        shown = [
            residual_panel(
                f"{label}, gap {model.of(name).gap:.3g}",
                {
                    channel: model.of(name).track.residual(channel)
                    for channel in plain.track.channels
                },
            )
            for label, model in models
        ]
        part = (*excerpt(plain, plain.track.channels[0]), "where the plain model is farthest off")
        found[f"left of {title(plain)}"] = over_time(plain.track.time, shown, part=part)
    return several(found)


def residual_panel(of: str, left: Mapping[str, np.ndarray]) -> Panel:
    """Channel -> what is left (n,), noise units, as dots; two standard deviations as levels."""
    dots = [
        Curve(f"{channel.replace('phi', 'φ')}, {of}", values, COLOURS[channel], dots=True)
        for channel, values in left.items()
    ]
    largest = max(float(np.nanmax(np.abs(each), initial=0.0)) for each in left.values())
    return Panel(
        "left [noise units]",
        dots,
        levels=[(2.0, "2 σ"), (-2.0, "−2 σ")],
        linear_to=LINEAR if largest > FAR else 0.0,
    )


@picture("residuals", RESIDUALS)
def draw_residuals(gap: Gap) -> Figure:
    """A row for each run, a colour for each channel."""
    names = shown_runs(gap)
    models = [("plain model", gap.plain)]
    models += [("extended model", gap.extended)] if gap.extended else []
    figure, axes = panels(
        len(names), len(models), height=1.6, width=11.0, sharey="row", sharex="row"
    )  # fmt: skip
    for row, name in zip(axes, names, strict=True):
        for axis, (label, model) in zip(row, models, strict=True):
            run = model.of(name)
            axis.axhspan(-2.0, 2.0, color=PALE_GREY, zorder=0)
            for channel in run.track.channels:
                axis.plot(
                    run.track.time,
                    run.track.residual(channel),
                    ".",
                    markersize=1.2,
                    color=COLOURS[channel],
                    label=channel.replace("phi", "φ"),
                )
            noise_scale(axis, np.max(np.abs(gap.plain.of(name).residuals())))
            axis.set_title(f"{name}, {label}: gap {run.gap:.3g}")
        row[0].set_ylabel("noise units")
    for axis in axes[-1]:
        axis.set_xlabel("time in the run (s)")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    if len(labels) > 1:
        figure.legend(handles, labels, loc="outside upper right", ncols=3, markerscale=6.0)
    return figure


def noise_scale(axis: Axes, largest: float) -> None:
    """An axis of residuals: linear near noise, logarithmic beyond, up to the largest."""
    axis.set_yscale("symlog", linthresh=LINEAR)
    limit = 1.4 * max(largest, LINEAR)
    ticks = [tick for tick in TICKS if abs(tick) <= limit and (abs(tick) != 2 or limit < 150.0)]
    axis.set_yticks(ticks, [f"{tick:g}".replace("-", "−") for tick in ticks])
    axis.minorticks_off()
    axis.set_ylim(-limit, limit)
