"""What all pictures of the reproduction share: colours of the models, panels, PNG."""

from __future__ import annotations

import io
from collections.abc import Callable
from functools import wraps

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from .cases import EXACT_MODEL, MENDED_MODEL, PRINTED_MODEL
from .claim import Picture

MODELS = (PRINTED_MODEL, MENDED_MODEL, EXACT_MODEL)
LABELS = {
    PRINTED_MODEL: "scheme as printed", MENDED_MODEL: "scheme mended", EXACT_MODEL: "exact model"
}
# Okabe and Ito's palette: told apart with any kind of colour vision
COLOURS = {PRINTED_MODEL: "#D55E00", MENDED_MODEL: "#0072B2", EXACT_MODEL: "#009E73"}
GREY, INK = "#7A7A7A", "#222222"
SERIES = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
RC = {
    "font.family": "DejaVu Sans", "font.size": 9.0, "axes.titlesize": 9.5,
    "axes.titlelocation": "left", "axes.spines.top": False, "axes.spines.right": False,
    "axes.edgecolor": GREY, "axes.grid": True, "axes.axisbelow": True, "grid.color": "#DDDDDD",
    "grid.linewidth": 0.6, "legend.frameon": False, "legend.fontsize": 8.5,
    "lines.linewidth": 1.2, "lines.markersize": 4.0,
}
DPI = 130


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


def by_model(ax: Axes, x, series: dict[str, list[float]], scale: float = 1.0, **style) -> None:
    """One line a model over ``x``."""
    for model, values in series.items():
        style = {"marker": "o"} | style
        ax.plot(x, scale * np.asarray(values), color=COLOURS[model], label=LABELS[model], **style)


def study_line(ax: Axes, value: float, label: str) -> None:
    """The study's own figure as a dashed line."""
    ax.axhline(value, color=INK, linestyle="--", linewidth=1.0, label=label)
