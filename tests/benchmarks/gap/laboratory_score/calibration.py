"""Stated against observed error rates, with exact 95 % intervals of what was observed.

On the diagonal a level of 5 % errs in 5 %. Of intervals, in right answers: how often they miss the
truth. Of the stated probability of what is named alone: how often it is right.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cosim.report.palette import BLUE, GREY
from cosim.report.style import panels, png, styled

from .answers import Row
from .outcome import Outcome, outcome, probability
from .parameters import compared
from .shares import Share, share

TICKS = (0.0, 0.01, 0.05, 0.1, 0.2, 0.5, 1.0)
LEVELS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9)
BINS = (0.0, 0.5, 0.8, 0.9, 0.95, 0.99, 1.0)  # of stated probabilities

Points = list[tuple[float, Share]]


def interval_points(rows: Sequence[Row]) -> Points:
    """1 - level of an interval, share of intervals that miss the truth."""
    found = [each for row in rows for each in compared(row)]
    missed = [(level, sum(not e.covers(1.0 - level) for e in found)) for level in LEVELS if found]
    return [(level, Share(hits, len(found))) for level, hits in missed]


def probability_points(rows: Sequence[Row]) -> Points:
    """Mean stated probability of a bin to be wrong, and how often it was."""
    stated = [(p, row) for row in rows if (p := probability(row)) is not None]
    points = []
    for low, high in zip(BINS[:-1], BINS[1:], strict=True):
        inside = [(p, row) for p, row in stated if low <= p < high or p == high == 1.0]
        if inside:
            wrong = share(inside, lambda each: outcome(each[1]) is not Outcome.NAMED)
            points.append((1.0 - float(np.mean([p for p, _ in inside])), wrong))
    return points


def draw(axes: Axes, points: Points, colour: str, label: str, marker: str = "o") -> None:
    """Points with their intervals, each of all there is, or of a bin of it (diamonds)."""
    totals = [each.total for _, each in points]
    at = [level for level, _ in points]
    seen = np.array([each.value for _, each in points])
    ends = np.array([each.interval() for _, each in points]).reshape(-1, 2)
    bars = np.abs(ends.T - seen)
    count = sum(totals) if marker == "D" else max(totals, default=0)
    name = f"{label} ({count or 'none yet'})"
    # points at 0 and 1 are drawn whole; an empty series that is not clipped upsets the layout
    clipped = not points
    axes.errorbar(at, seen, bars, fmt=marker, capsize=2, color=colour, label=name, clip_on=clipped)


def root(value: np.ndarray) -> np.ndarray:
    """Square root of what is not negative, as limits of axes may be for a moment."""
    return np.sqrt(np.maximum(value, 0.0))


def frame(axes: Axes, stated: str, seen: str) -> None:
    """The diagonal and the words."""
    axes.plot([0, 1], [0, 1], color=GREY, lw=0.8, ls="--")
    axes.set_xlabel(stated)
    axes.set_ylabel(seen)
    for scale, limit, ticks in (
        (axes.set_xscale, axes.set_xlim, axes.set_xticks),
        (axes.set_yscale, axes.set_ylim, axes.set_yticks),
    ):
        scale("function", functions=(root, np.square))  # small error rates are what matters
        limit(0.0, 1.0)
        ticks(TICKS, [f"{tick:g}" for tick in TICKS])
    axes.set_box_aspect(1.0)
    axes.legend(loc="upper left")


@styled
def calibration_figure(rows: Sequence[Row]) -> Figure:
    """Two panels, both on the diagonal where the error rates are as stated."""
    figure, grid = panels(1, 2, height=4.4, width=8.5)
    intervals, names = grid[0]
    draw(intervals, interval_points(rows), BLUE, "parameters")
    frame(intervals, "1 - level of an interval", "right answers: intervals that miss the truth")
    draw(names, probability_points(rows), BLUE, "stated probability", "D")
    frame(names, "stated probability of a wrong name", "names that are wrong")
    return figure


def write_calibration(rows: Sequence[Row], file: Path) -> None:
    """The figure as a PNG."""
    file.write_bytes(png(calibration_figure(rows)))
