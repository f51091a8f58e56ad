"""What the pictures of the reproduction share: colours and lines of the models, their grids."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike, NDArray

from cosim.report.style import BLUE, GREEN, INK, RED, SERIES

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


def over_mass(
    figure: Figure,
    axes: NDArray[np.object_],
    masses: Sequence[float],
    stiffnesses: Sequence[float],
    speeds: Sequence[float],
    values: Mapping[str, NDArray[np.float64]],
    label: str,
) -> None:
    """Values (stiffness, mass, speed) of each model: a row a model, a column a stiffness.

    axes: (models, stiffnesses); masses in kg, stiffnesses in N/m, speeds in m/s.
    """
    for row, model in enumerate(MODELS):
        for column, k in enumerate(stiffnesses):
            ax = axes[row, column]
            for i, v in enumerate(speeds):
                y = values[model][column, :, i]
                ax.plot(masses, y, "o-", ms=2.5, color=SERIES[i], label=f"v {v:.2f} m/s")
            if row == 0:
                ax.set_title(f"k {k:.2f} N/m")
        axes[row, 0].set_ylabel(f"{LABELS[model]}\n{label}")
    for ax in axes[-1]:
        ax.set_xlabel("mass, kg")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=6, loc="outside upper center")
