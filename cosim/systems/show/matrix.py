"""A figure of a system of many units: who feeds whom, a line and a column for each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from cosim.coupling import CoupledSystem
from cosim.report.palette import BLUE, GREY, INK, ORANGE, PALE_GREY, RED, SOFT_GREY
from cosim.report.style import clipped, picture
from cosim.systems.show.diagram import colour_of

#: Inches for a unit, and of the smallest and the largest sheet without its names.
EACH, SMALLEST, LARGEST = 0.13, 4.0, 16.0
#: Inches of a letter of a name, and around all.
LETTER, MARGIN, HEAD = 0.062, 0.35, 0.75
LONGEST_NAME = 24
#: Units of which every one has its name: of more, every second, third, ...
MOST_NAMES = int(LARGEST / EACH)


@picture(
    "system",
    "Who feeds whom: from the unit of a line to that of a column, both in the order in which they"
    " step. On white what a step hands on, on grey what it feeds back; where there are several"
    " connections, how many. The table below has each.",
)
def matrix(system: CoupledSystem, order: Sequence[str]) -> Figure:
    """A square for every pair of units that is connected."""
    count = len(order)
    side = min(max(EACH * count, SMALLEST), LARGEST)
    names = MARGIN + LETTER * min(max(map(len, order)), LONGEST_NAME)
    width, height = side + names + MARGIN, side + names + HEAD
    figure = Figure(figsize=(width, height))
    axes = figure.add_axes((names / width, MARGIN / height, side / width, side / height))
    axes.set(xlim=(-0.5, count - 0.5), ylim=(count - 0.5, -0.5))
    axes.grid(color=SOFT_GREY, linewidth=0.3)
    corners = [(-0.5, -0.5), (count - 0.5, count - 0.5), (-0.5, count - 0.5)]
    axes.fill(*zip(*corners, strict=True), color=PALE_GREY, zorder=0)
    _pairs(axes, system, order, 72.0 * side / count)
    _names(axes, order)
    fed_back = sum(
        order.index(each.sink.participant) <= order.index(each.source.participant)
        for each in system.connections
    )
    said = f"{count} units, {len(system.connections)} connections, {fed_back} of them fed back"
    figure.text(MARGIN / width, 1.0 - 0.2 / height, said, va="top", color=INK, weight="bold")
    marks = [
        Line2D([], [], marker="s", linestyle="", color=colour, label=label)
        for colour, label in ((RED, "energy"), (ORANGE, "power"), (BLUE, "all else"))
    ]
    place = (MARGIN / width - 0.01, 1.0 - 0.36 / height)
    figure.legend(handles=marks, loc="upper left", ncols=3, fontsize=8, bbox_to_anchor=place)
    return figure


def _pairs(axes: Axes, system: CoupledSystem, order: Sequence[str], points: float) -> None:
    """A square of a size (points) for each pair, in the colour of what weighs most in it."""
    place = {name: number for number, name in enumerate(order)}
    counts: Counter[tuple[int, int]] = Counter()
    colours: dict[tuple[int, int], str] = {}
    for each in system.connections:
        pair = place[each.sink.participant], place[each.source.participant]
        counts[pair] += 1
        colour = colour_of(system, each)
        colours[pair] = colour if colour in (RED, ORANGE) else colours.get(pair, BLUE)
    square: dict[str, Any] = {"ms": 0.85 * points, "ls": "", "mew": 0.0}
    several: dict[str, Any] = {"ha": "center", "va": "center_baseline", "color": "white"}
    for (x, y), number in counts.items():
        axes.plot([x], [y], "s", color=colours[x, y], **square)
        if number > 1:
            axes.text(x, y, str(number), fontsize=min(0.7 * points, 8.0), **several)


def _names(axes: Axes, order: Sequence[str]) -> None:
    every = -(-len(order) // MOST_NAMES)
    ticks = range(0, len(order), every)
    labels = [clipped(order[number], LONGEST_NAME) for number in ticks]
    axes.xaxis.tick_top()
    axes.set_xticks(ticks, labels, rotation=90, fontsize=7)
    axes.set_yticks(ticks, labels, fontsize=7)
    axes.tick_params(length=2.0, color=GREY)
    for spine in axes.spines.values():
        spine.set_visible(False)
