"""What the answer for runs of which only figures are known leaves behind: as `cosim.gap.show`."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from stickslip import EFFECTS

from cosim.files import write_text
from cosim.gap.quantities import Quantity, digits, quantity
from cosim.gap.show import text
from cosim.gap.show.files import write_pictures
from cosim.gap.show.model_file import file_text, known_tables, put, scenario_from
from cosim.gap.show.model_file import safe_name as safe_name
from cosim.gap.show.numbers import ranked, tree
from cosim.report.files import json_text
from cosim.report.page import Picture, render
from cosim.report.palette import BLUE, GREY, INK, PALE_GREY, RED
from cosim.report.style import panels, picture
from cosim.studies import FIGURES

from ..cases import SETTLING
from ..motion import WINDOW
from .find import SummaryGap
from .models import SAID

#: What is written as it stands in an answer.
AS_IT_IS = (
    "verdict", "effects", "classes", "where", "chance", "printed", "plain", "extended",
    "free_friction", "not_felt", "open_figures", "fits_share",
)  # fmt: skip


def sentence(gap: SummaryGap) -> str:
    """The answer in a sentence."""
    said = {entry.id: entry.sentence.rstrip(".") for entry in EFFECTS}
    groups = "; ".join(" or ".join(group) for group in gap.classes)
    named = "; ".join(f"{one}: {said[one]}" for one in gap.effects)
    told = "nearer" if gap.verdict == "unknown" and gap.effects else gap.verdict
    return SAID[told].format(groups=groups, named=named, effects=" and ".join(gap.effects))


def gap_line(gap: SummaryGap) -> str:
    """Before and after, in standard deviations of the observations."""
    return SAID["gap"].format(*map(digits, (*gap.gap_before, *gap.gap_after)))


def quantities(gap: SummaryGap) -> list[Quantity]:
    """The numbers of the model that is left."""
    intervals = {key: (low, high) for key, (_, low, high) in gap.determined.items()}
    for row in gap.ranking:
        intervals |= row.intervals if row.effect in gap.found else {}
    return [quantity(key, value, intervals.get(key)) for key, value in gap.last.values.items()]


def closing_lines(gap: SummaryGap) -> list[str]:
    """What a terminal says at the end."""
    return [
        f"{gap.campaign.name}: {gap.verdict}",
        f"  {sentence(gap)}",
        f"  gap        {gap_line(gap)}",
        f"  where      {gap.where.text}",
        f"  numbers    {'; '.join(one.text for one in quantities(gap))} (95 % intervals)",
    ]


def model_text(gap: SummaryGap) -> str:
    """The model as a scenario at the first run's mass, springs and speed, from rest on it."""
    run = gap.campaign.runs[0]
    header = [
        f"The model of campaign {gap.campaign.name!r} at {run.name}. "
        f"{gap.verdict.capitalize()}: {sentence(gap)}",
        f"Gap: {gap_line(gap)}.",
    ]
    if gap.campaign.scheme == "study":
        header.append("Fitted in the source study's scheme: the exact model moves otherwise on it.")
    tables = known_tables(gap.campaign, run)
    put(tables, gap.last.values)
    tables["initial"] = {"vx": run.surface_speed}
    tables["run"] = {"duration": SETTLING + WINDOW}
    return file_text(scenario_from(gap.campaign, tables), header)


def write_data(gap: SummaryGap, result: Path, model: Path) -> str:
    """JSON and the model; the JSON's text."""
    data = as_json(gap, model.name)
    write_text(model_text(gap), model)
    write_text(data, result)
    return data


def write_corrected(gap: SummaryGap, folder: Path) -> list[Path]:
    """Figures have no camera whose faults could be undone."""
    return []


def as_json(gap: SummaryGap, model: str) -> str:
    """JSON text without NaN; the same answer gives the same bytes. model: name of its file."""
    ends = {"before": gap.gap_before, "after": gap.gap_after}
    data: dict[str, Any] = {name: getattr(gap, name) for name in AS_IT_IS}
    data |= {
        "campaign": gap.campaign.name,
        "gap": {end: {"fit": fit, "held_out": held} for end, (fit, held) in ends.items()},
        "ranking": [ranked(row) for row in gap.ranking],
        "determined": {
            key: {"value": value, "low": low, "high": high}
            for key, (value, low, high) in gap.determined.items()
        },
        "observations": [
            {"run": one.name, "figure": one.figure, "value": one.size, "sd": one.sd}
            for one in gap.observations
        ],
        "model": model,
        "doubts": (),
        "next_experiment": None,
        "empirical": None,
        "remarks": _remarks(gap),
    }
    return json_text(tree(data))


def _remarks(gap: SummaryGap) -> list[str]:
    """Of the campaign and of the answer, each once."""
    return list(dict.fromkeys((*gap.campaign.remarks, *gap.remarks)))


def write_page(
    gap: SummaryGap,
    folder: Path,
    file: Path,
    drawn: Callable[[], object],
    corrected: Sequence[Path] = (),
) -> None:
    """The figure into the folder, and the page with it inside. drawn : called after it."""
    html = render(
        "summary.html.j2", __package__ or "", gap=gap, text=text, digits=digits,
        sentence=sentence(gap), gap_line=gap_line(gap), quantities=quantities(gap),
        quantity=quantity, pictures=write_pictures(drawers(gap), folder, drawn),
        remarks=_remarks(gap),
    )  # fmt: skip
    write_text(html, file)


def drawers(gap: SummaryGap) -> dict[str, Callable[[], Picture]]:
    """name -> what draws it, in the page's order."""
    return {"observations": partial(draw_observations, gap)}


@picture("observations", **FIGURES["observations"])
def draw_observations(gap: SummaryGap) -> Figure:
    """A row for each observation."""
    models = [("as known", GREY, gap.printed), ("plain model, refitted", BLUE, gap.plain)]
    if gap.extended is not None:
        models.append(("extended model", RED, gap.extended))
    figure, axes = panels(1, 1, height=1.4 + 0.5 * len(gap.observations), width=6.5)
    axis, places = axes[0, 0], np.arange(len(gap.observations))
    axis.axvspan(-2.0, 2.0, color=PALE_GREY, zorder=0)
    axis.axvline(0.0, color=INK, linewidth=0.8)
    for shift, (label, colour, model) in zip((-0.18, 0.0, 0.18), models, strict=False):
        axis.plot(model.residuals, places + shift, "o", color=colour, markersize=6.0, label=label)
    names = [f"{one.figure.replace('_', ' ')}, {one.name}" for one in gap.observations]
    axis.set_yticks(places, names)
    axis.invert_yaxis()
    axis.set_xscale("symlog", linthresh=3.0)
    axis.set_xlabel("modelled less observed [standard deviations]")
    figure.legend(loc="outside upper right", ncols=3)
    return figure
