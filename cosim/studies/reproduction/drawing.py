"""Figures of the reproduction: curves in panels, in the colours and lines of the models."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from cosim.report.live_of_figure import live_of
from cosim.report.palette import BLUE, GREEN, INK, RED, SERIES
from cosim.report.style import panels, picture

from .cases import MASSES, SPEEDS
from .claim import WRITTEN, Claim
from .motion import Motion

LABELS = ("scheme as printed", "scheme mended", "exact model")
COLOURS = (RED, BLUE, GREEN)
#: Style of each model's line.
LINES: list[dict[str, Any]] = [
    {"color": colour, "label": label} for colour, label in zip(COLOURS, LABELS, strict=True)
]
# the scheme mended and the exact model often coincide: the one shows as a rim about the other
WIDER: dict[str, Any] = {"linewidth": 4.0, "markersize": 9.0}


class Curve(NamedTuple):
    """y (n,) over x (n,), in the units of the panel's labels; style: as matplotlib's `plot`."""

    x: Any
    y: Any
    style: Mapping[str, Any] = {}


class Panel(NamedTuple):
    """Curves on one pair of axes; levels: label -> height of a broken line; end: of the x axis."""

    curves: Sequence[Curve]
    title: str = ""
    levels: Mapping[str, float] = {}
    end: float | None = None


def figure_of(rows: Sequence[Sequence[Panel]], written: Mapping[str, Any]) -> Figure:
    """Panels in rows; written: labels x and y (or one of each row), and the layout."""
    layout = {key: written[key] for key in ("height", "width", "sharex", "sharey") & written.keys()}
    figure, axes = panels(len(rows), len(rows[0]), **layout)
    labels = [written["y"]] * len(rows) if isinstance(written["y"], str) else written["y"]
    for row, of_row, y in zip(rows, axes, labels, strict=True):
        for panel, ax in zip(row, of_row, strict=True):
            for curve in panel.curves:
                ax.plot(curve.x, curve.y, **curve.style)
            for label, height in panel.levels.items():
                ax.axhline(height, color=INK, linestyle="--", linewidth=1.0, label=label)
            ax.set(xlabel=written["x"], ylabel=y, title=panel.title)
            if panel.end is not None:
                ax.set_xlim(0.0, panel.end)
            if "sharex" in layout:
                ax.label_outer()
    named = axes[0, 0].get_legend_handles_labels()
    figure.legend(*named, ncols=written.get("legend", 3), loc="outside upper center")
    return figure


def add_picture(
    claim: Claim,
    name: str,
    rows: Sequence[Sequence[Panel]] = (),
    draw: Callable[..., Figure] = figure_of,
) -> None:
    """A figure of a claim as it is written, of panels in rows; draw: what makes it of them."""
    written = WRITTEN[claim.id]["picture"][name]
    live = live_of if written.get("live") else None
    claim.pictures.append(picture(name, written["caption"], live=live)(draw)(rows, written))


def by_model(x: Any, series: Iterable[Any]) -> list[Curve]:
    """A line with dots for each of the models."""
    rims: tuple[dict[str, Any], ...] = ({}, WIDER, {})
    return [
        Curve(x, values, {"marker": "o"} | line | rim)
        for values, line, rim in zip(series, LINES, rims, strict=True)
    ]


def over_time(
    motion: Motion, name: str, scale: float = 1.0, begin: float = 0.0, end: float = np.inf,
    **style: Any,
) -> Curve:  # fmt: skip
    """A quantity of a motion from ``begin`` to ``end`` (s), time counted from ``begin``."""
    keep = (motion.time >= begin) & (motion.time <= end)
    return Curve(motion.time[keep] - begin, scale * getattr(motion, name)[keep], style)


def models_over_time(
    runs: Sequence[Motion], name: str, scale: float = 1.0, settled: float = 0.0
) -> list[Curve]:
    """A quantity of each model's run, from a part of its time on."""
    return [
        over_time(run, name, scale, settled * run.time[-1], **line, lw=1.0)
        for run, line in zip(runs, LINES, strict=True)
    ]


def over_mass(values: np.ndarray, stiffnesses: Sequence[float]) -> list[list[Panel]]:
    """Values (model, stiffness, mass, speed): a row a model, a column a stiffness."""
    styles = [
        {"marker": "o", "ms": 2.5, "color": colour, "label": f"v {speed:.2f} m/s"}
        for speed, colour in zip(SPEEDS, SERIES, strict=True)
    ]

    def panel(cell: np.ndarray, title: str) -> Panel:
        return Panel([Curve(MASSES, *line) for line in zip(cell.T, styles, strict=True)], title)

    titles = [[f"k {k:.2f} N/m" for k in stiffnesses], *[[""] * len(stiffnesses)] * 2]
    return [list(map(panel, *row)) for row in zip(values, titles, strict=True)]
