"""Figures of a system's run over time: what went across, energy, and the steps taken."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cosim.coupling import Ledger
from cosim.coupling.conversion import NO_UNIT
from cosim.names import unknown_name
from cosim.report.columns import Columns
from cosim.report.live import Curve, Live, Panel, over_time
from cosim.report.page import Picture, number
from cosim.report.style import (
    BLUE,
    FAINT_BLUE,
    INK,
    SERIES,
    SPELLING,
    Scaled,
    at_least,
    line,
    panels,
    picture,
    plain_ticks,
    readable,
    shown,
)
from cosim.systems.run import SystemRun
from cosim.systems.show.diagram import colour_key, diagram, is_legible
from cosim.systems.show.matrix import matrix

#: Panels of the first figure, and of the one below with the others, of which the first are drawn.
FIRST_PANELS, MOST_PANELS = 4, 24
#: Letters of a panel's title; a longer one has the unit's name on a line of its own.
LONGEST_TITLE = 42
#: Units that a prefix is put before.
PREFIXED = ("m", "s", "N", "J", "W", "Pa", "A", "V", "rad", "m/s", "m/s2", "rad/s", "N.m", "J/kg")
#: Change of a signal that is none, as a part of it.
NOTHING = 1e-6
#: Size of a signal that is none: of what its participant has in the same unit, and of its nominal.
OF_ALIKE, OF_NOMINAL = 1e-11, 1e-13

#: What makes a picture of these arguments.
Drawer = tuple[Callable[..., Picture], tuple[Any, ...]]


def pictures(run: SystemRun, columns: Columns) -> dict[str, Picture]:
    """Every figure that the run has something for: name -> picture, in the page's order."""
    alive: dict[str, Callable[..., Picture]] = {
        "signals": signals,
        "more_signals": more_signals,
        "energy": energy,
        "steps": steps,
    }
    found = {
        name: alive.get(name, draw)(*arguments)
        for name, (draw, arguments) in _drawers(run, columns).items()
    }
    system = run.assembly.system
    if is_legible(system, run.assembly.order):
        shown_there = found["system"].caption + colour_key(system)
        found["system"] = replace(found["system"], caption=shown_there)
    return found


def figure_of(run: SystemRun, columns: Columns, name: str) -> Figure:
    """One of them for a notebook; ValueError for a name that is none of this run's."""
    found = _drawers(run, columns)
    if name not in found:
        raise ValueError(unknown_name("figure of this run", name, found))
    draw, arguments = found[name]
    return shown(draw, *arguments)


def _drawers(run: SystemRun, columns: Columns) -> dict[str, Drawer]:
    """Name -> what draws it, of what."""
    system, order = run.assembly.system, run.assembly.order
    found: dict[str, Drawer] = {
        "system": (diagram if is_legible(system, order) else matrix, (system, order))
    }
    if any(each.attrs.get("causality") == "output" for each in columns.data_vars.values()):
        found["signals"] = _signals, (columns,)
    if len(_drawn(columns)[0]) > FIRST_PANELS:
        found["more_signals"] = _more_signals, (columns,)
    if run.result.ledger.flows:
        found["energy"] = _energy, (run.result.time, run.result.ledger)
    if run.steps.count:
        found["steps"] = _steps, (columns, run.specification.run.start)
    return found


def signals(columns: Columns) -> Picture:
    """A panel for each of the first outputs."""
    return _alive(_signals(columns), "Outputs over time.", _signals_live(columns))


def more_signals(columns: Columns) -> Picture:
    """The outputs after those, up to `MOST_PANELS`."""
    live = _signals_live(columns, more=True)
    return _alive(_more_signals(columns), "Further outputs over time.", live)


def energy(time: NDArray[np.float64], ledger: Ledger) -> Picture:
    """Handed over and taken up, and what is between."""
    alt = "Energy handed over and taken up across each connection over time."
    return _alive(_energy(time, ledger), alt, _energy_live(time, ledger))


def steps(columns: Columns, start: float) -> Picture:
    """Step size over time, on a logarithmic axis where the steps differ much."""
    alt = "Sizes of the macro steps over time."
    return _alive(_steps(columns, start), alt, _steps_live(columns, start))


def _alive(drawn: Picture, alt: str, live: Live) -> Picture:
    return replace(drawn, alt=alt, live=live)


@picture(
    "signals",
    "Outputs over time at the recorded times, those that are connected first.",
)
def _signals(columns: Columns) -> Figure:
    return _signals_figure(columns, more=False)


