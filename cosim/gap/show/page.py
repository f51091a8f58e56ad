"""The answer as one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from cosim.gap.result import Gap
from cosim.report.page import Picture, render

from . import text
from .quantities import digits, fitted_quantities, with_digits
from .tracks import measured_run, run_names


def page(
    gap: Gap, pictures: Sequence[Picture], reproduction: str = "", corrected: Sequence[Path] = ()
) -> str:
    """HTML with every picture inside; corrected : files of data freed of the camera's faults."""
    quantities = fitted_quantities(gap)
    by_name = {one.name: one for one in pictures}
    return render(
        "gap.html.j2",
        "cosim.gap.show",
        gap=gap,
        text=text,
        digits=digits,
        with_digits=with_digits,
        first=[by_name[name] for name in ("ladder", "curve", "run") if name in by_name],
        overlays=[one for one in pictures if one.name.startswith("overlay")],
        residuals=by_name.get("residuals"),
        quantities=[one for one in quantities if not one.owner],
        own_quantities=[one for one in quantities if one.owner],
        numbers=[text.numbers_of(gap, row, quantities) for row in gap.ranking],
        runs=[
            (measured_run(gap, name), gap.plain.run(name), gap.extended.run(name))
            for name in run_names(gap)
        ],
        remarks=tuple(dict.fromkeys((*gap.campaign.remarks, *gap.remarks))),
        answers=_answers(gap),
        reproduction=reproduction,
        corrected=corrected,
    )


def _answers(gap: Gap) -> list[str]:
    """Columns of the table of rates: what was answered at all."""
    rows = gap.rates.table.values() if gap.rates else ()
    return list(dict.fromkeys(answer for row in rows for answer, count in row.items() if count))
