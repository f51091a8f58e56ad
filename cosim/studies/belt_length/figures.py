"""Figures of the study: drift over length, temperature along the loop, map."""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from cosim.studies.drawing import GREY, INK, SERIES, panels, picture

from .case import COARSENESS, Case
from .drift import RUN, run_drift, steady_drift
from .length_speed_map import DriftMap
from .study import Study

#: Points along a curve and along the loop.
_CURVE, _LOOP = 40, 400
#: Lowest rise that is drawn on a logarithmic axis, K.
_FLOOR = 1e-3


def _title(case: Case, films: set[float]) -> str:
    """What all curves share; the films (W/m2K) may differ where they follow from the speed."""
    film = " to ".join(f"{h:.3g}" for h in sorted({min(films), max(films)}))
    said = (f"friction {case.force:.2f} N, h {film} W/(m² K), belt {case.conductivity:g}"
            f" W/(m K), air {case.ambient_degC:g} °C")
    return said.replace("-", "−")


@picture("drift_over_length", "Rise of the belt where it enters the contact, over its length: "
         "after 20 s, for ever, and the study's single pass. Bars: 5 to 95 % over the ranges of h, "
         "conductivity and contact conductance.")
def draw_drift(study: Study) -> Figure:
    """One panel for the first choice of everything but length and speed."""
    first = study.rows[0].case
    speeds = sorted({row.case.speed for row in study.rows})
    lengths = sorted({row.case.length for row in study.rows})
    curve = np.geomspace(max(0.2, 0.5 * min(lengths)), 2.0 * max(lengths), _CURVE)
    figure, axes = panels(1, 1, height=4.8, width=7.5)
    ax = axes[0, 0]
    for i, speed in enumerate(speeds):
        colour = SERIES[i % len(SERIES)]
        case = _first(study, speed)
        belts = [case.with_length(float(length)) for length in curve]
        ax.plot(curve, _shown([run_drift(one) for one in belts]), color=colour)
        ax.plot(curve, _shown([steady_drift(one) for one in belts]), "--", color=colour)
        ax.plot(curve, _shown([one.as_the_study().temperature_degC(one.length) - one.ambient_degC
                               for one in belts]), ":", color=colour)
        _bars(ax, study, case, colour)
    ax.axhline(study.options.limit, color=INK, linewidth=1.0)
    ax.text(1.01, study.options.limit, f"limit\n{study.options.limit:g} K", va="center",
            transform=ax.get_yaxis_transform())
    ax.set(xscale="log", yscale="log", xlabel="length of the belt [m]", ylabel="rise [K]",
           title=_title(first, {_first(study, speed).h for speed in speeds}))
    ax.set_ylim(bottom=_FLOOR)
    _plain_ticks(ax.xaxis, (0.2, 0.5, 1, 2, 5, 10, 20), curve[0], curve[-1])
    _plain_ticks(ax.yaxis, (1e-3, 1e-2, 0.1, 1, 10), _FLOOR, 100.0)
    figure.legend(handles=_key(speeds), ncols=4, loc="outside upper center")
    return figure


def _first(study: Study, speed: float, length: float | None = None) -> Case:
    """The first case with a speed (and a length)."""
    return next(row.case for row in study.rows
                if row.case.speed == speed and length in (None, row.case.length))


def _key(speeds: list[float]) -> list[Artist]:
    """Colours say the speed, strokes the model."""
    handles: list[Artist] = [
        Line2D([], [], color=SERIES[i % len(SERIES)], label=f"{speed:g} m/s")
        for i, speed in enumerate(speeds)]
    kinds = {"-": f"after {RUN:g} s", "--": "for ever", ":": "study, one pass"}
    handles += [Line2D([], [], color=INK, linestyle=style, label=label)
                for style, label in kinds.items()]
    return [*handles, Patch(color=GREY, alpha=0.35, label=f"5–95 %, {RUN:g} s")]


def _shown(rises: list[float]) -> list[float]:
    """What is below the floor of the axis is left out, not drawn on it."""
    return [rise if rise >= _FLOOR else np.nan for rise in rises]


