"""Figures of the study: drift over length, what the doubt is made of, map."""

from collections.abc import Sequence
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from cosim.report.palette import BLUE, GREY, INK, RED, SERIES
from cosim.report.style import logarithmic_x, logarithmic_y, panels, picture
from cosim.studies import FIGURES
from thermal.arrays import Array

from .case import Case
from .drift import endless_belt, followed, never_comes_round, steady_drift
from .lengths import DriftMap
from .result import Row, Study
from .uncertainty import Record, Uncertainty

#: Points along a curve.
_CURVE = 40
#: From one speed's bar to the next, a factor.
_ASIDE = 1.025
#: Lowest rise that is drawn on a logarithmic axis, K.
_FLOOR = 1e-3
#: With what an unknown is seen that is a part of it.
SEEN_IN = {
    "railing_friction": "friction on it {:g}",
    "roller_conductance": "conductance to them {:g} W/m2K",
}


def _title(cases: list[Case]) -> str:
    """What all curves share; heat transfer by still air differs from speed to speed."""
    first, films = cases[0], [case.film for case in cases]
    film = " to ".join(f"{h:.2g}" for h in sorted({min(films), max(films)}))
    where = f" (still air, {first.length:g} m)" if first.h is None else ""
    stack = first.thermal().belt.stack
    belt = f"{stack[0].conductivity:g} W/(m K)" if len(stack) == 1 else f"of {len(stack)} layers"
    said = (
        f"friction {first.force:.3g} N, air {first.ambient_degC:g} °C, belt {belt}\n"
        f"h {film} W/(m² K){where}\n{first.protocol.in_words()}"
    )
    return said.replace("-", "−")


class Curves(NamedTuple):
    """Of one speed over lengths (m) of the belt, each (n,), K.

    entry: rise where the belt meets the contact, after the runs; steady: for ever; interface: what
    the interface warms by at constant speed; passed: the source study's single pass, or None.
    """

    case: Case
    lengths: Array
    entry: Array
    steady: Array
    interface: Array
    passed: Array | None


def curves_of(study: Study) -> list[Curves]:
    """For the first choice of everything but length and speed."""
    speeds = sorted({row.case.speed for row in study.rows})
    lengths = [row.case.length for row in study.rows]
    firsts = [next(row.case for row in study.rows if row.case.speed == one) for one in speeds]
    low = max(0.5 * min(lengths), 1.2 * max(case.shortest for case in firsts))
    high = 4.0 * max(lengths)
    for answer in study.answers:
        low, high = min([low, *answer.lengths[:1]]), max([high, *answer.lengths[-1:]])
    return [_curves(case, np.geomspace(low, high, _CURVE), study) for case in firsts]


def _curves(case: Case, lengths: Array, study: Study) -> Curves:
    travel = case.travel
    if lengths[0] < travel < lengths[-1]:
        # so that the curve falls where the last place comes round, not somewhere beyond
        lengths = np.sort([*lengths, 0.98 * travel, travel, 1.03 * travel])
    belts = [case.with_length(float(length)) for length in lengths]
    rises = [followed(one)[0] for one in belts]
    entry, warming = np.transpose([(one.run, one.interface_drift) for one in rises])
    steady = np.array([steady_drift(one) for one in belts])
    passed = np.array([one.as_the_study().temperature_degC(one.length) for one in belts])
    single = None if study.answers else passed - case.ambient_degC
    return Curves(case, lengths, entry, steady, warming, single)


@picture("drift_over_length", **FIGURES["drift_over_length"])
def draw_drift(study: Study, curves: Sequence[Curves]) -> Figure:
    """Rise of the belt at entry."""
    figure, ax = _over_length(study, curves)
    for i, each in enumerate(curves):
        colour, lengths = SERIES[i % len(SERIES)], each.lengths
        if lengths[0] < each.case.travel < lengths[-1] and never_comes_round(
            endless_belt(each.case)
        ):
            _mark_end(ax, each.case.travel, colour)
        # far below the axis where there is no rise, so that a curve leaves it instead of ending
        ax.plot(lengths, np.maximum(each.entry, 1e-3 * _FLOOR), color=colour)
        ax.plot(lengths, np.maximum(each.steady, 1e-3 * _FLOOR), "--", color=colour)
        if each.passed is not None:
            ax.plot(lengths, each.passed, ":", color=colour)
        _band(ax, 0, study, each.case, colour)
        _bars(ax, study, each.case, colour, _ASIDE ** (i - 0.5 * (len(curves) - 1)))
    ax.set(ylabel="belt's rise at entry [K]")
    ax.set_ylim(bottom=_FLOOR)
    logarithmic_y(ax)
    figure.legend(handles=_key(curves, study), ncols=3, loc="outside lower center")
    return figure


