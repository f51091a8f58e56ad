"""What a finished answer leaves behind: numbers and model first, then figures and the page."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path

from cosim.files import write_bytes, write_text
from cosim.fmu.build import own_fmu
from cosim.gap.camera.corrected import write_corrected
from cosim.gap.curves.figure import CURVES
from cosim.gap.result import Gap
from cosim.interrupts import held_interrupts
from cosim.report.page import Picture
from cosim.report.style import png
from cosim.studies.reproduction.summary import SummaryGap

from .model_file import model_text
from .model_file import safe_name as safe_name
from .numbers import as_json
from .page import page
from .regime_figure import draw_regimes
from .reproduced import Reproduced
from .reproduction import reproduce, reproduced_runs
from .reproduction_figure import reproduction
from .run_figures import overlays, residuals
from .score_figures import (
    analysis_of,
    draw_gaps,
    draw_ladder,
    draw_laws,
    draw_parameters,
    draw_ranking,
)
from .summary_figures import draw_observations
from .words import closing_lines as closing_lines
from .words import faults_of


def write_data(gap: Gap | SummaryGap, result: Path, model: Path) -> str:
    """JSON and the model; the JSON's text."""
    text = as_json(gap, model.name)
    write_text(model_text(gap), model)
    write_text(text, result)
    return text


def write_corrected_data(gap: Gap | SummaryGap, folder: Path) -> list[Path]:
    """The data freed of the camera's faults that were named; [] where none was."""
    if isinstance(gap, SummaryGap) or not faults_of(gap) or gap.extended is None:
        return []
    model = gap.extended
    own = {run.name: run.own for run in model.runs}
    return write_corrected(gap.campaign, {**model.settings, **model.values}, own, folder)


def write_page(
    gap: Gap | SummaryGap,
    folder: Path,
    file: Path,
    drawn: Callable[[], object],
    corrected: str = "",
) -> list[Reproduced]:
    """Every figure into the folder, and the page with all of them inside; what the FMU did.

    drawn : called after each figure. Between two figures a KeyboardInterrupt passes. corrected :
    where data are that were freed of the camera's faults, beside the page; "": there are none
    """
    reproduced = [] if isinstance(gap, SummaryGap) else _reproduced(gap)
    pictures: list[Picture] = []
    for draw in _drawers(gap, reproduced):
        with held_interrupts():
            batch = draw()
            for one in batch:
                write_bytes(one.png, folder / f"{one.name}.png")
        pictures += batch
        drawn()
    write_text(page(gap, pictures, reproduced, corrected), file)
    return reproduced


def _reproduced(gap: Gap) -> list[Reproduced]:
    with held_interrupts():
        fmu = own_fmu()
        return [reproduce(gap, run, fmu) for run in reproduced_runs(gap)]


def _drawers(
    gap: Gap | SummaryGap, reproduced: list[Reproduced]
) -> list[Callable[[], list[Picture]]]:
    """Functions that draw, in the page's order."""
    if isinstance(gap, SummaryGap):
        return [partial(_one, draw_observations, gap), partial(_one, draw_ranking, gap)]
    ladder = [partial(_one, draw_ladder, gap)] if len(gap.ladder) > 1 else []
    ranking = [partial(_one, draw_ranking, gap)] if gap.ranking else []
    curves = [partial(_one, _curves, gap)] if gap.laws else []
    return [
        partial(overlays, gap),
        partial(_one, draw_gaps, gap),
        *ladder,
        *curves,
        partial(_one, residuals, gap),
        *ranking,
        partial(_one, draw_parameters, gap),
        partial(_one, reproduction, gap, reproduced),
        partial(_regimes, gap),
    ]


def _one(draw: Callable[..., Picture], *arguments) -> list[Picture]:
    return [draw(*arguments)]


def _curves(gap: Gap) -> Picture:
    return Picture("curves", CURVES, png(draw_laws(gap)))


def _regimes(gap: Gap) -> list[Picture]:
    return [draw_regimes(analysis_of(gap))]
