"""What the pictures of the reproduction share: colours and lines of the models."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from cosim.studies.drawing import BLUE, GREEN, INK, RED

from .cases import EXACT_MODEL, MENDED_MODEL, PRINTED_MODEL

MODELS = (PRINTED_MODEL, MENDED_MODEL, EXACT_MODEL)
LABELS = {
    PRINTED_MODEL: "scheme as printed", MENDED_MODEL: "scheme mended", EXACT_MODEL: "exact model"
}
COLOURS = {PRINTED_MODEL: RED, MENDED_MODEL: BLUE, EXACT_MODEL: GREEN}


def by_model(ax: Axes, x, series: dict[str, list[float]], scale: float = 1.0, **style) -> None:
    """One line a model over ``x``."""
    for model, values in series.items():
        style = {"marker": "o"} | style
        ax.plot(x, scale * np.asarray(values), color=COLOURS[model], label=LABELS[model], **style)


def study_line(ax: Axes, value: float, label: str) -> None:
    """The study's own figure as a dashed line."""
    ax.axhline(value, color=INK, linestyle="--", linewidth=1.0, label=label)
