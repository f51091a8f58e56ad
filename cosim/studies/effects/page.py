"""The catalogue as a page: all laws at a glance, then each, with the motion with and without it."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from itertools import zip_longest
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, FigureBase
from stickslip import Parameters, Trajectory, simulate
from stickslip.friction.law_curves import LawCurve, axis_of, law_curve

from cosim.report.live import Curve, Panel, Series, TimeFigure, panels_on_one_axis
from cosim.report.page import Picture, render, unit_text
from cosim.report.palette import BLUE, GREY
from cosim.report.style import draw_panel, panels, picture
from cosim.studies import FIGURES
from cosim.studies.effects import Entry, allowed, described, written

INTERVAL = 0.005  # s
#: A rig that sticks and slips from the start: pretensioned springs, friction along x.
PLAIN: dict[str, dict[str, Any]] = {
    "rig": {"spring_natural_length": 0.17},
    "surface": {"speed": 0.15},
    "initial": {"vx": 0.15},
}
#: Channel -> label of its axis, and what makes its values of SI.
CHANNELS = {"x": ("x [mm]", 1e3), "y": ("y [mm]", 1e3), "phi": ("φ [°]", 180.0 / np.pi)}
#: Part of the largest difference between two motions that a channel must have to be shown.
SHOWS = 0.2
#: Panels side by side of the picture of all.
ABREAST = 5


def page(told: Sequence[Entry], pictures: dict[str, Picture]) -> str:
    """HTML of the entries, each with its picture inside and folded."""
    rooms: dict[str, list[Entry]] = {}
    for each in told:
        rooms.setdefault(each.effect.enters, []).append(each)
    drawn = [each for inside in rooms.values() for each in inside if each.effect.id in pictures]
    return render(
        "effects.html.j2",
        "cosim.studies.effects",
        rooms={name: [described(each.effect) for each in inside] for name, inside in rooms.items()},
        sentence=sentence(rooms),
        overview=draw_overview(drawn) if len(drawn) >= ABREAST else None,
        pictures=pictures,
        laws={each.effect.id: law_figure(each) for each in drawn},
        allowed=allowed,
    )


def sentence(rooms: Mapping[str, Sequence[Any]]) -> str:
    """How many effects there are of what."""
    return str(written().sentence(rooms))


@picture("overview", **FIGURES["overview"])
def draw_overview(entries: Sequence[Entry]) -> Figure:
    """A small panel an effect."""
    figure, axes = panels(math.ceil(len(entries) / ABREAST), ABREAST, height=1.6, width=10.0)
    for ax, entry in zip_longest(axes.flat, entries):
        if entry is None:
            ax.set_visible(False)
            continue
        curves = _curves(entry)
        if curves[1] is not None:
            _draw_law(ax, curves)
        else:
            shown = motions(entry)
            _draw_panel(ax, shown, shown.panels[0])
        ax.set_title(entry.effect.id, fontsize=8.0)
        for axis in (ax.xaxis, ax.yaxis):
            axis.label.set_size(7.0)
        # no longer than the panel is high
        ax.set_ylabel(ax.get_ylabel().replace("friction coefficient", "µ"))
        ax.tick_params(labelsize=6.5)
    return figure


def effect_figure(entry: Entry) -> Picture:
    """PNG of the law and the two motions, with the numbers of the case in its caption."""
    curve = "its law, and " if axis_of(entry.effect) else ""
    caption = str(written().caption(entry.effect.case, curve))
    alt = f"{entry.effect.id}: {curve}the motion without and with it"
    # the page has the law as a drawing above the motions
    live = motions(entry).live()
    return replace(picture(entry.effect.id, caption, alt=alt)(_draw)(entry), live=live)


@cache
def motions(entry: Entry) -> TimeFigure:
    """Without the effect and with it, in the channels that show it."""
    runs = [("without", motion(entry, False), GREY), ("with", motion(entry, True), BLUE)]
    panels = []
    for name in channels_shown(entry):
        label, factor = CHANNELS[name]
        series = [Series(run.time, Curve(said, factor * run[name], hue)) for said, run, hue in runs]
        panels.append((Panel(label, []), series))
    return TimeFigure(*panels_on_one_axis(panels, entry.effect.case.window))


def law_figure(entry: Entry) -> Picture | None:
    """The law alone, to stand above motions that move; None for an effect without a curve."""
    curves = _curves(entry)
    if curves[1] is None:
        return None

    def draw() -> Figure:
        figure = Figure(figsize=(4.6, 2.9), layout="constrained")
        _draw_law(figure.subplots(), curves)
        return figure

    alt = f"{entry.effect.id}: {curves[1].quantity} over {curves[1].axis}"
    caption = "The law, without the effect (grey) and with it (blue), as far as the motion goes."
    return picture(f"{entry.effect.id}_law", caption, alt=alt)(draw)()


def _draw(entry: Entry) -> Figure:
    shown, curves = motions(entry), _curves(entry)
    figure = Figure(figsize=(10.0, max(2.6, 0.6 + 1.8 * len(shown.panels))), layout="constrained")
    right: FigureBase = figure
    if curves[1] is not None:
        halves: Any = figure.subfigures(1, 2, width_ratios=(2, 3))
        left, right = halves
        _draw_law(left.subplots(), curves)
    axes = right.subplots(len(shown.panels), 1, sharex=True, squeeze=False)[:, 0]
    for ax, panel in zip(axes, shown.panels, strict=True):
        _draw_panel(ax, shown, panel)
        ax.label_outer()
    axes[0].set_title("motion")
    names = [curve.label for curve in shown.panels[0].curves]
    figure.legend(axes[0].lines, names, loc="outside upper right", ncols=2)
    return figure


def _draw_panel(ax: Axes, shown: TimeFigure, panel: Panel) -> None:
    draw_panel(ax, shown.time, panel)
    ax.set(xlabel="time [s]", ylabel=panel.label, xlim=shown.time[[0, -1]])


def _draw_law(ax: Axes, curves: Sequence[LawCurve | None]) -> None:
    for curve, colour in zip(curves, (GREY, BLUE), strict=True):
        if curve is None:
            continue
        ax.plot(curve.x, curve.y, color=colour)
        ax.set(
            xlabel=f"{curve.axis} [{unit_text(curve.unit)}]",
            ylabel=f"{curve.quantity} [{unit_text(curve.of)}]",
            title="law",
        )
        if curve.logarithmic:
            ax.set_xscale("log")
    if curves[1] is not None and curves[1].of == "1" and ax.get_ylim()[0] > 0.0:
        ax.set_ylim(bottom=0.0)


def _curves(entry: Entry) -> list[LawCurve | None]:
    """The law without and with the effect, as far as the motion with it goes."""
    effect, case, run = entry.effect, entry.effect.case, motion(entry, True)
    reach = {
        "heat memory": float(run["heat"][-1]),
        "distance": float(run["sliding_distance"][-1]),
        "place": float(abs(run["surface_travel"][-1])),
        "time": case.window[1] - case.window[0],
        "sliding speed": 3.0 * run.parameters.surface.speed,
    }.get(axis_of(effect), 0.0)
    return [
        law_curve(effect, case_parameters(entry, on), _warmth(entry), case.water, reach)
        for on in (False, True)
    ]


def channels_shown(entry: Entry) -> list[str]:
    """Those in which an effect shows: x, y and the way of the rim by phi, compared in metres."""
    plain, shown = motion(entry, False), motion(entry, True)
    rows = min(plain.time.size, shown.time.size)
    late = plain.time[:rows] >= entry.effect.case.window[0]
    lever = {"phi": plain.parameters.rig.contact_radius}
    differ = {
        name: lever.get(name, 1.0)
        * float(np.max(np.abs(plain[name][:rows][late] - shown[name][:rows][late])))
        for name in CHANNELS
    }
    return [name for name in CHANNELS if differ[name] >= SHOWS * max(differ.values())]


@cache
def motion(entry: Entry, on: bool) -> Trajectory:
    """The run of a case; with the effect, the interface is as warm as the case says."""
    case = entry.effect.case
    return simulate(
        case_parameters(entry, on),
        case.window[1],
        INTERVAL,
        interface_temperature=_warmth(entry) if on else None,
        film_thickness=case.water,
    )


def _warmth(entry: Entry) -> float | None:
    """degC of the interface in a case; None where that has no say."""
    case = entry.effect.case
    reference = case.effect.get("reference_degC")
    return None if reference is None else reference + case.warmer


def case_parameters(entry: Entry, on: bool) -> Parameters:
    """The rig of an effect's case, with the effect or without."""
    case = entry.effect.case
    tables: dict[str, dict[str, Any]] = {}
    for laid in (PLAIN, case.rig, {entry.effect.id: case.effect} if on else {}):
        for name, numbers in laid.items():
            tables[name] = tables.get(name, {}) | dict(numbers)
    return Parameters.of(entry.catalogue).model_validate(tables)
