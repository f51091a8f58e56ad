"""What the pictures of the reproduction share: colours and lines of the models."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from cosim.report.style import BLUE, GREEN, INK, RED

from .cases import EXACT_MODEL, MENDED_MODEL, PRINTED_MODEL

MODELS = (PRINTED_MODEL, MENDED_MODEL, EXACT_MODEL)
LABELS = {
    PRINTED_MODEL: "scheme as printed",
    MENDED_MODEL: "scheme mended",
    EXACT_MODEL: "exact model",
}
COLOURS = {PRINTED_MODEL: RED, MENDED_MODEL: BLUE, EXACT_MODEL: GREEN}
# the scheme mended and the exact model often coincide: the one shows as a rim about the other
WIDER = {MENDED_MODEL: {"linewidth": 4.0, "markersize": 9.0}}


def by_model(
    ax: Axes, x: ArrayLike, series: Mapping[str, ArrayLike], scale: float = 1.0, **style: Any
) -> None:
    """One line a model over ``x``."""
    for model, values in series.items():
        line = {"marker": "o"} | style | WIDER.get(model, {})
        ax.plot(
            np.asarray(x),
            scale * np.asarray(values),
            color=COLOURS[model],
            label=LABELS[model],
            **line,
        )


def study_line(ax: Axes, value: float, label: str) -> None:
    """The study's own figure as a dashed line."""
    ax.axhline(value, color=INK, linestyle="--", linewidth=1.0, label=label)
