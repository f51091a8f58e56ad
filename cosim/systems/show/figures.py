"""Figures of a system's run over time: what went across, energy, and the steps taken."""

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray
from stickslip.packaged import packaged_tables

from cosim.coupling import Ledger
from cosim.coupling.conversion import NO_UNIT
from cosim.names import unknown_name
from cosim.report.columns import Column, Columns
from cosim.report.live import Curve, Panel, TimeFigure
from cosim.report.page import Picture, number, unit_text
from cosim.report.palette import BLUE, INK, SERIES
from cosim.report.style import displayed, draw_over_time, picture_over_time, shown
from cosim.systems.run import SystemRun
from cosim.systems.show.diagram import chart
from cosim.systems.show.page import scale
from cosim.systems.show.summary import is_rounding

#: Panels of the first figure, and of the one below with the others, of which the first are drawn.
FIRST_PANELS, MOST_PANELS = 4, 24
#: Change of a signal that is none, as a part of it.
NOTHING = 1e-6
#: Figures over time: caption, and what a reader hears who does not see it.
OVER_TIME: dict[str, tuple[str, str]] = {
    name: (told["caption"].format(most=MOST_PANELS), told["alt"])
    for name, told in packaged_tables(__package__, "captions.toml").items()
}


def pictures(run: SystemRun, columns: Columns) -> dict[str, Picture]:
    """Every figure that the run has something for: name -> picture, in the page's order."""
    found = {"system": chart(run.assembly.system, run.assembly.scheme.order)}
    for name, one in described(run, columns).items():
        found[name] = picture_over_time(name, *OVER_TIME[name], one)
    return found


def figure_of(run: SystemRun, columns: Columns, name: str) -> Figure:
    """One of them for a notebook; ValueError for a name that is none of this run's."""
    found = described(run, columns)
    if name == "system":
        return shown(chart, run.assembly.system, run.assembly.scheme.order)
    if name not in found:
        raise ValueError(unknown_name("figure of this run", name, ("system", *found)))
    return displayed(draw_over_time(found[name]))


def described(run: SystemRun, columns: Columns) -> dict[str, TimeFigure]:
    """The figures over time that there is something for."""
    found = {}
    if any(map(_is_output, columns.data_vars.values())):
        found["signals"] = signals(columns)
    if len(_drawn(columns)[0]) > FIRST_PANELS:
        found["more_signals"] = signals(columns, more=True)
    if run.result.ledger.flows:
        found["energy"] = _energy(run.result.time, run.result.ledger)
    if run.steps.size:
        found["steps"] = _steps(columns, run.specification.run.start)
    return found


def signals(columns: Columns, more: bool = False) -> TimeFigure:
    """A panel for each of the first outputs; more: of those after them, up to `MOST_PANELS`.

    The text on what stays as it is stands below the last.
    """
    names, said = _drawn(columns)
    if more:
        names = names[FIRST_PANELS : FIRST_PANELS + MOST_PANELS]
    elif len(names) > FIRST_PANELS:
        names, said = names[:FIRST_PANELS], ""
    panels = [_signal(columns, name) for name in names]
    return TimeFigure(columns["time"].values, panels, note=said, columns=2)


def _signal(columns: Columns, name: str) -> Panel:
    """A signal in a readable unit; its axis has a least span, or else the last bits of what stays
    the same would fill it.
    """
    values, unit = columns[name].values, columns[name].attrs["units"]
    if is_rounding(columns, name):
        values = np.zeros_like(values)  # of a figure that has nothing else
    scaled = scale(values, unit)
    least = NOTHING * scaled.factor * float(np.max(np.abs(values)))
    told = unit_text(scaled.unit)
    label = name if told == NO_UNIT else f"{name} [{told}]"
    return Panel(label, [Curve(name, scaled(values), BLUE)], span=least)


def _drawn(columns: Columns) -> tuple[list[str], str]:
    """Outputs to draw, and a line of text on those that stay as they are."""
    sources = {each.attrs.get("fed_by", "") for each in columns.data_vars.values()}
    outputs = [name for name, each in columns.data_vars.items() if _is_output(each)]
    ordered = sorted(outputs, key=lambda name: columns[name].attrs["long_name"] not in sources)
    noise = [name for name in ordered if is_rounding(columns, name)]
    flat = [name for name in ordered if name not in noise and _is_flat(columns[name].values)]
    # a figure of nothing at all would be less than one of something flat
    shown = [name for name in ordered if name not in (*flat, *noise)] or ordered[:1]
    constant = "; ".join(_constant(columns, name) for name in flat if name not in shown)
    rounding = ", ".join(name for name in noise if name not in shown)
    said = f"Not drawn, as they do not change: {constant}." if constant else ""
    if rounding:
        said = f"{said} Not drawn, as they are 0 but for rounding: {rounding}.".strip()
    return shown, said


def _is_output(column: Column) -> bool:
    return column.attrs.get("causality") == "output"


def _is_flat(values: NDArray[np.float64]) -> bool:
    return bool(np.ptp(values) <= NOTHING * np.max(np.abs(values)))


def _constant(columns: Columns, name: str) -> str:
    value, unit = float(columns[name].values[-1]), columns[name].attrs["units"]
    return f"{name} {number(value)} {'' if unit == NO_UNIT else unit_text(unit)}".strip()


def _energy(time: NDArray[np.float64], ledger: Ledger) -> TimeFigure:
    """Handed over and taken up, and what is between; its rounding is no energy in transit."""
    handed, transit = [], []
    for place, flow in enumerate(ledger.flows):
        name, colour = str(flow.connection), SERIES[place % len(SERIES)]
        handed.append(Curve(name, flow.handed, colour))
        handed.append(Curve(f"{name}, taken up", flow.taken, INK, dash=True, width=0.8))
        transit.append(Curve(name, flow.in_transit, colour))
    most = max(float(np.max(np.abs(flow.handed), initial=0.0)) for flow in ledger.flows)
    below = Panel("in transit [J]", transit, span=NOTHING * most)
    return TimeFigure(time, [Panel("handed over [J]", handed), below])


def _steps(columns: Columns, start: float) -> TimeFigure:
    """Step size over time, on a logarithmic scale where the steps differ much."""
    sizes = columns["macro_step"].values
    differ = bool(sizes.max() > 5.0 * sizes.min())
    edges, curve = np.append(start, columns["step_time"].values), np.append(sizes[:1], sizes)
    shown = [Curve("macro step", curve, BLUE, steps=True)]
    panel = Panel("macro step [s]", shown, logarithmic=differ, from_zero=not differ)
    return TimeFigure(edges, [panel])
