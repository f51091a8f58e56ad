"""A system as an N2 chart: units on the diagonal, and what one gives to another where the row of
the one meets the column of the other."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from cosim.coupling import Causality, Connection, CoupledSystem
from cosim.coupling.conversion import NO_UNIT, watts
from cosim.coupling.system import ENERGY_UNIT, find_port
from cosim.report.page import unit_text
from cosim.report.palette import BLUE, GREY, INK, ORANGE, PALE_GREY, RED, SOFT_GREY
from cosim.report.style import clipped, picture

#: Units that have room for words in their cells: of more, a square says that there is something.
MOST_IN_WORDS = 10
#: Inches of a line of words, of a letter, around the words, between cells, and around all.
LINE, LETTER, ASIDE, BETWEEN, MARGIN = 0.19, 0.078, 0.14, 0.05, 0.3
#: Inches of a cell without words, and of all such at most; of a name beside them.
EACH, SMALLEST, LARGEST, NAME_LETTER = 0.13, 4.0, 16.0, 0.062
#: Letters of a name; points of a square's number.
LONGEST_NAME, NUMBER = 26, 8.0

Lines = Mapping[tuple[int, int], Sequence[str]]


@picture(
    "system",
    "Units on the diagonal, in the order in which they step. In the row of a unit and the column of"
    " another: what the one gives to the other, to the right of the diagonal within a step, to the"
    " left of it fed back; of many units, how many connections, where there are several. Dark"
    " orange: energy, light orange: power, blue: all else. The table below has each.",
)
def chart(system: CoupledSystem, order: Sequence[str]) -> Figure:
    """Who gives what to whom."""
    place = {name: number for number, name in enumerate(order)}
    cells: dict[tuple[int, int], list[Connection]] = {}
    for each in system.connections:
        pair = place[each.source.participant], place[each.sink.participant]
        cells.setdefault(pair, []).append(each)
    in_words = len(order) <= MOST_IN_WORDS
    lines = {pair: _lines(system, some, in_words) for pair, some in cells.items()}
    units = {(n, n): _unit(system, name) for name, n in place.items()} if in_words else {}
    widths, heights = _sizes(len(order), {**lines, **units} if in_words else {})
    names = MARGIN + (0.0 if in_words else NAME_LETTER * min(max(map(len, order)), LONGEST_NAME))
    size = np.array([widths.sum(), heights.sum()]) + names + MARGIN
    figure = Figure(figsize=tuple(size))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(-names, size[0] - names), ylim=(size[1] - names, -names))
    axes.axis("off")
    corners = [np.cumsum(each) - each for each in (widths, heights)]
    for row, column in {(n, n) for n in place.values()} | set(cells):
        corner = corners[0][column], corners[1][row]
        room = Rectangle(corner, widths[column], heights[row])
        if (row, column) in cells:
            colour, told = _colour(system, cells[row, column]), lines[row, column]
            _cell(axes, room, told, edgecolor=colour, facecolor="white" if in_words else colour)
        else:
            _cell(axes, room, units.get((row, column), ()), edgecolor=GREY, facecolor=PALE_GREY)
    if not in_words:
        _names(axes, order, float(widths[0]))
    return figure


def _lines(system: CoupledSystem, connections: Sequence[Connection], in_words: bool) -> list[str]:
    """What stands in a cell: each value, what it is there, and how it is changed on its way."""
    if not in_words:
        return [str(len(connections))] if len(connections) > 1 else []
    found = []
    for each in connections:
        unit, affine = find_port(system.participants, each.source).unit, system.conversions[each]
        ends = dict.fromkeys(clipped(end.port, LONGEST_NAME) for end in (each.source, each.sink))
        told = " → ".join(ends) + ("" if unit == NO_UNIT else f" [{unit_text(unit)}]")
        found.append(told if affine.is_identity else f"{told}, {affine}")
    return found


def _unit(system: CoupledSystem, name: str) -> list[str]:
    """What stands in a unit's cell: its name, and ports that nothing is connected to, in words."""
    ends = {end for each in system.connections for end in (each.source, each.sink)}
    joined = {end.port for end in ends if end.participant == name}
    ports = system.participants[name].ports.values()
    free = [port.causality for port in ports if port.name not in joined]
    counts = {kind: free.count(kind) for kind in Causality}
    parts = [f"{count} {kind}{'s' * (count > 1)}" for kind, count in counts.items() if count]
    return [clipped(name, LONGEST_NAME), *([f"also {' and '.join(parts)}"] if parts else [])]


def _colour(system: CoupledSystem, connections: Sequence[Connection]) -> str:
    """Of what weighs most among some: energy, power in any unit, all else."""
    sources = [find_port(system.participants, each.source) for each in connections]
    if any(source.unit == ENERGY_UNIT for source in sources):
        return RED
    return ORANGE if any(watts(source) is not None for source in sources) else BLUE


def _sizes(count: int, lines: Lines) -> tuple[np.ndarray, np.ndarray]:
    """Widths of columns and heights of rows, (count,) inches each: their words, or all alike."""
    side = min(max(EACH * count, SMALLEST), LARGEST) / count
    widths, heights = (np.full(count, 0.0 if lines else side) for _ in range(2))
    for (row, column), told in lines.items():
        widths[column] = max(widths[column], 2.0 * ASIDE + LETTER * max(map(len, told)))
        heights[row] = max(heights[row], 2.0 * ASIDE + LINE * len(told))
    return widths, heights


def _cell(axes: Axes, room: Rectangle, told: Sequence[str], **look: Any) -> None:
    """A box in its room, with lines of words in its middle: of a unit, the first is its name."""
    (x, y), width, height = room.get_xy(), room.get_width(), room.get_height()
    between = min(BETWEEN, 0.1 * width)
    size = width - 2.0 * between, height - 2.0 * between
    axes.add_patch(Rectangle((x + between, y + between), *size, linewidth=1.4, **look))
    is_unit, is_square = look["facecolor"] == PALE_GREY, look["facecolor"] == look["edgecolor"]
    how: Any = {"ha": "center", "va": "center", "color": "white" if is_square else INK}
    for number, line in enumerate(told):
        down = y + 0.5 * height + LINE * (number - 0.5 * (len(told) - 1))
        how["weight"] = "bold" if is_unit and number == 0 else "normal"
        points = min(50.0 * width, NUMBER) if is_square else NUMBER
        axes.text(x + 0.5 * width, down, line, fontsize=points, **how)


def _names(axes: Axes, order: Sequence[str], side: float) -> None:
    """Beside and above squares of a side, inches; of very many, every second, third, ..."""
    every = -(-len(order) // int(LARGEST / EACH))
    look: Any = {"fontsize": 7, "color": INK}
    for number in range(0, len(order), every):
        name, middle = clipped(order[number], LONGEST_NAME), side * (number + 0.5)
        axes.text(-0.05, middle, name, ha="right", va="center", **look)
        axes.text(middle, -0.05, name, ha="center", va="bottom", rotation=90, **look)
        axes.axhline(middle, color=SOFT_GREY, linewidth=0.3, zorder=0)
        axes.axvline(middle, color=SOFT_GREY, linewidth=0.3, zorder=0)
