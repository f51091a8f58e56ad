"""A figure that was drawn, made alive by what stands on its axes.

Curves with times of their own, as of several models, then share an axis.
"""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from .live import Curve, Live, Panel, Series, TimeFigure, panels_on_one_axis, several


def live_of(figure: Figure) -> Live:
    """What is drawn over time, axes by axes; axes without a title are panels below the one above.

    Broken lines over the whole width are levels, upright ones marks. A curve without a label has
    that of its colour elsewhere in the figure, else of its axis.
    """
    labels = _labels(figure)
    rows = {round(axes.get_position().y0, 6): axes.get_ylabel() for axes in reversed(figure.axes)}
    found: dict[str, list[Axes]] = {}
    for axes in sorted(figure.axes, key=lambda each: each.get_position().x0):
        title = axes.get_title() or axes.get_title(loc="left") or axes.get_title(loc="right")
        key = title or next(reversed(found), "")
        found.setdefault(key, []).append(axes)
    return several({title: _figure(group, labels, rows) for title, group in found.items()})


def _figure(group: Sequence[Axes], labels: dict[str, str], rows: dict[float, str]) -> Live:
    """Axes below each other as panels."""
    panels = []
    for axes in group:
        label = axes.get_ylabel() or rows[round(axes.get_position().y0, 6)]
        own = [_series(line, labels, label) for line in axes.lines if _is_curve(axes, line)]
        panels.append((Panel(label, [], levels=_straight(axes)), own))
    seen = panels_on_one_axis(panels, group[0].get_xlim())
    return TimeFigure(*seen, marks=_straight(group[0], upright=True)).live()


def _is_curve(axes: Axes, line: Line2D) -> bool:
    return line.get_transform() == axes.transData


def _series(line: Line2D, labels: dict[str, str], axis: str) -> Series:
    colour = to_hex(line.get_color())
    own = str(line.get_label())
    label = labels.get(colour, axis.partition(" [")[0]) if own[:1] == "_" else own
    time, values = (np.asarray(each, float) for each in line.get_data())
    dots = line.get_linestyle() in ("None", "", " ")
    dash = line.get_linestyle() == "--"
    width = min(float(line.get_linewidth()), 2.5)
    return Series(time, Curve(label, values, colour, dots=dots, dash=dash, width=width))


def _labels(figure: Figure) -> dict[str, str]:
    """Colour -> what it stands for, of the lines that say so."""
    return {
        to_hex(line.get_color()): str(line.get_label())
        for axes in figure.axes
        for line in reversed(axes.lines)
        if not str(line.get_label()).startswith("_") and _is_curve(axes, line)
    }


def _straight(axes: Axes, upright: bool = False) -> list[tuple[float, str]]:
    """Where lines over the whole width are, or over the whole height, and what they are called."""
    across = axes.get_xaxis_transform if upright else axes.get_yaxis_transform
    lines = [line for line in axes.lines if line.get_transform() == across(which="grid")]
    return [(float(np.asarray(line.get_data()[not upright])[0]), _named(line)) for line in lines]


def _named(line: Line2D) -> str:
    label = str(line.get_label())
    return "" if label.startswith("_") else label
