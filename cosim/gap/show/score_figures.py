"""Figures of the scores: the ranking, the gap of each run, the numbers with their intervals."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import SimpleNamespace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cosim.gap.result import Gap
from cosim.report.style import BLUE, GREY, INK, ORANGE, RED, panels, picture
from cosim.studies.reproduction.summary import SummaryGap

from .quantities import unit_and_meaning

COLUMNS = 4
#: Label, colour, filling.
LEGEND = [("before", BLUE, BLUE), ("after", RED, RED), ("held out", GREY, "white")]
#: Gaps are drawn up to this many times the largest that matters, the plain model's.
BEYOND = 1.5


@picture("ranking", (
    "Every effect of the catalogue on top of the plain model, and those named together: the gap on "
    "the runs that were held out. The dashed line is the plain model, the solid one measurement "
    "noise."
))  # fmt: skip
def draw_ranking(gap: Gap | SummaryGap) -> Figure:
    """A bar for each effect, its best law, and one for several that were named; best first."""
    best: dict[str, float] = {}
    for row in gap.ranking:
        best.setdefault(row.effect, row.held_out_gap)
    together = "\nand ".join(gap.effects)
    if gap.verdict == "named" and len(gap.effects) > 1:
        best[together] = gap.gap_after[1]
    names = sorted(best, key=best.__getitem__)
    figure, axes = panels(1, 1, height=0.9 + 0.26 * max(len(names), 1), width=8.0)
    axis = axes[0, 0]
    limit = BEYOND * max(gap.gap_before[1], 1.0)
    values = [min(best[name], limit) for name in names]
    colours = [RED if name == together else _colour(gap, name) for name in names]
    axis.barh(names, values, color=colours, height=0.7)
    for place, name in enumerate(names):
        over = "beyond " if best[name] > limit else ""
        axis.text(
            values[place],
            place,
            f" {over}{best[name]:.3g}",
            va="center",
            fontsize=8.0,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.4},
        )
    axis.axvline(1.0, color=INK, linewidth=1.0, label="measurement noise")
    axis.axvline(gap.gap_before[1], color=GREY, linestyle="--", label="plain model")
    axis.invert_yaxis()
    axis.set_xlim(0.0, 1.12 * max([*values, gap.gap_before[1]], default=1.0))
    axis.grid(visible=False, axis="y")
    unit = "standard deviations" if isinstance(gap, SummaryGap) else "noise units"
    axis.set_xlabel(f"held-out gap ({unit})")
    figure.legend(loc="outside upper right", ncols=2)
    return figure


def _colour(gap: Gap | SummaryGap, effect: str) -> str:
    if effect not in gap.effects:
        return "#BBBBBB"
    return ORANGE if any(effect in group for group in gap.classes) else RED


@picture("gaps", (
    "The gap of each run, before (blue) and after (red): root mean square residual in units of the "
    "noise, which the line at 1 stands for. Hollow: held out, never fitted."
))  # fmt: skip
def draw_gaps(gap: Gap) -> Figure:
    """Before and after, joined by a line, a place for each run."""
    figure, axes = panels(1, 1, height=3.0, width=max(6.0, 1.2 + 0.75 * len(gap.plain.runs)))
    axis = axes[0, 0]
    for place, run in enumerate(gap.plain.runs):
        pairs = [(run.gap, BLUE)]
        if gap.extended:
            pairs.append((gap.extended.of(run.name).gap, RED))
            axis.plot([place, place], [pairs[0][0], pairs[1][0]], color=GREY, linewidth=0.8)
        for value, colour in pairs:
            fill = "white" if run.track.run.hold_out else colour
            axis.plot(place, value, "o", color=colour, markerfacecolor=fill, markersize=6.5)
    axis.axhline(1.0, color=INK, linewidth=1.0, label="measurement noise")
    for label, colour, fill in LEGEND[: 2 if gap.extended else 1] + LEGEND[2:]:
        axis.plot([], [], "o", color=colour, markerfacecolor=fill, label=label)
    figure.legend(loc="outside upper center", ncols=4)
    _log_ticks(axis, [run.gap for run in gap.plain.runs])
    axis.set_xticks(
        range(len(gap.plain.runs)), [run.name for run in gap.plain.runs], rotation=40, ha="right"
    )
    axis.set_ylabel("gap (noise units)")
    return figure


def _log_ticks(axis: Axes, values: Sequence[float]) -> None:
    """A logarithmic scale with numbers that can be read."""
    axis.set_yscale("log")
    top = max([*values, 1.0])
    ticks = [t for t in (0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000) if t <= 2.0 * top]
    axis.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    axis.minorticks_off()
    axis.set_ylim(bottom=0.6)


@picture("parameters", (
    "Fitted numbers with 95 % intervals, in the plain model (blue) and in the extended one (red)."
))  # fmt: skip
def draw_parameters(gap: Gap) -> Figure:
    """A panel for each number."""
    plain = SimpleNamespace(
        label="plain", colour=BLUE, values=gap.plain.values,
        intervals={**gap.plain.intervals, **{k: v[1:] for k, v in gap.determined.items()}},
    )  # fmt: skip
    models = [plain]
    if gap.extended:
        models.append(
            SimpleNamespace(
                label="extended",
                colour=RED,
                values=gap.extended.values,
                intervals=gap.extended.intervals,
            )
        )
    keys = list(dict.fromkeys(key for model in models for key in model.values))
    rows = -(-len(keys) // COLUMNS)
    figure, axes = panels(rows, COLUMNS, height=2.1, width=11.0)
    for axis in axes.flat[len(keys) :]:
        axis.set_axis_off()
    for axis, key in zip(axes.flat, keys, strict=False):
        for place, model in enumerate(models):
            if key in model.values:
                _value(axis, place, model.values[key], model.intervals, key, model.colour)
        axis.set_xlim(-0.6, len(models) - 0.4)
        axis.set_xticks(range(len(models)), [model.label for model in models])
        axis.grid(visible=False, axis="x")
        unit = unit_and_meaning(key)[0]
        axis.set_title(f"{key}{f' ({unit})' if unit else ''}", fontsize=8.5)
        axis.ticklabel_format(axis="y", useOffset=False, style="plain")
    return figure


def _value(axis: Axes, place: int, value: float, intervals: Mapping, key: str, colour: str) -> None:
    axis.plot(place, value, "o", color=colour)
    if key in intervals:
        low, high = intervals[key]
        error = np.abs([[value - low], [high - value]])
        axis.errorbar(place, value, error, color=colour, capsize=4.0)
