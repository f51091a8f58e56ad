"""Figures for runs of which only figures are known."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from cosim.report.style import BLUE, GREY, INK, PALE_GREY, RED, panels, picture
from cosim.studies.reproduction.summary import SummaryGap

CAPTION = (
    "How far each figure of the model is from the observed one, in the observation's standard "
    "deviations: with the numbers as they are known (grey), the plain model refitted (blue), the "
    "extended model (dark orange). Shaded: within two."
)


@picture("observations", CAPTION)
def draw_observations(gap: SummaryGap) -> Figure:
    """A row for each observation."""
    models = [("as known", GREY, gap.printed), ("plain model, refitted", BLUE, gap.plain)]
    if gap.extended is not None:
        models.append(("extended model", RED, gap.extended))
    figure, axes = panels(1, 1, height=1.1 + 0.5 * len(gap.observations), width=8.5)
    axis = axes[0, 0]
    axis.axvspan(-2.0, 2.0, color=PALE_GREY, zorder=0)
    axis.axvline(0.0, color=INK, linewidth=0.8)
    places = np.arange(len(gap.observations))
    for shift, (label, colour, model) in zip((-0.18, 0.0, 0.18), models, strict=False):
        axis.plot(model.residuals, places + shift, "o", color=colour, markersize=6.0, label=label)
    names = [f"{one.figure.replace('_', ' ')}, {one.name}" for one in gap.observations]
    axis.set_yticks(places, names)
    axis.invert_yaxis()
    axis.set_xscale("symlog", linthresh=3.0)
    axis.set_xticks([-30, -10, -3, 0, 3, 10, 30], ["−30", "−10", "−3", "0", "3", "10", "30"])
    axis.minorticks_off()
    axis.set_xlabel("modelled less observed (standard deviations)")
    axis.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure
