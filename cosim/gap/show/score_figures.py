"""Figures of the scores: ranking, gap of each run, numbers with their intervals, laws found."""

from __future__ import annotations

from collections.abc import Sequence
from types import SimpleNamespace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cosim.gap.curves.figure import draw_curves
from cosim.gap.diagnostics import RegimeAnalysis, analyse_residuals
from cosim.gap.result import Gap, Step
from cosim.report.style import BLUE, DULL_GREY, GREY, INK, ORANGE, RED, panels, picture
from cosim.studies.reproduction.summary import SummaryGap

from .quantities import unit_and_meaning
from .words import TABLES, held_out, percent

COLUMNS = 4
#: Label, colour, filling.
LEGEND = [("before", BLUE, BLUE), ("after", RED, RED), ("held out", GREY, "white")]
#: Gaps are drawn up to this many times the largest that matters, the plain model's.
BEYOND = 1.5
#: Gaps that are all smaller have closer ticks.
NARROW = 2.2


@picture("ranking", (
    "Every effect that was fitted on top of the plain model, and those named together: the gap on "
    "the runs that were held out, or, where none was, of the fit; its figure at the right. The "
    "dashed line is the plain model, the solid one measurement noise. Dark orange: named; yellow: "
    "one of a class."
))  # fmt: skip
def draw_ranking(gap: Gap | SummaryGap) -> Figure:
    """A bar for each effect, its best law, and one for several that were named; best first."""
    best: dict[str, float] = {}
    for row in gap.ranking:
        if row.held_out_gap is not None:  # else ruled out by the screening
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
    for place, name in enumerate(names):  # beside the panel: inside they would meet the lines
        over = "> " if best[name] > limit else ""
        axis.annotate(
            f"{over}{best[name]:.3g}", (1.0, place), (6.0, 0.0), va="center", fontsize=8.0,
            xycoords=axis.get_yaxis_transform(), textcoords="offset points", annotation_clip=False,
        )  # fmt: skip
    axis.axvline(1.0, color=INK, linewidth=1.0, label="measurement noise")
    axis.axvline(gap.gap_before[1], color=GREY, linestyle="--", label="plain model")
    axis.invert_yaxis()
    axis.set_xlim(0.0, 1.04 * max([*values, gap.gap_before[1], 1.0]))
    axis.grid(visible=False, axis="y")
    unit = "standard deviations" if isinstance(gap, SummaryGap) else "noise units"
    kept = held_out(gap, 1.0) is not None
    axis.set_xlabel(f"{'held-out gap' if kept else 'gap of the fit, nothing held out'} ({unit})")
    figure.legend(loc="outside upper right", ncols=2)
    return figure


def _colour(gap: Gap | SummaryGap, effect: str) -> str:
    if effect not in gap.effects:
        return DULL_GREY
    return ORANGE if any(effect in group for group in gap.classes) else RED