@picture("interface_over_length", **FIGURES["interface_over_length"])
def draw_interface(study: Study, curves: Sequence[Curves]) -> Figure:
    """Rise of the interface at constant speed."""
    figure, ax = _over_length(study, curves)
    for i, each in enumerate(curves):
        colour = SERIES[i % len(SERIES)]
        ax.plot(each.lengths, each.interface, color=colour, label=f"{each.case.speed:g} m/s")
        _band(ax, 1, study, each.case, colour)
    ax.set(ylabel="interface's rise at constant speed [K]")
    ax.set_ylim(bottom=max(_FLOOR, ax.get_ylim()[0]))
    logarithmic_y(ax)
    figure.legend(ncols=len(curves), loc="outside lower center")
    return figure


def _over_length(study: Study, curves: Sequence[Curves]) -> tuple[Figure, Axes]:
    """An empty panel with the limit, and the belts that are asked about."""
    figure, axes = panels(1, 1, height=4.6, width=5.4)  # as wide as a phone's screen bears
    ax, limit = axes[0, 0], study.options.limit
    low, high = curves[0].lengths[[0, -1]]
    ax.axhline(limit, color=INK, linewidth=1.0)
    ax.text(1.01, limit, f"limit\n{limit:g} K", va="center", transform=ax.get_yaxis_transform())
    ax.set(xscale="log", yscale="log", xlabel="length of the belt [m]", xlim=(low, high))
    logarithmic_x(ax)
    ax.set(title=_title([each.case for each in curves]))
    for length in sorted({row.case.length for row in study.rows}) if study.answers else ():
        ax.axvline(length, color=GREY, linestyle="-.", linewidth=1.0)
    return figure, ax


def _mark_end(ax: Axes, length: float, colour: str) -> None:
    """Where nothing comes round any more: a triangle at the foot, with the length."""
    ax.plot(length, _FLOOR, "v", color=colour, markersize=8.0, clip_on=False, zorder=5)
    words, place = f"nothing comes\nround from {length:.3g} m", (length, _FLOOR)
    beside: Any = {"xytext": (8.0, 5.0), "textcoords": "offset points", "ha": "left"}
    beside["bbox"] = {"facecolor": "white", "alpha": 0.8, "edgecolor": "none", "pad": 1.0}
    ax.annotate(words, place, fontsize=8.0, color=colour, **beside)


def _band(ax: Axes, which: int, study: Study, case: Case, colour: str) -> None:
    """5 to 95 % of the rigs of a speed over the lengths of an own rig, of one of its rises."""
    for answer in study.answers:
        if answer.case.drive == case.drive and answer.lengths.size:
            low, _, high = answer.levels[which]
            style: Any = {"color": colour, "linewidth": 0.0, "alpha": 0.18}
            ax.fill_between(answer.lengths, np.maximum(low, 1e-2 * _FLOOR), high, **style)


def _bars(ax: Axes, study: Study, case: Case, colour: str, aside: float) -> None:
    """The same at the lengths asked for, or a little aside where several speeds have one."""
    style: Any = {"color": colour, "linewidth": 5.0, "alpha": 0.35, "solid_capstyle": "butt"}
    for row in study.rows:
        if row.uncertainty is not None and row.case == case.with_length(row.case.length):
            ends = [max(row.uncertainty.low, _FLOOR), row.uncertainty.high]
            ax.plot([aside * row.case.length] * 2, ends, **style)


