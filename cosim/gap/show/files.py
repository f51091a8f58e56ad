"""What a finished answer leaves behind: numbers and model first, then figures and the page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

from cosim.files import write_bytes, write_text
from cosim.gap.result import Gap
from cosim.interrupts import held_interrupts
from cosim.report.page import Picture
from cosim.studies.reproduction.summary import SummaryGap

from . import corrected, summary, text
from .answer_figures import draw_ladder, draw_laws, run_picture
from .model_file import model_text
from .model_file import safe_name as safe_name
from .numbers import as_json
from .page import page
from .reproduction import reproduction_line
from .run_figures import overlay, residual_picture
from .tracks import channels


def write_data(gap: Gap | SummaryGap, result: Path, model: Path) -> str:
    """JSON and the model; the JSON's text."""
    data = as_json(gap, model.name)
    text_of = summary.model_text(gap) if isinstance(gap, SummaryGap) else model_text(gap)
    write_text(text_of, model)
    write_text(data, result)
    return data


def write_corrected_data(gap: Gap | SummaryGap, folder: Path) -> list[Path]:
    """The data freed of the camera's faults that were named; [] where none was."""
    return [] if isinstance(gap, SummaryGap) else corrected.write_corrected(gap, folder)


def write_page(
    gap: Gap | SummaryGap,
    folder: Path,
    file: Path,
    drawn: Callable[[], object],
    corrected: Sequence[Path] = (),
) -> None:
    """Every figure into the folder, and the page with all of them inside.

    drawn : called after each figure. Between two figures a KeyboardInterrupt passes. corrected :
    data freed of the camera's faults
    """
    pictures: list[Picture] = []
    for draw in drawers(gap):
        with held_interrupts():
            one = draw()
            write_bytes(one.png, folder / f"{one.name}.png")
        pictures.append(one)
        drawn()
    if isinstance(gap, SummaryGap):
        html = summary.page(gap, pictures)
    else:
        with held_interrupts():
            html = page(gap, pictures, reproduction_line(gap), corrected)
    write_text(html, file)


def drawers(gap: Gap | SummaryGap) -> list[Callable[[], Picture]]:
    """Functions that draw, in the page's order."""
    if isinstance(gap, SummaryGap):
        return [partial(summary.draw_observations, gap)]
    curve = [partial(draw_laws, gap)] if gap.laws else []
    overlays = [partial(overlay, gap, channel) for channel in channels(gap)]
    return [
        partial(draw_ladder, gap), *curve, partial(run_picture, gap),
        partial(residual_picture, gap), *overlays,
    ]  # fmt: skip


def closing_lines(gap: Gap | SummaryGap) -> list[str]:
    """What a terminal says at the end."""
    if isinstance(gap, SummaryGap):
        return summary.closing_lines(gap)
    return text.closing_lines(gap)
