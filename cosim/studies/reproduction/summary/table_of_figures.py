"""The observed figures before and after, as rows for a table or a file, and as a picture."""

from __future__ import annotations

from typing import Any

from cosim.report.drawing import BLUE, GREEN, GREY, RED, panels, picture

from .result import FittedSummary, SummaryGap

UNITS = {
    "mean_x": "m", "mean_y": "m", "amplitude_x": "m", "frequency": "Hz", "slip_share": "1",
    "slip_duration": "s", "stick_duration": "s", "break_away_x": "m", "restick_x": "m",
    "max_rotation_deg": "deg",
}  # fmt: skip
WORDS = {
    "mean_x": "mean of x", "mean_y": "mean of y", "amplitude_x": "half range of x",
    "frequency": "oscillations", "slip_share": "share of time in slip",
    "slip_duration": "slip lasts", "stick_duration": "stick lasts",
    "break_away_x": "x at break-away", "restick_x": "x at re-stick",
    "max_rotation_deg": "largest rotation",
}  # fmt: skip
MOST_PANELS = 10  # figures in one picture


def stages(gap: SummaryGap) -> dict[str, FittedSummary]:
    """Name -> model beside the figures: as known, friction refitted, with the effects."""
    found = {"as known": gap.printed, "plain fit": gap.plain}
    if gap.extended is not None:
        found["with " + ", ".join(gap.found)] = gap.extended
    return found


def rows(gap: SummaryGap) -> list[dict[str, Any]]:
    """One row a figure: run, figure, unit, value, sd and per stage value, scatter, distance."""
    return [
        {
            "run": one.name,
            "figure": one.figure,
            "unit": UNITS[one.figure],
            "value": one.value,
            "sd": one.sd,
            "models": {
                name: {
                    "value": float(fit.shown[i]),
                    "scatter": float(fit.scatter[i]),
                    "distance": float(fit.residuals[i]),
                }
                for name, fit in stages(gap).items()
            },
        }
        for i, one in enumerate(gap.observations)
    ]


@picture(
    "figures",
    "The observed figures (grey: one standard deviation) and the model's, each "
    "with its scatter from seed to seed.",
)
def draw_figures(gap: SummaryGap):
    """A panel a figure; in each a row for every stage."""
    shown = rows(gap)[:MOST_PANELS]
    across = min(len(shown), 5)
    down = -(-len(shown) // across)
    figure, axes = panels(down, across, height=2.3, width=10.5, sharey=True)
    names = list(stages(gap))
    colours = dict(zip(names, (RED, BLUE, GREEN), strict=False))
    for ax, row in zip(axes.flat, shown, strict=False):
        unit, scale = ("mm", 1e3) if row["unit"] == "m" else (row["unit"], 1.0)
        value, sd = scale * row["value"], scale * row["sd"]
        ax.axvspan(value - sd, value + sd, color="#DDDDDD")
        ax.axvline(value, color=GREY, lw=1.0)
        for place, name in enumerate(names):
            model = row["models"][name]
            ax.errorbar(
                scale * model["value"],
                place,
                xerr=scale * model["scatter"],
                fmt="o",
                color=colours[name],
                capsize=2.5,
            )
        unit = "" if unit == "1" else f", {unit}"
        ax.set_title(row["run"], fontsize=8.5)
        ax.set_xlabel(f"{WORDS[row['figure']]}{unit}")
        ax.locator_params(axis="x", nbins=4)
    for ax in list(axes.flat)[len(shown) :]:
        ax.set_axis_off()
    axes[0, 0].set_yticks(range(len(names)), [name.replace(" ", "\n", 1) for name in names])
    axes[0, 0].set_ylim(len(names) - 0.5, -0.5)
    return figure
