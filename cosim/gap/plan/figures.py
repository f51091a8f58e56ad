"""Pictures of a plan: the smallest sizes, and the pairs that cannot be told apart."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from cosim.report.style import BLUE, INK, LIGHT_GREY, ORANGE, PALE_BLUE, RED, panels, picture

from .data import size_text
from .plan import Plan, Size

#: Times a smallest size up to which the colours tell more; so dark that text is still read.
_FAR = 30.0


@picture("smallest_sizes", (
    "The smallest size of each effect that would be named, as percent of friction: so much more "
    "friction moves the block as much. Blue: named, by itself or in a class; orange: told from "
    "every other effect. Beside the bar, the size in the parameter's own unit. Pale: sizes that "
    "are typical of such rigs; what of them lies left of the bar's end would be missed."
))  # fmt: skip
def draw_sizes(plan: Plan) -> Figure:
    """A row for each effect."""
    sizes = plan.sizes
    figure, axes = panels(1, 1, height=1.1 + 0.42 * len(sizes), width=9.0)
    axis = axes[0, 0]
    seen = [size.percent for size in sizes if math.isfinite(size.percent)]
    spans = [span for size in sizes if (span := _typical(size)) is not None]
    every = [*seen, *[end for span in spans for end in span], *map(_alone, sizes)]
    every = [value for value in every if math.isfinite(value) and value > 0.0] or [1.0]
    left, right = 0.4 * min(every), 2.0 * max(every)
    for place, size in enumerate(sizes):
        span = _typical(size)
        if span is not None:
            axis.barh(place, span[1] - span[0], left=span[0], height=0.86, color=PALE_BLUE)
        if not math.isfinite(size.percent):
            axis.text(left * 1.15, place, "not seen, whatever its size", va="center", color=RED)
            continue
        axis.barh(place, size.percent - left, left=left, height=0.4, color=BLUE)
        alone = min(_alone(size), right)
        if alone > size.percent:
            axis.barh(place, alone - size.percent, left=size.percent, height=0.4, color=ORANGE)
        never = "" if math.isfinite(_alone(size)) else ", never by itself"
        axis.text(
            max(size.percent, alone if not never else size.percent) * 1.08, place,
            f"{size_text(size)}{never}", va="center", fontsize=8.5,
        )  # fmt: skip
    axis.set_xscale("log")
    axis.set_xlim(left, right)
    axis.set_yticks(range(len(sizes)), [size.effect for size in sizes])
    axis.set_ylim(len(sizes) - 0.5, -0.5)
    axis.grid(visible=False, axis="y")
    axis.set_xlabel("smallest size, percent of friction")
    for label, colour in (("named", BLUE), ("by itself", ORANGE), ("typical", PALE_BLUE)):
        axis.barh([0], [0], color=colour, label=label)
    figure.legend(loc="outside upper right", ncols=3)
    return figure


def _alone(size: Size) -> float:
    """Percent of friction at which it is told from every other."""
    return abs(size.alone - size.neutral) * size.percent_per_unit


def _typical(size: Size) -> tuple[float, float] | None:
    """The typical range as percent of friction, either sign."""
    if size.typical is None or not size.percent_per_unit > 0.0:
        return None
    away = sorted(abs(end - size.neutral) for end in size.typical)
    low = away[0] if np.sign(size.typical[0]) == np.sign(size.typical[1]) else 0.1 * away[1]
    if not low > 0.0:
        low = 0.1 * away[1]
    return low * size.percent_per_unit, away[1] * size.percent_per_unit


@picture("pairs", (
    "How large the effect of a row has to be, in its smallest sizes, to be told from that of a "
    "column. Empty: told apart as soon as it is seen. A dash: never by this campaign."
))  # fmt: skip
def draw_pairs(plan: Plan) -> Figure:
    """A matrix: rows are what is there, columns what it might be taken for."""
    names = [size.effect for size in plan.sizes]
    seen = {pair.truth for pair in plan.pairs}
    rows = [name for name in names if name in seen]
    times = {(pair.truth, pair.other): pair.times for pair in plan.pairs}
    figure, axes = panels(1, 1, height=1.6 + 0.42 * max(len(rows), 1), width=9.0)
    axis = axes[0, 0]
    shown = np.array([[times.get((row, column), np.nan) for column in names] for row in rows])
    shown = shown.reshape(len(rows), len(names))
    colours = np.where(shown > 1.0, np.minimum(shown, _FAR), np.nan)
    axis.imshow(colours, norm=LogNorm(1.0, 3.0 * _FAR), cmap="Oranges", aspect="auto")
    for i, j in np.ndindex(*shown.shape):
        if rows[i] == names[j]:
            axis.add_patch(_square(j, i))
        elif shown[i, j] > 1.0:
            said = f"{shown[i, j]:.1f}×" if shown[i, j] < 100.0 else "–"
            axis.text(j, i, said, ha="center", va="center", fontsize=8.5, color=INK)
    axis.set_xticks(range(len(names)), names, rotation=35, ha="left")
    axis.xaxis.tick_top()
    axis.set_yticks(range(len(rows)), rows)
    axis.grid(visible=False)
    return figure


def _square(column: int, row: int) -> Rectangle:
    return Rectangle((column - 0.5, row - 0.5), 1.0, 1.0, color=LIGHT_GREY)
