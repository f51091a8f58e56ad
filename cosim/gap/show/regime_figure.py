"""Residual analysis by regime: a row a region, a panel for its runs and one for each variable."""

from __future__ import annotations

from textwrap import fill

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from cosim.gap.diagnostics.dependence import Dependence
from cosim.gap.diagnostics.regimes import RegimeAnalysis, Region
from cosim.gap.diagnostics.variables import VARIABLES
from cosim.gap.diagnostics.where import CHANCE, told_chance
from cosim.report.style import BLUE, GREY, RED, logarithmic_x, panels, picture

#: Variables shown of each region, the most certain ones.
SHOWN = 3
#: Letters of a label that a panel has room for.
_WIDEST = 30
SCALES = {"m": (1e3, "mm"), "m/s": (1e3, "mm/s"), "N": (1.0, "N"), "rad": (1e3, "mrad")}
CAPTION = (
    "Where the misfit lives: what the model lacks, by run and over what it may depend on, "
    "with standard errors; zero is no misfit. Of each region the variables that tell most. p: "
    "chance of as clear a dependence (by run: of as large means), allowing for the number of "
    f"panels that were looked at; dark orange: below {CHANCE:g}."
)


@picture("atlas", CAPTION)
def draw_regimes(analysis: RegimeAnalysis) -> Figure:
    """Small multiples; a region that was not seen has no row."""
    rows = max(len(analysis.regions), 1)
    figure, axes = panels(rows, SHOWN + 1, height=2.2, width=11.0, sharey="row")
    for axis in axes.flat:
        axis.set_axis_off()
    for row, region in zip(axes, analysis.regions, strict=False):
        _draw_runs(row[0], region, analysis.tests)
        for axis, dependence in zip(row[1:], region.dependences, strict=False):
            _draw(axis, region, dependence, analysis.tests)
    return figure


def _draw_runs(axis: Axes, region: Region, tests: int) -> None:
    places = np.arange(len(region.runs))
    _errorbars(axis, region, places, region.value, region.error, region.log10_p, tests, "o")
    axis.set_xticks(places, region.runs, rotation=30, ha="right")
    axis.set_xlim(-0.5, len(places) - 0.5)
    _, unit = SCALES[region.unit]
    axis.set_ylabel(f"{region.channel}, {region.regime}\n{region.quantity} ({unit})")


def _draw(axis: Axes, region: Region, found: Dependence, tests: int) -> None:
    order = np.argsort(found.centre)
    _errorbars(
        axis, region, found.centre[order], found.value[order], found.error[order],
        found.log10_p, tests, "o-",
    )  # fmt: skip
    variable = VARIABLES[found.variable]
    label = f"{variable.label.removeprefix('the ')} ({variable.unit})"
    axis.set_xlabel(fill(label, _WIDEST))
    if variable.logarithmic and found.centre.min() > 0.0:
        logarithmic_x(axis)
    else:
        axis.xaxis.set_major_locator(MaxNLocator(5))


def _errorbars(
    axis: Axes, region: Region, at: np.ndarray, value: np.ndarray, error: np.ndarray,
    log10_p: float, tests: int, form: str,
) -> None:  # fmt: skip
    factor, _ = SCALES[region.unit]
    corrected = min(log10_p + np.log10(tests), 0.0)
    axis.set_axis_on()
    axis.axhline(0.0, color=GREY, linewidth=0.8)
    axis.errorbar(
        at, factor * value, factor * error, fmt=form, linewidth=0.9, markersize=3.0, capsize=2.0,
        color=RED if corrected < np.log10(CHANCE) else BLUE,
    )  # fmt: skip
    axis.set_title(f"p {told_chance(corrected)}", fontsize=8.0, loc="right")
