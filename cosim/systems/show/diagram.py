"""A figure of a system: units as boxes with their ports; of many, who feeds whom as a matrix."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import FancyBboxPatch, PathPatch
from matplotlib.path import Path

from cosim.coupling import Causality, Connection, CoupledSystem
from cosim.coupling.conversion import NO_UNIT, watts
from cosim.coupling.system import ENERGY_UNIT, find_port
from cosim.report.page import unit_text
from cosim.report.palette import BLUE, GREY, INK, ORANGE, PALE_GREY, RED, SERIES, SOFT_GREY
from cosim.report.style import clipped, picture

#: Inches: of a line of ports, of a box's head, between boxes, between columns, around all.
LINE, HEAD, BETWEEN, GAP, MARGIN = 0.24, 0.42, 0.45, 1.9, 0.35
#: Inches between lanes of lines that go around, from a box to the first such line, to the next; so
#: many are told apart beside a box.
LANE, ASIDE, SHIFT, LANES = 0.2, 0.16, 0.07, 10
#: Inches of a letter, and of the narrowest and the widest box.
LETTER, NARROW, WIDE = 0.075, 1.5, 3.6
#: Units and columns of them that a page shows legibly: more are for `matrix`.
MOST_BOXES, MOST_COLUMNS = 24, 8
#: Ports that nothing is connected to are counted, not drawn; letters of a name that are.
LONGEST_NAME = 26


@dataclass
class Box:
    """A unit on the sheet, inches, y downwards from the top: its corner, size and ports."""

    name: str
    inputs: list[str]
    outputs: list[str]
    note: str
    x: float = 0.0
    y: float = 0.0
    width: float = NARROW
    height: float = 0.0
    places: dict[str, float] = field(default_factory=dict)


@picture(
    "system",
    "Units with the ports that are connected, from left to right in the order in which they step."
    " What feeds back runs below, what passes by other units above. At a line: what the value goes"
    " through, where it is converted or scaled.",
)
def diagram(system: CoupledSystem, order: Sequence[str]) -> Figure:
    """Units from left to right as values go through them in the order in which they step."""
    boxes = _boxes(system)
    columns = _columns(system, order)
    rank = {name: number for number, names in enumerate(columns) for name in names}
    spans = {
        each: rank[each.sink.participant] - rank[each.source.participant]
        for each in system.connections
    }
    back = [each for each, span in spans.items() if span <= 0]
    over = [each for each, span in spans.items() if span > 1]
    aside = ASIDE + SHIFT * min(max(len(back), len(over)), LANES) if back or over else 0.0
    width, lowest = _place(boxes, columns, MARGIN + aside, MARGIN + LANE * len(over))
    width, height = max(width + aside, 5.0), max(lowest + LANE * len(back), 1.8)
    figure = Figure(figsize=(width, height))
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, width), ylim=(height, 0.0))
    axes.axis("off")
    sheet = _Sheet(axes, system, boxes)
    for number, each in enumerate(back):
        sheet.around(each, lowest - 0.14 + LANE * number, number)
    for number, each in enumerate(over):
        sheet.around(each, MARGIN + LANE * (number - 0.5), number)
    for each in system.connections:
        if spans[each] == 1:
            sheet.forth(each)
    for box in boxes.values():
        sheet.box(box)
    return figure


def colour_key(system: CoupledSystem) -> str:
    """What the colours of energy and power stand for, as far as the system has any."""
    kinds = {RED: "dark orange and thick: energy", ORANGE: "light orange and thick: power"}
    colours = {colour_of(system, each) for each in system.connections}
    told = [words for colour, words in kinds.items() if colour in colours]
    return f" {', '.join(told).capitalize()}." if told else ""


def is_legible(system: CoupledSystem, order: Sequence[str]) -> bool:
    """Whether the system is small enough for boxes with their ports."""
    return len(order) <= MOST_BOXES and len(_columns(system, order)) <= MOST_COLUMNS


def _boxes(system: CoupledSystem) -> dict[str, Box]:
    found = {}
    for name, participant in system.participants.items():
        fed = [each.sink.port for each in system.connections if each.sink.participant == name]
        sent = [each.source.port for each in system.connections if each.source.participant == name]
        kinds = [port.causality for port in participant.ports.values()]
        outputs = list(dict.fromkeys(sent))
        free = {
            "input": kinds.count(Causality.INPUT) - len(fed),
            "output": kinds.count(Causality.OUTPUT) - len(outputs),
        }
        found[name] = Box(name, fed, outputs, _counted(free))
    return found


def _counted(free: Mapping[str, int]) -> str:
    """Ports that nothing is connected to, in words."""
    parts = [f"{count} {word}{'s' * (count > 1)}" for word, count in free.items() if count]
    return f"also {' and '.join(parts)}" if parts else ""


def _columns(system: CoupledSystem, order: Sequence[str]) -> list[list[str]]:
    """Units column by column: each to the right of those before it in the order that feed it."""
    rank = {name: number for number, name in enumerate(order)}
    column: dict[str, int] = {}
    for name in order:
        before = [
            column[each.source.participant]
            for each in system.connections
            if each.sink.participant == name and rank[each.source.participant] < rank[name]
        ]
        column[name] = 1 + max(before, default=-1)
    return [
        [name for name in order if column[name] == number]
        for number in range(1 + max(column.values()))
    ]


def _place(
    boxes: Mapping[str, Box], columns: Sequence[Sequence[str]], left: float, top: float
) -> tuple[float, float]:
    """Give each box its place and size; right and lowest end of all, with margins, inches."""
    x, lowest = left, 0.0
    for names in columns:
        column = [boxes[name] for name in names]
        width = max(_width(box) for box in column)
        y = top
        for box in column:
            lines = max(len(box.inputs), len(box.outputs))
            box.x, box.y, box.width = x, y, width
            box.height = HEAD + LINE * lines + (LINE if box.note else 0.08)
            for ports in (box.inputs, box.outputs):
                for number, port in enumerate(ports):
                    box.places[port] = y + HEAD + LINE * (number + 0.5)
            y += box.height + BETWEEN
        lowest = max(lowest, y - BETWEEN)
        x += width + GAP
    return x - GAP + MARGIN, lowest + MARGIN


def _width(box: Box) -> float:
    sides = (
        max((len(clipped(port, LONGEST_NAME)) + 7 for port in ports), default=0)
        for ports in (box.inputs, box.outputs)
    )
    letters = max(sum(sides), len(box.name) + 4, len(box.note) + 2)
    return min(max(LETTER * letters, NARROW), 2 * WIDE)


class _Sheet:
    """What a system is drawn on."""

    def __init__(self, axes: Axes, system: CoupledSystem, boxes: Mapping[str, Box]) -> None:
        self._axes, self._system, self._boxes = axes, system, boxes

    def forth(self, connection: Connection) -> None:
        """A line to the next column."""
        x1, y1, x2, y2 = self._ends(connection)
        reach = 0.5 * (x2 - x1)
        points = [(x1, y1), (x1 + reach, y1), (x2 - reach, y2), (x2, y2)]
        self._line(connection, points, Path.CURVE4, (x2 - 0.12, y2 - 0.04, "right"))

    def around(self, connection: Connection, lane: float, number: int) -> None:
        """Out to the right, along a lane below or above all boxes, and in from the left."""
        x1, y1, x2, y2 = self._ends(connection)
        aside = ASIDE + SHIFT * (number % LANES)
        points = [
            *((x1, y1), (x1 + aside, y1), (x1 + aside, lane)),
            *((x2 - aside, lane), (x2 - aside, y2), (x2, y2)),
        ]
        label = (0.5 * (x1 + x2), lane - 0.02, "center")
        self._line(connection, points, Path.LINETO, label)

    def box(self, box: Box) -> None:
        """A unit with its ports."""
        corner, round_ = (box.x, box.y), "round,pad=0,rounding_size=0.08"
        look: Any = {"facecolor": PALE_GREY, "edgecolor": GREY, "linewidth": 1.0, "zorder": 3}
        self._axes.add_patch(FancyBboxPatch(corner, box.width, box.height, boxstyle=round_, **look))
        middle = box.x + 0.5 * box.width
        self._text(middle, box.y + 0.22, box.name, 10, weight="bold")
        ports = self._system.participants[box.name].ports
        for names, x, align in (
            (box.inputs, box.x + 0.08, "left"),
            (box.outputs, box.x + box.width - 0.08, "right"),
        ):
            for name in names:
                unit = ports[name].unit
                said = "" if unit == NO_UNIT else f" [{unit_text(unit)}]"
                self._text(x, box.places[name], clipped(name, LONGEST_NAME) + said, 8, ha=align)
        if box.note:
            self._text(middle, box.y + box.height - 0.13, box.note, 7.5, color=GREY)

    def _text(self, x: float, y: float, words: str, size: float, **look: Any) -> None:
        usual: Any = {"ha": "center", "va": "center", "color": INK, "zorder": 5}
        self._axes.text(x, y, words, fontsize=size, **usual | look)

    def _ends(self, connection: Connection) -> tuple[float, float, float, float]:
        source = self._boxes[connection.source.participant]
        sink = self._boxes[connection.sink.participant]
        start, end = source.places[connection.source.port], sink.places[connection.sink.port]
        return source.x + source.width, start, sink.x, end

    def _line(
        self,
        connection: Connection,
        points: Sequence[tuple[float, float]],
        code: Any,
        label: tuple[float, float, str],
    ) -> None:
        """A line of a kind, with an arrow, and how the value is changed on its way, where it is.

        label: x, y and alignment.
        """
        colour, affine = colour_of(self._system, connection), self._system.conversions[connection]
        path = Path(points, [Path.MOVETO, *[code] * (len(points) - 1)])
        look: Any = {"facecolor": "none", "edgecolor": colour, "zorder": 1}
        width = 2.4 if colour in (RED, ORANGE) else 1.2
        self._axes.add_patch(PathPatch(path, linewidth=width, **look))
        x, y = points[-1]
        corners = [x, x - 0.09, x - 0.09], [y, y - 0.045, y + 0.045]
        self._axes.fill(*corners, color=colour, zorder=2)
        if not affine.is_identity:
            paper = {"facecolor": "white", "edgecolor": "none", "pad": 0.8}
            x, y, align = label
            self._text(x, y, str(affine), 7.5, ha=align, va="bottom", bbox=paper, zorder=4)


def colour_of(system: CoupledSystem, connection: Connection) -> str:
    """Red for energy, orange for power in any unit; else that of the unit it comes from."""
    source = find_port(system.participants, connection.source)
    if source.unit == ENERGY_UNIT or watts(source) is not None:
        return RED if source.unit == ENERGY_UNIT else ORANGE
    others = [each for each in SERIES if each not in (RED, ORANGE)]
    names = list(system.participants)
    return others[names.index(connection.source.participant) % len(others)]


#: Inches for a unit, and of the smallest and the largest sheet without its names.
EACH, SMALLEST, LARGEST = 0.13, 4.0, 16.0
#: Inches of a letter of a name, and around all.
NAME_LETTER, EDGE, TITLE = 0.062, 0.35, 0.75
LONGEST_LABEL = 24
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
    names = EDGE + NAME_LETTER * min(max(map(len, order)), LONGEST_LABEL)
    width, height = side + names + EDGE, side + names + TITLE
    figure = Figure(figsize=(width, height))
    axes = figure.add_axes((names / width, EDGE / height, side / width, side / height))
    axes.set(xlim=(-0.5, count - 0.5), ylim=(count - 0.5, -0.5))
    axes.grid(color=SOFT_GREY, linewidth=0.3)
    corners = [(-0.5, -0.5), (count - 0.5, count - 0.5), (-0.5, count - 0.5)]
    axes.fill(*zip(*corners, strict=True), color=PALE_GREY, zorder=0)
    _pairs(axes, system, order, 72.0 * side / count)
    _labels(axes, order)
    fed_back = sum(
        order.index(each.sink.participant) <= order.index(each.source.participant)
        for each in system.connections
    )
    said = f"{count} units, {len(system.connections)} connections, {fed_back} of them fed back"
    figure.text(EDGE / width, 1.0 - 0.2 / height, said, va="top", color=INK, weight="bold")
    marks = [
        Line2D([], [], marker="s", linestyle="", color=colour, label=label)
        for colour, label in ((RED, "energy"), (ORANGE, "power"), (BLUE, "all else"))
    ]
    place = (EDGE / width - 0.01, 1.0 - 0.36 / height)
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


def _labels(axes: Axes, order: Sequence[str]) -> None:
    every = -(-len(order) // MOST_NAMES)
    ticks = range(0, len(order), every)
    labels = [clipped(order[number], LONGEST_LABEL) for number in ticks]
    axes.xaxis.tick_top()
    axes.set_xticks(ticks, labels, rotation=90, fontsize=7)
    axes.set_yticks(ticks, labels, fontsize=7)
    axes.tick_params(length=2.0, color=GREY)
    for spine in axes.spines.values():
        spine.set_visible(False)
