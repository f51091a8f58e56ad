"""Friction on the block over time."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from stickslip.kernel.layout import P_MU_K, P_MU_S, P_NORMAL_FORCE

from ..blocks import mechanics_of
from ..style import (
    BLUE,
    GREEN,
    GREY,
    INK,
    RED,
    at_least,
    line,
    readable,
    slip_patch,
    styled,
    time_panels,
    title,
)

COMPONENTS = (
    ("friction_force_x", "N", "friction along x", BLUE),
    ("friction_force_y", "N", "friction along y", GREEN),
    ("friction_moment", "N.m", "friction moment", RED),
)
# of the limit of static friction: a component below it is left out
SMALLEST_SHARE = 1e-6


@styled
def draw_friction_force(dataset: xr.Dataset) -> Figure:
    """Friction along x with the limits of stick and slip; the other components where they act."""
    p = mechanics_of(dataset).pack()
    limits = {"μ_s m g": p[P_MU_S] * p[P_NORMAL_FORCE], "μ_k m g": p[P_MU_K] * p[P_NORMAL_FORCE]}
    shown = _acting(dataset, SMALLEST_SHARE * max(limits.values()))
    figure, axes = time_panels(dataset, rows=len(shown), height=2.6 if len(shown) == 1 else 2.0)
    for row, (name, unit, label, colour) in enumerate(shown):
        scaled = readable(dataset[name].values, unit)
        for panel in axes[row]:
            line(panel, dataset["time"].values, scaled(dataset[name].values), color=colour)
        axes[row, 0].set_ylabel(f"{label} [{scaled.unit}]")
        at_least(axes[row, 0], 1e-6)
        if name == "friction_force_x":
            for panel in axes[row]:
                _mark_limits(panel, {text: scaled.factor * size for text, size in limits.items()})
    figure.align_ylabels(axes[:, 0])
    title(figure, "Friction on the block", dataset)
    figure.legend(handles=[slip_patch()], loc="outside upper right")
    return figure


def _acting(dataset: xr.Dataset, smallest: float) -> list[tuple[str, str, str, str]]:
    return [
        component
        for component in COMPONENTS
        if component[0] == "friction_force_x"
        or np.nanmax(np.abs(dataset[component[0]].values), initial=0.0) > smallest
    ]


def _mark_limits(axes: Axes, limits: dict[str, float]) -> None:
    """Dashed lines where friction reaches its limits, named behind the right edge."""
    low, high = axes.dataLim.intervaly
    reach = 1.1 * max(abs(low), abs(high))
    for text, size in limits.items():
        for sign, mark in ((1.0, ""), (-1.0, "−")):
            level = sign * size
            if size == 0.0 or not min(low, 0.0) * 1.1 <= level <= max(high, 0.0) * 1.1 <= reach:
                continue
            axes.axhline(level, color=GREY, linewidth=0.9, linestyle="--", zorder=1)
            axes.annotate(
                mark + _mathtext(text),
                (1.0, level),
                xycoords=("axes fraction", "data"),
                xytext=(3, 0),
                textcoords="offset points",
                va="center",
                fontsize=9,
                color=INK,
            )


def _mathtext(text: str) -> str:
    symbol, rest = text.split(" ", 1)
    greek, index = symbol.split("_")
    return rf"${{\mu}}_{{\mathrm{{{index}}}}}\,{rest.replace(' ', chr(92) + ',')}$"