@picture("gaps", (
    "The gap of each run, before (blue) and after (dark orange): root mean square residual in "
    "units of the noise, which the line at 1 stands for. Hollow: held out, never fitted."
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
    held = LEGEND[2:] if gap.has_held_out else []
    for label, colour, fill in LEGEND[: 2 if gap.extended else 1] + held:
        axis.plot([], [], "o", color=colour, markerfacecolor=fill, label=label)
    figure.legend(loc="outside upper center", ncols=4)
    _log_ticks(axis, [run.gap for run in gap.plain.runs])
    axis.set_xticks(
        range(len(gap.plain.runs)), [run.name for run in gap.plain.runs], rotation=40, ha="right"
    )
    axis.set_ylabel("gap (noise units)")
    return figure


@picture("ladder", (
    "The ladder: the gap of the plain model and with one effect after the other, on the runs that "
    "were fitted (filled) and on those held out (hollow). The line at 1 is measurement noise. "
    "Above each step: the part of the misfit that is gone."
))  # fmt: skip
def draw_ladder(gap: Gap) -> Figure:
    """A place for each step; dark orange up to what the verdict stands on, grey beyond."""
    figure, axes = panels(1, 1, height=3.0, width=max(5.0, 2.4 + 1.9 * len(gap.ladder)))
    axis, places = axes[0, 0], range(len(gap.ladder))
    fit = [step.fit_gap for step in gap.ladder]
    held = [step.held_out_gap for step in gap.ladder]
    axis.plot(places, fit, color=GREY, linewidth=0.8)
    for place, step in enumerate(gap.ladder):
        colour = _step_colour(gap, step)
        axis.plot(place, fit[place], "o", color=colour, markersize=6.5)
        if gap.has_held_out:
            axis.plot(
                place, held[place], "o", color=colour, markerfacecolor="white", markersize=6.5
            )
        if step.effects:
            top = max(fit[place], held[place])
            axis.annotate(
                percent(step.share), (place, top), (0.0, 8.0), textcoords="offset points",
                ha="center", fontsize=8.0,
            )  # fmt: skip
    axis.axhline(1.0, color=INK, linewidth=1.0, label="measurement noise")
    for label, fill in (("fitted", GREY), ("held out", "white"))[: 1 + gap.has_held_out]:
        axis.plot([], [], "o", color=GREY, markerfacecolor=fill, label=label)
    figure.legend(loc="outside upper center", ncols=3)
    _log_ticks(axis, [*fit, *held])
    axis.set_xticks(places, [_step_name(step) for step in gap.ladder])
    axis.set_xlim(-0.5, len(gap.ladder) - 0.5)
    axis.set_ylabel("gap (noise units)")
    return figure


def _step_colour(gap: Gap, step: Step) -> str:
    if not step.effects:
        return BLUE
    if set(step.effects[:-1]) | set(step.members) <= set(gap.effects) or (
        set(step.effects) <= set(gap.effects)
    ):
        return ORANGE if gap.verdict == "class" and len(step.members) > 1 else RED
    return DULL_GREY


def _step_name(step: Step) -> str:
    if not step.effects:
        return "plain"
    last = " or\n".join(step.members) if len(step.members) > 1 else step.effects[-1]
    return f"+ {last}"


def _log_ticks(axis: Axes, values: Sequence[float]) -> None:
    """A logarithmic scale with numbers that can be read."""
    axis.set_yscale("log")
    top = max([*values, 1.0])
    near = (0.8, 1, 1.2, 1.5, 2, 2.5, 3) if top < NARROW else (0.5, 1, 2, 5)
    ticks = [t for t in (*near, 10, 20, 50, 100, 200, 500, 1000) if t <= 2.0 * top]
    axis.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    axis.minorticks_off()
    axis.set_ylim(0.75 if top < NARROW else 0.6, 1.35 * top)


@picture("parameters", (
    "Fitted numbers with 95 % intervals, in the plain model (blue) and in the extended one (dark "
    "orange). Dashed, with a triangle in place of a dot: the bound that a number is at. Dotted, "
    "without a dot: all that a number may be of which the data say nothing."
))  # fmt: skip
def draw_parameters(gap: Gap) -> Figure:
    """A panel for each number."""
    plain = SimpleNamespace(
        label="plain", colour=BLUE, values=gap.plain.values, at_bound=gap.plain.at_bound,
        undetermined=gap.plain.undetermined,
        intervals={**gap.plain.intervals, **{k: v[1:] for k, v in gap.determined.items()}},
    )  # fmt: skip
    models = [plain]
    if gap.extended:
        models.append(
            SimpleNamespace(
                label="extended",
                colour=RED,
                values=gap.extended.values,
                at_bound=gap.extended.at_bound,
                undetermined=gap.extended.undetermined,
                intervals=gap.extended.intervals,
            )
        )
    found = dict.fromkeys(key for model in models for key in model.values)
    keys = [key for key in found if not key.startswith(TABLES)]
    rows = -(-len(keys) // COLUMNS)
    figure, axes = panels(rows, COLUMNS, height=2.1, width=11.0)
    for axis in axes.flat[len(keys) :]:
        axis.set_axis_off()
    for axis, key in zip(axes.flat, keys, strict=False):
        for place, model in enumerate(models):
            if key in model.values:
                _value(axis, place, model, key)
        axis.set_xlim(-0.6, len(models) - 0.4)
        axis.set_xticks(range(len(models)), [model.label for model in models])
        axis.grid(visible=False, axis="x")
        unit = unit_and_meaning(key)[0]
        axis.set_title(f"{key}{f' ({unit})' if unit else ''}", fontsize=8.5)
        axis.ticklabel_format(axis="y", useOffset=False, style="plain")
    return figure


def _range(axis: Axes, place: int, pair: tuple[float, float], colour: str) -> None:
    """Of a number that the data say nothing of: all that it may be, without a dot."""
    axis.plot([place, place], pair, color=colour, linestyle=":")
    aside, align = (8.0, "left") if place == 0 else (-8.0, "right")
    axis.annotate(
        "not determined", (place, 0.5 * sum(pair)), (aside, 0.0), textcoords="offset points",
        ha=align, va="center", fontsize=7.5,
    )  # fmt: skip


def _value(axis: Axes, place: int, model: SimpleNamespace, key: str) -> None:
    value, bound = model.values[key], model.at_bound.get(key)
    if key in model.undetermined and key in model.intervals:
        _range(axis, place, model.intervals[key], model.colour)
        return
    axis.plot(place, value, "o" if bound is None else "^", color=model.colour)
    if bound is not None:
        axis.axhline(bound, color=model.colour, linewidth=0.8, linestyle="--")
        aside, align = (8.0, "left") if place == 0 else (-8.0, "right")
        axis.annotate(
            "at its bound", (place, value), (aside, 0.0), textcoords="offset points", ha=align,
            va="center", fontsize=7.5,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6},
        )  # fmt: skip
    if key in model.intervals:
        low, high = model.intervals[key]
        error = np.abs([[value - low], [high - value]])
        axis.errorbar(place, value, error, color=model.colour, capsize=4.0)


def draw_laws(gap: Gap) -> Figure:
    """The free curves of an answer; in red those of what was found."""
    named = [law.curve.axis for law in gap.laws if law.effect or law.in_model]
    return draw_curves([law.curve for law in gap.laws], named)


def analysis_of(gap: Gap) -> RegimeAnalysis:
    """Of what the plain model leaves, by regime; made now where the answer came without."""
    return gap.analysis or analyse_residuals([run.track for run in gap.plain.runs])
