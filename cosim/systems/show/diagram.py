"""A figure of a system: units as boxes with their ports, and what connects them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch, PathPatch
from matplotlib.path import Path

from cosim.coupling import Causality, Connection, CoupledSystem
from cosim.coupling.conversion import NO_UNIT, watts
from cosim.coupling.system import ENERGY_UNIT, find_port
from cosim.report.page import unit_text
from cosim.report.palette import GREY, INK, ORANGE, PALE_GREY, RED, SERIES
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
    for number, each in enumerate(back):
        _draw_around(axes, system, boxes, each, lowest - 0.14 + LANE * number, number)
    for number, each in enumerate(over):
        _draw_around(axes, system, boxes, each, MARGIN + LANE * (number - 0.5), number)
    for each in system.connections:
        if spans[each] == 1:
            _draw_forth(axes, system, boxes, each)
    for box in boxes.values():
        _draw_box(axes, system, box)
    return figure


def colour_key(system: CoupledSystem) -> str:
    """What the colours of energy and power stand for, as far as the system has any."""
    colours = {_colour(system, each) for each in system.connections}
    told = [
        f"{words} and thick: {what}"
        for colour, words, what in (
            (RED, "dark orange", "energy"),
            (ORANGE, "light orange", "power"),
        )
        if colour in colours
    ]
    return f" {', '.join(told).capitalize()}." if told else ""


def is_legible(system: CoupledSystem, order: Sequence[str]) -> bool:
    """Whether the system is small enough for boxes with their ports."""
    return len(order) <= MOST_BOXES and len(_columns(system, order)) <= MOST_COLUMNS


def _boxes(system: CoupledSystem) -> dict[str, Box]:
    found = {}
    for name, participant in system.participants.items():
        fed = [each.sink.port for each in system.connections if each.sink.participant == name]
        sent = [each.source.port for each in system.connections if each.source.participant == name]
        ports = participant.ports.values()
        kinds = [port.causality for port in ports]
        outputs = list(dict.fromkeys(sent))
        free = (
            kinds.count(Causality.INPUT) - len(fed),
            kinds.count(Causality.OUTPUT) - len(outputs),
        )
        found[name] = Box(name, fed, outputs, _counted(*free))
    return found


def _counted(inputs: int, outputs: int) -> str:
    """Ports that nothing is connected to, in words."""
    parts = [
        f"{count} {word}{'s' * (count > 1)}"
        for count, word in ((inputs, "input"), (outputs, "output"))
        if count
    ]
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


def _ends(boxes: Mapping[str, Box], connection: Connection) -> tuple[float, float, float, float]:
    source, sink = boxes[connection.source.participant], boxes[connection.sink.participant]
    return (
        source.x + source.width,
        source.places[connection.source.port],
        sink.x,
        sink.places[connection.sink.port],
    )


def _draw_forth(
    axes: Axes, system: CoupledSystem, boxes: Mapping[str, Box], connection: Connection
) -> None:
    x1, y1, x2, y2 = _ends(boxes, connection)
    reach = 0.5 * (x2 - x1)
    points = [(x1, y1), (x1 + reach, y1), (x2 - reach, y2), (x2, y2)]
    _draw_line(axes, system, connection, points, Path.CURVE4, (x2 - 0.12, y2 - 0.04, "right"))


def _draw_around(
    axes: Axes,
    system: CoupledSystem,
    boxes: Mapping[str, Box],
    connection: Connection,
    lane: float,
    number: int,
) -> None:
    """Out to the right, along a lane below or above all boxes, and in from the left."""
    x1, y1, x2, y2 = _ends(boxes, connection)
    aside = ASIDE + SHIFT * (number % LANES)
    points = [
        *((x1, y1), (x1 + aside, y1), (x1 + aside, lane)),
        *((x2 - aside, lane), (x2 - aside, y2), (x2, y2)),
    ]
    label = (0.5 * (x1 + x2), lane - 0.02, "center")
    _draw_line(axes, system, connection, points, Path.LINETO, label)


def _draw_line(
    axes: Axes,
    system: CoupledSystem,
    connection: Connection,
    points: Sequence[tuple[float, float]],
    code: Any,
    label: tuple[float, float, str],
) -> None:
    """A line of a kind, with an arrow, and how the value is changed on its way, where it is.

    label: x, y and alignment.
    """
    colour, affine = _colour(system, connection), system.conversions[connection]
    path = Path(points, [Path.MOVETO, *[code] * (len(points) - 1)])
    width = 2.4 if colour in (RED, ORANGE) else 1.2
    axes.add_patch(PathPatch(path, facecolor="none", edgecolor=colour, linewidth=width, zorder=1))
    x, y = points[-1]
    axes.fill([x, x - 0.09, x - 0.09], [y, y - 0.045, y + 0.045], color=colour, zorder=2)
    if not affine.is_identity:
        axes.text(
            *label[:2], str(affine), ha=label[2], va="bottom", fontsize=7.5, color=INK,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8}, zorder=4,
        )  # fmt: skip


def _colour(system: CoupledSystem, connection: Connection) -> str:
    source = find_port(system.participants, connection.source)
    if source.unit == ENERGY_UNIT or watts(source) is not None:
        return RED if source.unit == ENERGY_UNIT else ORANGE
    others = [each for each in SERIES if each not in (RED, ORANGE)]
    names = list(system.participants)
    return others[names.index(connection.source.participant) % len(others)]


def _draw_box(axes: Axes, system: CoupledSystem, box: Box) -> None:
    axes.add_patch(
        FancyBboxPatch(
            (box.x, box.y), box.width, box.height, boxstyle="round,pad=0,rounding_size=0.08",
            facecolor=PALE_GREY, edgecolor=GREY, linewidth=1.0, zorder=3,
        )
    )  # fmt: skip
    middle = box.x + 0.5 * box.width
    axes.text(
        middle, box.y + 0.22, box.name, ha="center", va="center", weight="bold", fontsize=10,
        color=INK, zorder=5,
    )  # fmt: skip
    for ports, x, align in (
        (box.inputs, box.x + 0.08, "left"),
        (box.outputs, box.x + box.width - 0.08, "right"),
    ):
        for port in ports:
            unit = system.participants[box.name].ports[port].unit
            words = clipped(port, LONGEST_NAME) + (
                "" if unit == NO_UNIT else f" [{unit_text(unit)}]"
            )
            axes.text(
                x, box.places[port], words, ha=align, va="center", fontsize=8, color=INK, zorder=5,
            )  # fmt: skip
    if box.note:
        axes.text(
            middle, box.y + box.height - 0.13, box.note, ha="center", va="center", fontsize=7.5,
            color=GREY, zorder=5,
        )  # fmt: skip
