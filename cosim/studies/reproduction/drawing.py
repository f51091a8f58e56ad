"""Figures of the reproduction: curves in panels, in the colours and lines of the models."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from cosim.report.style import BLUE, GREEN, INK, RED, SERIES, panels

from .cases import MASSES, SPEEDS
from .motion import Motion

MODELS = ("printed", "mended", "exact")
LABELS = ("scheme as printed", "scheme mended", "exact model")
COLOURS = (RED, BLUE, GREEN)
# the scheme mended and the exact model often coincide: the one shows as a rim about the other
DOTTED: tuple[dict[str, Any], ...] = (
    {"marker": "o"},
    {"marker": "o", "linewidth": 4.0, "markersize": 9.0},
    {"marker": "o"},
)


@dataclass(frozen=True)
class Curve:
    """y (n,) over x (n,), in the units of the panel's labels; style: as matplotlib's `plot`."""

    x: Any
    y: Any
    style: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Panel:
    """Curves on one pair of axes; levels: label -> height of a broken line."""

    curves: Sequence[Curve]
    x: str = ""
    y: str = ""
    title: str = ""
    levels: Mapping[str, float] = field(default_factory=dict)
    end: float | None = None  # of the x axis, which then begins at 0


def figure_of(rows: Sequence[Sequence[Panel]], *, legend: int = 3, **layout: Any) -> Figure:
    """Panels in rows; legend: its columns; layout: of `report.style.panels`."""
    figure, axes = panels(len(rows), len(rows[0]), **layout)
    for ax, panel in zip(axes.flat, (panel for row in rows for panel in row), strict=True):
        for curve in panel.curves:
            ax.plot(curve.x, curve.y, **curve.style)
        for label, height in panel.levels.items():
            ax.axhline(height, color=INK, linestyle="--", linewidth=1.0, label=label)
        ax.set(xlabel=panel.x, ylabel=panel.y, title=panel.title)
        if panel.end is not None:
            ax.set_xlim(0.0, panel.end)
        if "sharex" in layout:
            ax.label_outer()
    named = axes[0, 0].get_legend_handles_labels()
    if named[0]:
        figure.legend(*named, ncols=legend, loc="outside upper center")
    return figure


def by_model(x: Any, series: Iterable[Any]) -> list[Curve]:
    """A line with dots for each of the models."""
    return [
        Curve(x, values, {"color": colour, "label": label, **dots})
        for values, colour, label, dots in zip(series, COLOURS, LABELS, DOTTED, strict=True)
    ]


def over_time(
    motion: Motion,
    name: str,
    scale: float = 1.0,
    begin: float = 0.0,
    end: float = np.inf,
    **style: Any,
) -> Curve:
    """A quantity of a motion from ``begin`` to ``end`` (s), time counted from ``begin``."""
    keep = (motion.time >= begin) & (motion.time <= end)
    return Curve(motion.time[keep] - begin, scale * getattr(motion, name)[keep], style)


def over_mass(
    values: np.ndarray, stiffnesses: Sequence[float], label: str, **layout: Any
) -> Figure:
    """Values (model, stiffness, mass, speed): a row a model, a column a stiffness."""
    rows = [
        [
            Panel(
                [
                    Curve(MASSES, line, {"marker": "o", "ms": 2.5, "color": colour, "label": name})
                    for line, colour, name in zip(cell.T, SERIES, SPEED_LABELS, strict=True)
                ],
                "mass, kg",
                f"{model}\n{label}",
                f"k {k:.2f} N/m" if model == LABELS[0] else "",
            )
            for k, cell in zip(stiffnesses, of_model, strict=True)
        ]
        for model, of_model in zip(LABELS, values, strict=True)
    ]
    return figure_of(rows, legend=6, sharex=True, **layout)


SPEED_LABELS = tuple(f"v {speed:.2f} m/s" for speed in SPEEDS)
