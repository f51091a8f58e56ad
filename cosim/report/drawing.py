"""What the pictures of all studies share: palette, panels, PNG."""

from __future__ import annotations

import io
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import wraps

import matplotlib
from matplotlib.figure import Figure

GREY, INK = "#7A7A7A", "#222222"
# Okabe and Ito's palette: told apart with any kind of colour vision
BLUE, RED, GREEN, PURPLE, ORANGE, SKY = SERIES = (
    "#0072B2",
    "#D55E00",
    "#009E73",
    "#CC79A7",
    "#E69F00",
    "#56B4E9",
)
RC = {
    "font.family": "DejaVu Sans",
    "font.size": 9.0,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": GREY,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": "#DDDDDD",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "lines.linewidth": 1.2,
    "lines.markersize": 4.0,
}
DPI = 130


@dataclass(frozen=True)
class Picture:
    """A PNG with its caption."""

    name: str
    caption: str
    png: bytes = field(repr=False)


def picture(name: str, caption: str) -> Callable[[Callable[..., Figure]], Callable[..., Picture]]:
    """Turn a function that draws a figure into one that returns its PNG."""

    def wrap(draw: Callable[..., Figure]) -> Callable[..., Picture]:
        @wraps(draw)
        def drawn(*args, **kwargs) -> Picture:
            with matplotlib.rc_context(RC):
                figure = draw(*args, **kwargs)
                data = io.BytesIO()
                figure.savefig(data, format="png", dpi=DPI)
            return Picture(name, caption, data.getvalue())

        return drawn

    return wrap


def panels(rows: int, columns: int, *, height: float = 2.6, width: float = 9.0, **kwargs):
    """A figure and its axes (rows, columns), laid out without overlaps."""
    figure = Figure(figsize=(width, height * rows), layout="constrained")
    return figure, figure.subplots(rows, columns, squeeze=False, **kwargs)
