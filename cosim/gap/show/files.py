"""What a finished answer leaves behind: numbers and model first, then figures and the page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from cosim.files import write_bytes, write_text
from cosim.gap.result import Gap
from cosim.interrupts import held_interrupts
from cosim.report.page import Picture

from .answer_figures import draw_ladder, draw_laws
from .corrected import write_corrected as write_corrected
from .model_file import model_text
from .model_file import safe_name as safe_name
from .numbers import as_json
from .page import page
from .reproduction import reproduction_line
from .run_figures import draw_overlay, draw_residuals, draw_run
from .text import closing_lines as closing_lines
from .tracks import channels


def write_data(gap: Gap, result: Path, model: Path) -> str:
    """JSON and the model; the JSON's text."""
    data = as_json(gap, model.name)
    write_text(model_text(gap), model)
    write_text(data, result)
    return data


def write_page(
    gap: Gap, folder: Path, file: Path, drawn: Callable[[], object], corrected: Sequence[Path] = ()
) -> None:
    """Every figure into the folder, and the page with all of them inside.

    drawn : called after each figure; corrected : data freed of the camera's faults
    """
    pictures = write_pictures(drawers(gap), folder, drawn)
    with held_interrupts():
        html = page(gap, pictures, reproduction_line(gap), corrected)
    write_text(html, file)


def write_pictures(
    draws: Sequence[Callable[[], Picture]], folder: Path, drawn: Callable[[], object]
) -> list[Picture]:
    """Pictures, each a file as well. Between two of them a KeyboardInterrupt passes."""
    pictures = []
    for draw in draws:
        with held_interrupts():
            pictures.append(draw())
            write_bytes(pictures[-1].png, folder / f"{pictures[-1].name}.png")
        drawn()
    return pictures


def drawers(gap: Gap) -> Sequence[Callable[[], Picture]]:
    """Functions that draw, in the page's order."""
    first = [draw_ladder, draw_laws, draw_run] if gap.laws else [draw_ladder, draw_run]
    return [partial(draw, gap) for draw in first] + [
        partial(_of_channel, draw, gap, channel)
        for draw in (draw_residuals, draw_overlay)
        for channel in channels(gap)
    ]


def _of_channel(draw: Callable[..., Picture], gap: Gap, channel: str) -> Picture:
    drawn = draw(gap, channel)
    return replace(drawn, name=f"{drawn.name}_{channel}")
