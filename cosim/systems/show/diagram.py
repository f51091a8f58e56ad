"""A system as an N2 chart: units on the diagonal, and what one gives to another where the row of
the one meets the column of the other."""

from collections.abc import Sequence
from typing import Any, NamedTuple

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


class Cell(NamedTuple):
    """Lines of words in a box: of a unit, the first is its name."""

    lines: Sequence[str]
    edge: str
    face: str


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
    across: dict[tuple[int, int], list[Connection]] = {}
    for each in system.connections:
        pair = place[each.source.participant], place[each.sink.participant]
        across.setdefault(pair, []).append(each)
    count, in_words = len(order), len(order) <= MOST_IN_WORDS
    told = _in_words if in_words else _in_a_square
    cells = {
        **{(n, n): _unit(system, name, in_words) for name, n in place.items()},
        **{pair: told(system, some) for pair, some in across.items()},
    }
    side = min(max(EACH * count, SMALLEST), LARGEST) / count
    widths, heights = np.full((2, count), 0.0 if in_words else side)
    for (row, column), cell in cells.items() if in_words else ():
        widths[column] = max(widths[column], 2.0 * ASIDE + LETTER * max(map(len, cell.lines)))
        heights[row] = max(heights[row], 2.0 * ASIDE + LINE * len(cell.lines))
    names = MARGIN + (0.0 if in_words else NAME_LETTER * min(max(map(len, order)), LONGEST_NAME))
    size = np.array([widths.sum(), heights.sum()]) + names + MARGIN
    figure = Figure(figsize=tuple(size))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(-names, size[0] - names), ylim=(size[1] - names, -names))
    axes.axis("off")
    left, top = (np.cumsum(each) - each for each in (widths, heights))
    for (row, column), cell in cells.items():
        _draw(axes, cell, left[column], top[row], widths[column], heights[row])
    if not in_words:
        _names(axes, order, side)
    return figure


def _in_words(system: CoupledSystem, connections: Sequence[Connection]) -> Cell:
    """Each value, what it is there, and how it is changed on its way."""
    found = []
    for each in connections:
        unit, affine = find_port(system.participants, each.source).unit, system.conversions[each]
        ends = dict.fromkeys(clipped(end.port, LONGEST_NAME) for end in (each.source, each.sink))
        told = " → ".join(ends) + ("" if unit == NO_UNIT else f" [{unit_text(unit)}]")
        found.append(told if affine.is_identity else f"{told}, {affine}")
    return Cell(found, _colour(system, connections), "white")


def _in_a_square(system: CoupledSystem, connections: Sequence[Connection]) -> Cell:
    """How many there are, where there are several."""
    colour = _colour(system, connections)
    return Cell([str(len(connections))] if len(connections) > 1 else [], colour, colour)


def _unit(system: CoupledSystem, name: str, in_words: bool) -> Cell:
    """A unit's name, and ports that nothing is connected to, in words."""
    if not in_words:
        return Cell((), GREY, PALE_GREY)
    ends = {end for each in system.connections for end in (each.source, each.sink)}
    joined = {end.port for end in ends if end.participant == name}
    ports = system.participants[name].ports.values()
    free = [port.causality for port in ports if port.name not in joined]
    counts = {kind: free.count(kind) for kind in Causality}
    parts = [f"{count} {kind}{'s' * (count > 1)}" for kind, count in counts.items() if count]
    also = [f"also {' and '.join(parts)}"] if parts else []
    return Cell([clipped(name, LONGEST_NAME), *also], GREY, PALE_GREY)


def _colour(system: CoupledSystem, connections: Sequence[Connection]) -> str:
    """Of what weighs most among some: energy, power in any unit, all else."""
    sources = [find_port(system.participants, each.source) for each in connections]
    if any(source.unit == ENERGY_UNIT for source in sources):
        return RED
    return ORANGE if any(watts(source) is not None for source in sources) else BLUE


def _draw(axes: Axes, cell: Cell, x: float, y: float, width: float, height: float) -> None:
    """A box in its room, with its words in the middle."""
    between = min(BETWEEN, 0.1 * width)
    inside = (x + between, y + between), width - 2.0 * between, height - 2.0 * between
    axes.add_patch(Rectangle(*inside, linewidth=1.4, edgecolor=cell.edge, facecolor=cell.face))
    is_square = cell.face == cell.edge
    how: Any = {"ha": "center", "va": "center", "color": "white" if is_square else INK}
    how["fontsize"] = min(50.0 * width, NUMBER) if is_square else NUMBER
    for number, line in enumerate(cell.lines):
        down = y + 0.5 * height + LINE * (number - 0.5 * (len(cell.lines) - 1))
        is_name = cell.face == PALE_GREY and number == 0
        axes.text(x + 0.5 * width, down, line, weight="bold" if is_name else "normal", **how)


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
