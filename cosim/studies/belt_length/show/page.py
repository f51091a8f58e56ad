"""The page of the study: what was asked, the answer first, its figures, how sure it is, and why."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from markupsafe import Markup, escape

from cosim.report.material import page_of_material
from cosim.report.page import Picture, render

from ..lengths import LONGEST, length_text
from ..required_length import Answer, Question
from ..result import Row, Study
from ..unknowns import unknowns_of
from .verdict import verdict
from .wording import percent, span, two_digits

_MINUS = re.compile(r"(?<=[ (])-(?=\d)")
#: Sentences that stand open; the rest is folded.
MOST_SENTENCES = 6
FILES = {
    "belt_length.json": "everything on this page and more, numbers in full",
    "belt_length.csv": "a line for each case: length, speed, rises, shortest belts",
    "changes.csv": "what each single change does, for each case",
    "doubt.csv": "what is not known: range, what it does alone, Sobol indices",
}


def _on_page(sentence: str) -> Markup:
    """A sentence of the terminal as a page has it: signs, units, what is typed."""
    text = str(escape(_MINUS.sub("−", sentence).replace("W/m2K", "W/(m² K)")))
    return Markup(re.sub(r"`([^`]+)`", r"<code>\1</code>", text))


def page(
    study: Study,
    pictures: Sequence[Picture],
    *,
    name: str | None = None,
    scenario: str | None = None,
    command: str = "",
) -> str:
    """HTML of a study with rows; name, scenario (TOML): of an own rig."""
    answers, doubted = study.answers, study.most_doubted
    start, *rest = study.worst.changes
    html = render(
        "belt_length.html.j2",
        "cosim.studies.belt_length.show",
        name=name or "The source study's rig",
        limit=study.options.limit,
        headline=headline(study),
        tiles=tiles(study),
        sentences=[_on_page(sentence) for sentence in verdict(study)],
        most=MOST_SENTENCES,
        answers=answers,
        rows=study.rows,
        layers=study.rows[0].case.thermal().belt.stack,
        changes=[start, *sorted(rest, key=lambda one: abs(one.run))],
        worst=study.worst.case,
        doubts=[] if doubted is None else _doubts(doubted),
        evaluations=max((one.evaluations for one in answers), default=0),
        unexplained=max((max(one.unexplained) for one in answers), default=0.0),
        reasons=list(dict.fromkeys(one.reason for one in answers if one.reason)),
        pictures={one.name: one for one in pictures},
        scenario=scenario,
        command=command,
        files=FILES,
        two_digits=lambda value: two_digits(value).replace("-", "−"),
        percent=percent,
        metres=length_text,
    )
    return page_of_material(html, study.material)


def _doubts(row: Row) -> list[dict[str, Any]]:
    """What is not known, the most important first; then what is."""
    table = [] if row.uncertainty is None else row.uncertainty.table()
    ranked = sorted(table, key=lambda one: -float(str(one["total"])))
    return [*ranked, *(vars(one) for one in unknowns_of(row.case) if one.fixed)]


#: Figures below the picture.
TILES = 4


def headline(study: Study) -> str:
    """How long the belt must be: of an own rig, or whether the asked ones of the study's do."""
    if study.answers:
        return " ".join(_of_own_rig(answer) for answer in study.answers[:2])
    limit, shortest = study.options.limit, min(row.case.length for row in study.rows)
    rows = [row for row in study.rows if row.case.length == shortest]
    rises = [row.drift.run for row in rows]
    when = f"after {rows[0].case.protocol.in_words()}"
    warm = f"{when} it meets the block {span(rises)} K above the air, {limit:g} K are allowed"
    speeds = ", ".join(f"{speed:g}" for speed in sorted({row.case.speed for row in rows}))
    enough = sum(rise <= limit for rise in rises)
    word = {0: "is too short", len(rows): "suffices"}.get(enough, f"suffices in {enough} cases")
    return f"A belt of {shortest:g} m {word} at {speeds} m/s: {warm}."


def _of_own_rig(answer: Answer) -> str:
    run, when = answer.run, f"after {answer.case.protocol.in_words()}"
    asked = f"comes round less than {answer.limit:g} K above the air at {answer.case.speed:g} m/s"
    if run.shortest is None:
        return f"No belt up to {LONGEST:g} m {asked} {when}."
    belt = f"A belt of {length_text(run.shortest)} m"
    if run.shortest <= answer.case.shortest:
        belt = f"Any belt with room for contact and rollers, from {length_text(run.shortest)} m,"
    told = f"{belt} {asked} {when}, {_ever(run)} for ever, if the rig is as given"
    if not (run.median and run.high):
        return f"{told}."
    half, most = (level.in_words.removesuffix(" m") for level in (run.median, run.high))
    sure = f"{told}; to be sure of half of the rigs that it may be takes {half} m for the runs"
    return f"{sure}." if half == most else f"{sure}, of 95 % {most} m."


def _ever(run: Question) -> str:
    if run.for_ever is None:
        return f"none up to {LONGEST:g} m"
    return f"one of {length_text(run.for_ever)} m"


def tiles(study: Study) -> list[tuple[str, str]]:
    """The first answer's lengths, or the shortest belts of the study's rig by speed."""
    if study.answers:
        return _tiles_of_own_rig(study.answers[0])
    speeds = sorted({row.case.speed for row in study.rows})
    told = [
        (f"shortest belt for the runs at {speed:g} m/s", _longest(study.rows, speed))
        for speed in speeds
    ]
    worst = study.worst
    where = f"rise on {worst.case.length:g} m at {worst.case.speed:g} m/s, the largest"
    return [*told[: TILES - 1], (where, f"{two_digits(worst.drift.run)} K")]


def _longest(rows: Sequence[Row], speed: float) -> str:
    found = [row.shortest_run for row in rows if row.case.speed == speed]
    known = [length for length in found if length is not None]
    if len(known) < len(found):
        return f"more than {LONGEST:g} m"
    return f"{length_text(max(known))} m"


def _tiles_of_own_rig(answer: Answer) -> list[tuple[str, str]]:
    run, case = answer.run, answer.case
    needed = length_text(run.shortest) + " m" * (run.shortest is not None)
    time = f"shortest belt for {case.protocol.in_words()}"
    told = [(f"{time}, as the rig is given; {_ever(run).removeprefix('one of ')} for ever", needed)]
    told += [
        (f"enough for the runs in {part} of the rigs that it may be", level.in_words)
        for part, level in (("half", run.median), ("95 %", run.high))
        if level is not None
    ]
    on_own = f"rise on the belt of {case.length:g} m, as the rig is given"
    return [*told, (on_own, f"{two_digits(run.rise)} K")]
