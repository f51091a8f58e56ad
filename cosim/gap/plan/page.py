"""The answer as one self-contained HTML page, and its figures as files."""

from __future__ import annotations

from pathlib import Path

from cosim.files import write_bytes, write_text
from cosim.report.page import render

from .data import alone_text, percent_text, run_text, size_text
from .figures import draw_pairs, draw_sizes
from .plan import Plan


def write_page(plan: Plan, folder: Path, file: Path) -> None:
    """Both figures into the folder, and the page with them inside."""
    pictures = [draw_sizes(plan), draw_pairs(plan)]
    for one in pictures:
        write_bytes(one.png, folder / f"{one.name}.png")
    text = render(
        "plan.html.j2",
        "cosim.gap.plan",
        plan=plan,
        campaign=plan.planned.campaign,
        pictures={one.name: one for one in pictures},
        size_text=size_text,
        alone_text=alone_text,
        percent_text=percent_text,
        run_text=run_text,
    )
    write_text(text, file)
