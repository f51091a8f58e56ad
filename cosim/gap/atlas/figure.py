"""The atlas as a figure: a row for each region, a panel for each variable."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cosim.gap.atlas.atlas import Atlas, Region
from cosim.gap.atlas.dependence import Dependence
from cosim.gap.atlas.variables import VARIABLES
from cosim.studies.drawing import BLUE, GREY, RED, panels, picture

COLUMNS = 4
SCALES = {"m": (1e3, "mm"), "m/s": (1e3, "mm/s"), "N": (1.0, "N"), "rad": (1e3, "mrad")}
CAPTION = (
    "Where the misfit lives: what the model lacks, in bins of what it may depend on, with standard "
    "errors. Red: more than chance makes in all panels together."
)


@picture("atlas", CAPTION)
def draw_atlas(atlas: Atlas, chance: float = 0.01) -> Figure:
    """Small multiples: the most telling variables of each region, most certain first."""
    regions = [region for region in atlas.regions if region.dependences]
    figure, axes = panels(max(len(regions), 1), COLUMNS, height=2.1, width=11.0)
    for row, region in zip(axes, regions, strict=False):
        shown = region.dependences[:COLUMNS]
        for axis, dependence in zip(row, shown, strict=False):
            significant = 10.0**dependence.log10_p * atlas.tests < chance
            _draw(axis, region, dependence, RED if significant else BLUE)
        for axis in row[len(shown) :]:
            axis.set_axis_off()
        factor, unit = SCALES[region.unit]
        row[0].set_ylabel(f"{region.channel}, {region.regime}\n{region.quantity} ({unit})")
    if not regions:
        for axis in axes[0]:
            axis.set_axis_off()
    return figure


def _draw(axis: Axes, region: Region, dependence: Dependence, colour: str) -> None:
    factor, _ = SCALES[region.unit]
    variable = VARIABLES[dependence.variable]
    axis.axhline(0.0, color=GREY, linewidth=0.8)
    axis.errorbar(
        dependence.centre, factor * dependence.value, factor * dependence.error,
        fmt="o-", color=colour, linewidth=0.9, markersize=3.0, capsize=2.0,
    )  # fmt: skip
    if variable.logarithmic and min(dependence.centre) > 0.0:
        axis.set_xscale("log")
    axis.set_xlabel(f"{variable.label.removeprefix('the ')} ({variable.unit})")
