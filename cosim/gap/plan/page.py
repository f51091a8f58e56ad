"""The answer as one self-contained HTML page, and its picture as a file."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from stickslip import EFFECTS
from stickslip.quantity import details

from cosim.files import write_bytes, write_text
from cosim.gap.plan import data
from cosim.gap.plan.plan import Plan
from cosim.gap.plan.sizes import Size
from cosim.report.page import Picture, number, render, unit_text
from cosim.report.palette import BLUE, ORANGE, RED
from cosim.report.style import logarithmic_x, panels, picture

#: Pairs on the first screens of the page; the rest is folded.
MOST_PAIRS = 6
#: By this factor a size by itself is larger where it has a bar of its own.
MORE = 1.3


def write_page(plan: Plan, folder: Path, file: Path) -> None:
    """The picture into the folder, and the page with it inside."""
    drawn = draw_sizes(plan)
    write_bytes(drawn.png, folder / f"{drawn.name}.png")
    write_text(page_text(plan, drawn), file)


def page_text(plan: Plan, drawn: Picture | None = None) -> str:
    """The page; drawn: its picture, where that has been drawn already."""
    drawn = draw_sizes(plan) if drawn is None else drawn
    return render(
        "plan.html.j2", "cosim.gap.plan", plan=plan, campaign=plan.planned.campaign, data=data,
        picture=drawn, tiles=tiles(plan), next_run=_next_run(plan), at=_at, value=_value,
        most=MOST_PAIRS,
    )  # fmt: skip


def tiles(plan: Plan) -> list[tuple[str, str]]:
    """Up to four figures."""
    seen = sum(size.value is not None for size in plan.sizes)
    alone = sum(size.alone is not None for size in plan.sizes)
    told = [
        (f"of {len(plan.sizes)} laws would be named", str(seen)),
        ("by themselves, if they are large enough", str(alone)),
        ("of 100 campaigns name something where nothing is", number(100 * plan.false, 2)),
    ]
    if plan.pairs:
        truth, other, share = plan.pairs[0]
        told.append(
            (
                f"of 100 campaigns take {truth} for {other}, or for a class with it, at worst",
                f"{100 * share:.0f}",
            )
        )
    return told


def _next_run(plan: Plan) -> str:
    if plan.next_run is None:
        return "No run within the rig's limits tells the worst pair better apart, or there is none"
    return plan.next_run.text[0].upper() + plan.next_run.text[1:]


def _value(value: float | None, size: Size, never: str = "not seen") -> str:
    return data.value_text(value, size, never).replace("-", "−")


def _at(size: Size) -> str:
    """The law's other numbers at that size, such as the speed over which friction falls."""
    if size.law.wave:
        return f", {size.law.unknown.variant}"
    effect = size.law.candidate.effect
    (fields,) = (each.table.model_fields for each in EFFECTS if each.id == effect)
    told = []
    for free in size.law.candidate.free_parameters[1:]:
        block, _, name = free.key.rpartition(".")
        if block == effect and name in fields:
            unit = unit_text(details(fields[name])["unit"])
            told.append(f"{name} = {free.start:.3g} {unit}".removesuffix(" 1"))
    return f", at {', '.join(told)}" if told else ""


@picture("smallest_sizes", (
    "The smallest size of each effect that would be named, in percent of friction by which it lets "
    "friction differ within these runs (a ripple: of the surface's speed). Blue: by itself or in a "
    "class with others; orange: by itself, where that takes 1.3 times as much. At the end of each "
    "bar, its size in the parameter's unit."
))  # fmt: skip
def draw_sizes(plan: Plan) -> Figure:
    """A row for each effect and direction: its name over its bar, so that a phone can show it."""
    sizes = plan.sizes
    figure, axes = panels(1, 1, height=1.2 + 0.54 * max(len(sizes), 1), width=5.6)
    axis = axes[0, 0]
    label: dict[str, Any] = {"va": "center", "fontsize": 9.5}
    ends = [(size, end) for size in sizes for end in (size.value, size.alone)]
    every = [size.law.percent(end) for size, end in ends if end is not None]
    drawn = {"named": axis.barh([0], [0], color=BLUE)}
    left, right = 0.5 * min(every, default=1.0), 8.0 * max(every, default=1.0)
    for place, size in enumerate(sizes):
        axis.text(1.05 * left, place - 0.36, data.name_of(size, sizes), **label)
        if size.percent is None:
            axis.text(1.05 * left, place, "not seen, whatever its size", color=RED, **label)
            continue
        alone = math.inf if size.alone is None else size.law.percent(size.alone)
        axis.barh(place, size.percent - left, left=left, height=0.26, color=BLUE)
        if MORE * size.percent < alone < math.inf:
            bar = axis.barh(place + 0.26, alone - left, left=left, height=0.16, color=ORANGE)
            drawn["named by itself"] = bar
            axis.text(1.05 * alone, place + 0.28, _value(size.alone, size), **label)
        never = "" if math.isfinite(alone) else ", never by itself"
        axis.text(1.05 * size.percent, place - 0.02, _value(size.value, size) + never, **label)
    logarithmic_x(axis)
    axis.set_xlim(left, right)
    axis.set_yticks([])
    axis.set_ylim(len(sizes) - 0.6, -0.6)
    axis.set_xlabel("smallest size [% of friction]")
    figure.legend(drawn.values(), drawn.keys(), loc="outside upper right", ncols=2)
    return figure
