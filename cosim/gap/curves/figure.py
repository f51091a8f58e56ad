"""The free curves of a campaign, best first, each with its band."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cosim.report.style import BLUE, GREY, RED, logarithmic_x, panels, readable, styled

from .curve import Curve

#: So many are drawn: the rest gained least.
MOST, _COLUMNS = 6, 3
MOVES = {"mu_k": "$\\mu_k$", "mu_s": "$\\mu_s$", "both": "$\\mu_s$ and $\\mu_k$"}


CURVES = (
    "What the runs themselves say of friction over an axis, or of a force, whatever the catalogue "
    "holds: free curves, red of what was found. Shaded: what noise leaves open in 90 %, if all "
    "else answers in proportion; a steep curve may be further off. Gain: by how much -2 ln "
    "likelihood of all runs is less with the curve, each run predicted from the others."
)


@styled
def draw_curves(curves: Sequence[Curve], named: Sequence[str] = ()) -> Figure:
    """Friction over each axis, or the force on the block, with 90 % bands; named : axes in red."""
    shown = curves[:MOST]
    columns = min(max(len(shown), 1), _COLUMNS)
    rows = max(1, -(-len(shown) // _COLUMNS))
    figure, axes = panels(rows, columns, height=2.7, width=4.0 * columns)
    for axis, curve in zip(axes.flat, shown, strict=False):
        _draw(axis, curve, curve.axis in named)
    for axis in axes.flat[len(shown) :]:
        axis.set_visible(False)
    return figure


def _draw(axis: Axes, curve: Curve, is_named: bool) -> None:
    scaled = readable(curve.values, curve.unit)
    values, (mean, low, high) = scaled(curve.values), _shown(curve)
    colour = RED if is_named else BLUE
    axis.fill_between(values, low, high, color=colour, alpha=0.2, linewidth=0.0)
    axis.plot(values, mean, color=colour)
    axis.axhline(0.0, color=GREY, linewidth=0.6)
    if curve.axis == "hold time":
        logarithmic_x(axis)
    axis.set_xlabel(f"{curve.axis} ({scaled.unit})")
    axis.set_ylabel(
        "force along x (N)" if curve.on == "force" else f"change of {MOVES[curve.on]} (%)"
    )
    axis.set_title(f"gain {_whole(curve.gain)} ± {_whole(curve.error)}")


def _whole(value: float) -> str:
    """A number of some hundreds without a power of ten."""
    return f"{value:.0f}" if abs(value) >= 10.0 else f"{value:.2g}"


def _shown(curve: Curve) -> tuple[np.ndarray, ...]:
    """Mean and band: friction in percent."""
    lines = curve.mean, curve.low, curve.high
    if curve.on == "force":
        return lines
    return tuple(100.0 * np.expm1(line) for line in lines)
