"""The page of the study: what was asked, the answer first, its figures, how sure it is, and why."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from cosim.report.material import page_of_material
from cosim.report.page import Picture, render

from ..lengths import rounded_up
from ..required_length import Answer, Question
from ..result import Row, Study
from ..unknowns import unknowns_of
from .verdict import two_digits, verdict

FILES = {
    "belt_length.json": "everything on this page and more, numbers in full",
    "belt_length.csv": "a line for each case: length, speed, rises, shortest belts",
    "changes.csv": "what each single change does, for each case",
    "doubt.csv": "what is not known: range, what it does alone, Sobol indices",
}


def page(
    study: Study,
    pictures: Sequence[Picture],
    *,
    name: str | None = None,
    scenario: str | None = None,
    command: str = "",
) -> str:
    """HTML of a study; name, scenario (TOML): of an own rig."""
    sentences = verdict(study)
    answers = study.answers
    html = render(
        "belt_length.html.j2",
        "cosim.studies.belt_length.show",
        name=name or "The source study's rig",
        asked=_asked(study),
        headline=sentences[: 2 if answers else 1],
        sentences=sentences[2 if answers else 1 :],
        answers=[row for answer in answers for row in _answer_rows(answer)],
        rows=[] if answers else [_row(row) for row in study.rows],
        layers=_layers(study),
        changes=_changes(study),
        where=_where(study),
        doubts=_doubts(study),
        evaluations=max((one.evaluations for one in answers), default=0),
        unexplained=max((max(one.unexplained) for one in answers), default=0.0),
        reasons=list(dict.fromkeys(one.reason for one in answers if one.reason)),
        pictures={one.name: one for one in pictures},
        scenario=scenario,
        command=command,
        files=FILES,
    )
    return page_of_material(html, study.material)


def _asked(study: Study) -> str:
    if not study.rows:
        return ""
    case = study.rows[0].case
    speeds = ", ".join(f"{speed:g}" for speed in sorted({row.case.speed for row in study.rows}))
    return (
        f"How long must the belt be, so that it meets the ice less than {study.options.limit:g} K"
        f" above the air, at {speeds} m/s, in {case.protocol.in_words()}?"
        f" {case.mass:g} kg of ice rub with a kinetic friction of {case.friction:g}"
        f" ({case.force:.3g} N) in air of {case.ambient_degC:g} °C."
    ).replace(" -", " −")


def _answer_rows(answer: Answer) -> list[tuple[str, ...]]:
    """Question, speed, shortest belts, rise on the own belt, and how sure that one is."""
    return [
        _question_row("comes round cold", answer, answer.run, _metres(answer.run.for_ever)),
        _question_row("interface steady", answer, answer.interface, "–"),
    ]


def _question_row(what: str, answer: Answer, question: Question, ever: str) -> tuple[str, ...]:
    own = two_digits(question.rise)
    if question.rises is not None:
        own += f" ({two_digits(question.rises[0])} to {two_digits(question.rises[2])})"
    return (
        what,
        f"{answer.case.speed:g}",
        _metres(question.shortest),
        *(level.says if level else "–" for level in question.levels),
        ever,
        f"{answer.case.length:g}",
        own,
        "–" if question.share is None else f"{100.0 * question.share:.0f} %",
    )


def _metres(length: float | None) -> str:
    return "none" if length is None else rounded_up(length)[0]


def _row(row: Row) -> tuple[str, ...]:
    """Of a study without an own rig: length, speed, rises, shortest belts."""
    known, drift = row.uncertainty, row.drift
    doubt = "–" if known is None else f"{two_digits(known.low)} to {two_digits(known.high)}"
    return (
        f"{row.case.length:g}",
        f"{row.case.speed:g}",
        f"{row.case.film:.2g}",
        two_digits(drift.study),
        two_digits(drift.run),
        doubt,
        two_digits(drift.steady),
        two_digits(drift.interface_drift),
        _metres(row.shortest_run),
        "–" if row.wait.begin is None else two_digits(row.wait.begin),
    )


def _layers(study: Study) -> list[tuple[str, ...]]:
    """Thickness, density, heat capacity, conductivity of each, the contact face first."""
    if not study.rows:
        return []
    return [
        (
            f"{1e3 * layer.thickness:g}",
            f"{layer.density:g}",
            f"{layer.heat_capacity:g}",
            f"{layer.conductivity:g}",
        )
        for layer in study.rows[0].case.thermal().belt.stack
    ]


def _where(study: Study) -> str:
    if not study.rows:
        return ""
    return f"{study.worst.case.length:g} m at {study.worst.case.speed:g} m/s"


def _changes(study: Study) -> list[tuple[str, str, str]]:
    """What each change alone leaves, of the case that drifts most, the best first."""
    if not study.rows:
        return []
    start, *rest = study.worst.changes
    ranked = [start, *sorted(rest, key=lambda one: abs(one.run))]
    return [(one.what, two_digits(one.run), two_digits(one.interface_drift)) for one in ranked]


def _doubts(study: Study) -> list[dict[str, Any]]:
    """What is not known, the most important first; then what is."""
    known = [row for row in study.rows if row.uncertainty is not None]
    if not known:
        return []
    row = max(known, key=lambda one: one.drift.run)
    doubt = row.uncertainty
    if doubt is None:
        return []
    ranked = sorted(doubt.table(), key=lambda one: -float(str(one["total"])))
    fixed = [
        {name: getattr(one, name) for name in ("key", "says", "low", "high", "unit", "basis")}
        for one in unknowns_of(row.case)
        if one.fixed
    ]
    return [*ranked, *fixed]
