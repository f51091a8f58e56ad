"""The answer as one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

from cosim.gap.camera.faults import fault_of
from cosim.gap.doubts.doubt import not_looked, rounded
from cosim.gap.result import Gap
from cosim.report.page import Picture, render
from cosim.studies.reproduction.summary import SummaryGap

from .model_file import model_text
from .quantities import quantities
from .reproduced import Reproduced
from .words import (
    SENTENCES,
    TABLE_SENTENCE,
    bound_lines,
    faults_of,
    fitted_quantities,
    formula,
    gap_line,
    held_out,
    next_experiment,
    percent,
    powers_lines,
    probability,
    reason,
    sentence,
    spreads_line,
)


def page(
    gap: Gap | SummaryGap,
    pictures: Sequence[Picture],
    reproduced: Sequence[Reproduced] = (),
    corrected: str = "",
) -> str:
    """HTML with every picture inside; corrected : where data are freed of the camera's faults."""
    figures_only = isinstance(gap, SummaryGap)
    return render(
        "gap.html.j2",
        "cosim.gap.show",
        gap=gap,
        campaign=gap.campaign,
        figures_only=figures_only,
        unit="standard deviations" if figures_only else "noise units",
        pictures={one.name: one for one in pictures},
        reproduced=reproduced,
        reason=reason(gap),
        gap_line=gap_line(gap),
        numbers=fitted_quantities(gap),
        determined=_determined(gap),
        ranking=_best_laws(gap),
        next_experiment=next_experiment(gap),
        formula=formula(gap) if gap.empirical else "",
        model=model_text(gap),
        sentences=SENTENCES,
        remarks=[*gap.campaign.remarks, *gap.remarks],
        percent=percent,
        evidence=_evidence,
        probability=probability,
        corrected=corrected,
        held_out=partial(held_out, gap),
        bounds=bound_lines(gap),
        doubts=gap.doubts if isinstance(gap, Gap) else (),
        **({} if isinstance(gap, SummaryGap) else _of_runs(gap)),
    )


def _evidence(value: float | None) -> str:
    """Without an exponent; a dash for none."""
    return "–" if value is None else rounded(value).replace("-", "−")


def _of_runs(gap: Gap) -> dict[str, Any]:
    """What only runs with a time series tell."""
    return {
        "powers": powers_lines(gap),
        "spreads": spreads_line(gap),
        "faults": faults_of(gap),
        "not_looked": "" if gap.searched else sentence(not_looked(gap.doubts)),
        "table": sentence(TABLE_SENTENCE) if any(law.in_model for law in gap.laws) else "",
    }


def _determined(gap: Gap | SummaryGap) -> list:
    """Plain parameters with their intervals."""
    values = {key: value for key, (value, _, _) in gap.determined.items()}
    return quantities(values, {key: pair[1:] for key, pair in gap.determined.items()})


def _best_laws(gap: Gap | SummaryGap) -> list[dict[str, Any]]:
    """The best law of each effect, best first, with its numbers."""
    rows: dict[str, dict[str, Any]] = {}
    for row in gap.ranking:
        added = [
            key
            for key in row.parameters
            if key.startswith(f"{row.effect}.") or fault_of(key) == row.effect
        ]
        numbers = quantities(row.parameters, row.intervals, added, row.undetermined)
        rows.setdefault(row.effect, {"row": row, "numbers": numbers})
    return list(rows.values())
