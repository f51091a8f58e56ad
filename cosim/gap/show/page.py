"""The answer as one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from cosim.gap.result import Gap
from cosim.report.page import Picture, render

from . import text
from .numbers import remarks
from .quantities import digits, fitted_quantities, with_digits
from .tracks import shown_runs

FIRST = ("ladder", "curve", "run")


def page(
    gap: Gap, pictures: Sequence[Picture], reproduction: str = "", corrected: Sequence[Path] = ()
) -> str:
    """HTML with every picture inside; corrected : files of data freed of the camera's faults."""
    quantities = fitted_quantities(gap)
    rates = gap.rates.table.values() if gap.rates else ()
    return render(
        "gap.html.j2", "cosim.gap.show", gap=gap, text=text, digits=digits,
        with_digits=with_digits, remarks=remarks(gap), reproduction=reproduction,
        corrected=corrected, quantities=quantities, runs=shown_runs(gap),
        first=[one for one in pictures if one.name in FIRST],
        folded=[one for one in pictures if one.name not in FIRST],
        numbers=[text.numbers_of(gap, row, quantities) for row in gap.ranking],
        answers=list(dict.fromkeys(answer for row in rates for answer in row)),
    )  # fmt: skip
