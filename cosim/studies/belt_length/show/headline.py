"""What stands on top of the page, and in a notebook: how long the belt must be, and figures."""

from __future__ import annotations

from ..lengths import LONGEST, length_text
from ..required_length import Answer, Question
from ..result import Study
from .wording import span, two_digits

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
    one = "" if run.for_ever is None else "one of "
    told = f"{belt} {asked} {when}, {one}{_ever(run)} for ever, if the rig is as given"
    if not (run.median and run.high):
        return f"{told}."
    half, most = (level.in_words.removesuffix(" m") for level in (run.median, run.high))
    sure = f"{told}; to be sure of half of the rigs that it may be takes {half} m for the runs"
    return f"{sure}." if half == most else f"{sure}, of 95 % {most} m."


def _ever(run: Question) -> str:
    return f"none up to {LONGEST:g} m" if run.for_ever is None else f"{length_text(run.for_ever)} m"


def tiles(study: Study) -> list[tuple[str, str]]:
    """The first answer's lengths, or the shortest belts of the study's rig by speed."""
    if study.answers:
        return _tiles_of_own_rig(study.answers[0])
    told = []
    for speed in sorted({row.case.speed for row in study.rows})[: TILES - 1]:
        found = [row.shortest_run for row in study.rows if row.case.speed == speed]
        known = [length for length in found if length is not None]
        longest = f"{length_text(max(known))} m" if known == found else f"more than {LONGEST:g} m"
        told.append((f"shortest belt for the runs at {speed:g} m/s", longest))
    worst = study.worst
    where = f"rise on {worst.case.length:g} m at {worst.case.speed:g} m/s, the largest"
    return [*told, (where, f"{two_digits(worst.drift.run)} K")]


def _tiles_of_own_rig(answer: Answer) -> list[tuple[str, str]]:
    run, case = answer.run, answer.case
    needed = length_text(run.shortest) + " m" * (run.shortest is not None)
    time = f"shortest belt for {case.protocol.in_words()}"
    told = [(f"{time}, as the rig is given; {_ever(run)} for ever", needed)]
    told += [
        (f"enough for the runs in {part} of the rigs that it may be", level.in_words)
        for part, level in (("half", run.median), ("95 %", run.high))
        if level is not None
    ]
    on_own = f"rise on the belt of {case.length:g} m, as the rig is given"
    return [*told, (on_own, f"{two_digits(run.rise)} K")]
