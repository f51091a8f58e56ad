"""The answer as one self-contained HTML page, and its picture as a file."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from cosim.files import write_bytes, write_text
from cosim.gap.plan import data
from cosim.gap.plan.plan import Plan
from cosim.report.page import render
from cosim.report.style import BLUE, INK, ORANGE, RED, logarithmic_x, panels, picture


def write_page(plan: Plan, folder: Path, file: Path) -> None:
    """The picture into the folder, and the page with it inside."""
    drawn = draw_sizes(plan)
    write_bytes(drawn.png, folder / f"{drawn.name}.png")
    text = render(
        "plan.html.j2", "cosim.gap.plan", plan=plan, campaign=plan.planned.campaign, data=data,
        picture=drawn,
    )  # fmt: skip
    write_text(text, file)


@picture("smallest_sizes", (
    "The smallest size of each effect that would be named, in percent of friction by which it lets "
    "friction differ within these runs (a ripple: of the surface's speed). Blue: by itself or in a "
    "class with others; orange: by itself. At the end of each bar, that size in its own unit."
))  # fmt: skip
def draw_sizes(plan: Plan) -> Figure:
    """A row for each effect and direction."""
    sizes = plan.sizes
    figure, axes = panels(1, 1, height=1.2 + 0.42 * max(len(sizes), 1), width=9.0)
    axis = axes[0, 0]
    label: dict[str, Any] = {"va": "center", "fontsize": 8.5}
    ends = [(size, end) for size in sizes for end in (size.value, size.alone)]
    every = [size.law.percent(end) for size, end in ends if end is not None]
    left, right = 0.5 * min(every, default=1.0), 4.0 * max(every, default=1.0)
    for place, size in enumerate(sizes):
        if size.percent is None:
            axis.text(1.1 * left, place, "not seen, whatever its size", va="center", color=RED)
            continue
        alone = math.inf if size.alone is None else size.law.percent(size.alone)
        axis.barh(place, size.percent - left, left=left, height=0.36, color=BLUE)
        if 1.3 * size.percent < alone < math.inf:
            axis.barh(place + 0.3, alone - left, left=left, height=0.2, color=ORANGE)
            text = data.value_text(size.alone, size)
            axis.text(1.05 * alone, place + 0.32, text, color=INK, **label)
        never = "" if math.isfinite(alone) else "  (never by itself)"
        text = data.value_text(size.value, size) + never
        axis.text(1.05 * size.percent, place - 0.02, text, **label)
    logarithmic_x(axis)
    axis.set_xlim(left, right)
    axis.set_yticks(range(len(sizes)), [_name(size) for size in sizes])
    axis.set_ylim(len(sizes) - 0.4, -0.6)
    axis.grid(visible=False, axis="y")
    axis.set_xlabel("smallest size, percent of friction")
    for what, colour in (("named", BLUE), ("named by itself", ORANGE)):
        axis.barh([0], [0], color=colour, label=what)
    figure.legend(loc="outside upper right", ncols=2)
    return figure


def _name(size: data.Size) -> str:
    """Its parameter, and of a wave its length."""
    return f"{size.law.key}, {size.law.unknown.variant}" if size.law.wave else size.law.key