def _key(curves: Sequence[Curves], study: Study) -> list[Artist]:
    """Colours say the speed, strokes the model."""
    last = ("-.", GREY, "belt asked about") if study.answers else (":", INK, "study, one pass")
    strokes: Any = [("-", INK, "after the runs"), ("--", INK, "for ever"), last]
    handles: list[Artist] = [
        Line2D([], [], color=SERIES[i % len(SERIES)], label=f"{each.case.speed:g} m/s")
        for i, each in enumerate(curves)
    ]
    handles += [Line2D([], [], color=ink, linestyle=one, label=says) for one, ink, says in strokes]
    if study.most_doubted:
        handles.append(Patch(color=GREY, alpha=0.35, label="5–95 %, after the runs"))
    return handles


@picture("doubt", **FIGURES["doubt"])
def draw_doubt(row: Row, doubt: Uncertainty) -> Figure:
    """Bars of single changes beside the indices, one line an unknown; of a row with its doubt."""
    height = 1.6 + 0.38 * len(doubt.single_changes)
    figure, axes = panels(1, 2, height=height, width=10.0, sharey=True)
    left, right = axes[0]
    single = sorted(doubt.table(), key=itemgetter("total"))
    places = np.arange(len(single))
    ends = np.array([(one["drift_low"], one["drift_high"]) for one in single])
    left.hlines(places, *ends.T, color=GREY, linewidth=5.0, alpha=0.5)
    for end, colour, said in zip(ends.T, (BLUE, RED), ("low end", "high end"), strict=True):
        left.plot(end, places, "o", color=colour, markersize=6.0, label=said)
    left.axvline(row.drift.run, color=INK, linewidth=1.0, label="as the case is")
    left.set_yticks(places, [f"{one['says']}\n{_span_of(one)}" for one in single], fontsize=8.5)
    where = f"{row.case.length:g} m at {row.case.speed:g} m/s"
    left.set_title(f"{where}:\neach unknown over its range")
    left.set_xlabel("belt's rise at entry [K]")
    figure.legend(*left.get_legend_handles_labels(), ncols=3, loc="outside upper center")
    totals = [100.0 * one["total"] for one in single]
    errors = [100.0 * one["total_half_width"] for one in single]
    right.barh(places, totals, xerr=errors, color=GREY, ecolor=INK, height=0.6)
    right.set_title("total Sobol index of each,\nwith 95 % interval")
    right.set_xlabel("part of the variance of the rise [%]")
    right.set_xlim(left=0.0)
    return figure


def _span_of(one: Record) -> str:
    """Of an unknown the range, and what else is not as the case is."""
    unit = {"x": " times", "1": ""}.get(one["unit"], f" {one['unit']}")
    said = f"{one['low']:g} to {one['high']:g}{unit}"
    for key, value in one["with_others"].items():
        said += f" ({SEEN_IN[key].format(value)})"
    return said.replace("W/m2K", "W/(m² K)").replace("-", "−")


@picture("map", **FIGURES["map"])
def draw_map(drift: DriftMap, case: Case, limit: float) -> Figure:
    """Colours in the logarithm, a line at the limit."""
    figure, axes = panels(1, 1, height=4.6, width=7.0)
    ax = axes[0, 0]
    shown = np.ma.masked_invalid(np.maximum(drift.drift, _FLOOR))
    norm = LogNorm(_FLOOR, max(1.0, float(shown.max())))
    style: Any = {"shading": "nearest", "cmap": "viridis", "rasterized": True}
    colours = ax.pcolormesh(drift.lengths, drift.speeds, shown.T, norm=norm, **style)
    if np.any(shown > limit) and np.any(shown < limit):
        line = {"levels": [limit], "colors": "white", "linewidths": 2.0}
        ax.contour(drift.lengths, drift.speeds, shown.T, **line)
    one_loop = drift.lengths / (case.protocol.runs * case.protocol.moving)
    ax.plot(drift.lengths, one_loop, color="white", linestyle="--", linewidth=1.0)
    ax.set_ylim(drift.speeds[0], drift.speeds[-1])
    film = "of still air" if case.h is None else f"{case.h:g} W/(m² K)"
    said = f"friction {case.force:.2f} N, h {film}, {case.protocol.in_words()}"
    ax.set_title(f"{said}\nsolid: {limit:g} K; dashed: one loop in all")
    ax.set(xlabel="length of the belt [m]", ylabel="speed [m/s]")
    logarithmic_x(ax)
    logarithmic_y(ax)
    ax.grid(False)
    figure.colorbar(colours, ax=ax, label="belt's rise at entry [K]", extend="min")
    return figure