@picture(
    "more_signals",
    f"Further outputs over time, of more than {MOST_PANELS} the first; the numbers below and the"
    " files have all.",
)
def _more_signals(columns: Columns) -> Figure:
    return _signals_figure(columns, more=True)


def _signals_figure(columns: Columns, more: bool) -> Figure:
    names, said = _shown(columns, more)
    across = 3 if more else 2
    rows = -(-len(names) // across)
    figure, axes = panels(rows, across, height=1.7, width=10.5, sharex=True)
    time = columns["time"].values
    for panel, name in zip(axes.flat, names, strict=False):
        label, values, least = _signal(columns, name)
        line(panel, time, values, color=BLUE)
        is_long = len(label) > LONGEST_TITLE
        panel.set_title(label.replace(".", ".\n", 1) if is_long else label, fontsize=9)
        plain_ticks(panel)
        at_least(panel, least)
    _end(axes, len(names))
    if said:
        figure.supxlabel("\n".join(textwrap.wrap(said, 130)), x=0.008, ha="left", fontsize=9)
    return figure


def _signals_live(columns: Columns, more: bool = False) -> Live:
    names, said = _shown(columns, more)
    panels = []
    for name in names:
        label, values, least = _signal(columns, name)
        panels.append(Panel(label, [Curve(name, values, BLUE)], span=least))
    return over_time(columns["time"].values, panels, note=said, columns=2)


def _signal(columns: Columns, name: str) -> tuple[str, NDArray[np.float64], float]:
    """Label, values in a readable unit, and the least that an axis spans.

    Else the last bits of what stays the same would fill the panel.
    """
    values, unit = columns[name].values, columns[name].attrs["units"]
    if _is_rounding(columns, name):
        values = np.zeros_like(values)  # of a figure that has nothing else
    scaled = readable(values, unit) if unit in PREFIXED else Scaled(1.0, unit)
    least = NOTHING * scaled.factor * float(np.max(np.abs(values)))
    told = SPELLING.get(scaled.unit, scaled.unit)
    return name if told == NO_UNIT else f"{name} [{told}]", scaled(values), least


def _shown(columns: Columns, more: bool) -> tuple[list[str], str]:
    """Of `_drawn` what the first figure shows, or the one with more; the text is below the last."""
    names, said = _drawn(columns)
    if more:
        return names[FIRST_PANELS : FIRST_PANELS + MOST_PANELS], said
    return names[:FIRST_PANELS], said if len(names) <= FIRST_PANELS else ""


def _drawn(columns: Columns) -> tuple[list[str], str]:
    """Outputs to draw, and a line of text on those that stay as they are."""
    sources = {each.attrs.get("fed_by", "") for each in columns.data_vars.values()}
    outputs = [
        str(name)
        for name, each in columns.data_vars.items()
        if each.attrs.get("causality") == "output"
    ]
    connected = [name for name in outputs if columns[name].attrs["long_name"] in sources]
    ordered = [*connected, *(name for name in outputs if name not in connected)]
    noise = [name for name in ordered if _is_rounding(columns, name)]
    flat = [name for name in ordered if name not in noise and _is_flat(columns[name].values)]
    # a figure of nothing at all would be less than one of something flat
    shown = [name for name in ordered if name not in (*flat, *noise)] or ordered[:1]
    constant = "; ".join(_constant(columns, name) for name in flat if name not in shown)
    rounding = ", ".join(name for name in noise if name not in shown)
    said = f"Not drawn, as they do not change: {constant}." if constant else ""
    if rounding:
        said = f"{said} Not drawn, as they are 0 but for rounding: {rounding}.".strip()
    return shown, said


def _is_flat(values: NDArray[np.float64]) -> bool:
    return bool(np.ptp(values) <= NOTHING * np.max(np.abs(values)))


def _is_rounding(columns: Columns, name: str) -> bool:
    """Whether it is never more than rounding of what its participant computes with."""
    own = columns[name].attrs
    size = float(np.max(np.abs(columns[name].values)))
    alike = [
        float(np.max(np.abs(each.values)))
        for each in columns.data_vars.values()
        if each.attrs.get("participant") == own["participant"]
        and each.attrs["units"] == own["units"] != NO_UNIT
    ]
    found: bool = 0.0 < size < max(OF_NOMINAL * own["nominal"], OF_ALIKE * max(alike, default=0.0))
    return found


def _constant(columns: Columns, name: str) -> str:
    unit = columns[name].attrs["units"]
    told = "" if unit == NO_UNIT else SPELLING.get(unit, unit)
    return f"{name} {number(float(columns[name].values[-1]))} {told}".strip()


def _end(axes: NDArray[Any], used: int) -> None:
    """Time below the lowest panel of each column; no empty panels."""
    across = axes.shape[1]
    for place, panel in enumerate(axes.flat):
        if place >= used:
            panel.set_visible(False)
        elif place + across >= used:
            panel.set_xlabel("time [s]")
            panel.tick_params(labelbottom=True)


@picture(
    "energy",
    "Energy across each connection in J: handed over by the one unit, and taken up by the other. "
    "Below: what has been handed over and not taken up.",
)
def _energy(time: NDArray[np.float64], ledger: Ledger) -> Figure:
    figure, axes = panels(2, 1, height=2.2, width=9.0, sharex=True)
    for flow, colour in zip(ledger.flows, _colours(len(ledger.flows)), strict=True):
        line(axes[0, 0], time, flow.handed, color=colour, label=str(flow.connection))
        axes[0, 0].plot(time, flow.taken, color=INK, linewidth=0.8, linestyle=":")
        line(axes[1, 0], time, flow.in_transit, color=colour)
    axes[0, 0].legend()
    axes[0, 0].set_ylabel("handed over [J]")
    axes[1, 0].set_ylabel("in transit [J]")
    axes[1, 0].set_xlabel("time [s]")
    plain_ticks(axes[0, 0])
    at_least(axes[1, 0], _least_in_transit(ledger))
    return figure


def _least_in_transit(ledger: Ledger) -> float:
    """Rounding of what was handed over is not drawn as energy in transit."""
    return NOTHING * max(float(np.max(np.abs(flow.handed), initial=0.0)) for flow in ledger.flows)


def _energy_live(time: NDArray[np.float64], ledger: Ledger) -> Live:
    handed, transit = [], []
    for flow, colour in zip(ledger.flows, _colours(len(ledger.flows)), strict=True):
        name = str(flow.connection)
        handed.append(Curve(name, flow.handed, colour))
        handed.append(Curve(f"{name}, taken up", flow.taken, INK, dash=True, width=0.8))
        transit.append(Curve(name, flow.in_transit, colour))
    below = Panel("in transit [J]", transit, span=_least_in_transit(ledger))
    return over_time(time, [Panel("handed over [J]", handed), below])


def _colours(count: int) -> Sequence[str]:
    return [SERIES[place % len(SERIES)] for place in range(count)]


@picture(
    "steps",
    "Sizes of the macro steps that were accepted. In a run of very many steps neighbours are drawn "
    "as one band, from the smallest to the largest of them.",
)
def _steps(columns: Columns, start: float) -> Figure:
    figure, axes = panels(1, 1, height=2.4, width=9.0)
    panel = axes[0, 0]
    ends = columns["step_time"].values
    edges = np.concatenate([[start], ends])
    shortest, longest = columns["shortest_step"].values, columns["longest_step"].values
    if np.any(longest > shortest * (1.0 + 1e-6)):
        panel.fill_between(
            edges, np.append(shortest, shortest[-1]), np.append(longest, longest[-1]),
            step="post", color=FAINT_BLUE,
        )  # fmt: skip
    panel.stairs(longest, edges, color=BLUE, baseline=None, linewidth=1.2)
    if longest.max() > 5.0 * shortest.min():
        panel.set_yscale("log")
    else:
        panel.set_ylim(0.0, 1.25 * longest.max())
    panel.set_xlabel("time [s]")
    panel.set_ylabel("macro step [s]")
    return figure


def _steps_live(columns: Columns, start: float) -> Live:
    edges = np.concatenate([[start], columns["step_time"].values])
    longest, shortest = (
        np.append(columns[name].values[:1], columns[name].values)
        for name in ("longest_step", "shortest_step")
    )
    curves = [Curve("longest of neighbours", longest, BLUE, steps=True)]
    if np.any(longest > shortest * (1.0 + 1e-6)):
        curves.append(Curve("shortest of them", shortest, FAINT_BLUE, steps=True))
    else:
        curves = [Curve("macro step", longest, BLUE, steps=True)]
    differ = bool(longest.max() > 5.0 * shortest.min())
    panel = Panel("macro step [s]", curves, logarithmic=differ, from_zero=not differ)
    return over_time(edges, [panel])