def _bars(ax, study: Study, case: Case, colour: str) -> None:
    rows = [row for row in study.rows if row.uncertainty is not None
            and row.case == case.with_length(row.case.length)]
    for row in rows:
        if row.uncertainty.low > _FLOOR:
            ax.plot([row.case.length] * 2, [row.uncertainty.low, row.uncertainty.high],
                    color=colour, linewidth=5.0, alpha=0.35, solid_capstyle="butt")


def _plain_ticks(axis, places, low: float, high: float) -> None:
    inside = [place for place in places if low <= place <= high]
    axis.set_ticks(inside, [f"{place:g}" for place in inside])
    axis.set_ticks([], minor=True)


@picture("along_the_loop", "Temperature of the belt's face along the loop, seen from the ice, "
         "after 20 s and for ever.")
def draw_loop(study: Study) -> Figure:
    """One panel a length (four at most), speeds in colour."""
    speeds = sorted({row.case.speed for row in study.rows})
    lengths = sorted({row.case.length for row in study.rows})[:4]
    figure, axes = panels(len(lengths), 1, height=2.1, width=7.5)
    for ax, length in zip(axes[:, 0], lengths, strict=True):
        x = np.linspace(-0.1 * length, 0.9 * length, _LOOP)
        for i, speed in enumerate(speeds):
            sliding = _first(study, speed, length).sliding()
            sliding.until(RUN, COARSENESS)
            colour = SERIES[i % len(SERIES)]
            ax.plot(x, sliding.face(x), color=colour, label=f"{speed:g} m/s, {RUN:g} s")
            sliding.settle()
            ax.plot(x, sliding.face(x), "--", color=colour, label="for ever")
        half = 0.5 * sliding.footprint.length
        ax.axvspan(-half, half, color=GREY, alpha=0.25, linewidth=0.0)
        ax.set(ylabel="rise [K]", title=f"belt of {length:g} m; shaded: under the ice")
        ax.set_xlim(x[0], x[-1])
        ax.set_ylim(bottom=0.0)
    axes[-1, 0].set_xlabel("place behind the middle of the contact, along the motion [m]")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=len(speeds), loc="outside upper center")
    return figure


@picture("map", "Rise of the belt where it enters the contact after 20 s, over length and speed.")
def draw_map(drift: DriftMap, case: Case, limit: float) -> Figure:
    """Colours in the logarithm, a line at the limit."""
    figure, axes = panels(1, 1, height=4.6, width=7.0)
    ax = axes[0, 0]
    shown = np.ma.masked_invalid(np.maximum(drift.drift, _FLOOR))
    colours = ax.pcolormesh(drift.lengths, drift.speeds, shown.T, shading="nearest",
                            norm=LogNorm(_FLOOR, max(1.0, float(shown.max()))), cmap="viridis",
                            rasterized=True)
    if np.any(shown > limit) and np.any(shown < limit):
        ax.contour(drift.lengths, drift.speeds, shown.T, levels=[limit], colors="white",
                   linewidths=2.0)
    ax.plot(drift.lengths, drift.lengths / RUN, color="white", linestyle="--", linewidth=1.0)
    ax.set_ylim(drift.speeds[0], drift.speeds[-1])
    ax.set(xscale="log", yscale="log", xlabel="length of the belt [m]", ylabel="speed [m/s]",
           title=f"{_title(case, {case.h})}\nwhite: {limit:g} K; dashed: one loop in {RUN:g} s")
    _plain_ticks(ax.xaxis, (0.3, 0.5, 1, 2, 5, 10), drift.lengths[0], drift.lengths[-1] * 1.001)
    _plain_ticks(ax.yaxis, (0.05, 0.1, 0.2, 0.5, 1), drift.speeds[0] * 0.999, drift.speeds[-1])
    ax.grid(False)
    figure.colorbar(colours, ax=ax, label=f"rise after {RUN:g} s [K]", extend="min")
    return figure
