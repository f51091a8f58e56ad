"""What stands at the top of the page: the answer in one sentence, and at most four figures."""

from __future__ import annotations

from collections.abc import Sequence

from ..lengths import LONGEST, rounded_up
from ..required_length import Answer
from ..result import Row, Study
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
    warm = f"it meets the block {span(rises)} K above the air, where {limit:g} K is the limit"
    speeds = ", ".join(f"{speed:g}" for speed in sorted({row.case.speed for row in rows}))
    enough = sum(rise <= limit for rise in rises)
    word = {0: "is too short", len(rows): "suffices"}.get(enough, f"suffices in {enough} cases")
    return f"A belt of {shortest:g} m {word} at {speeds} m/s: {warm}."


def _of_own_rig(answer: Answer) -> str:
    run = answer.run
    asked = f"comes round less than {answer.limit:g} K above the air at {answer.case.speed:g} m/s"
    if run.shortest is None:
        return f"No belt up to {LONGEST:g} m {asked}."
    told = f"A belt of {rounded_up(run.shortest)[0]} m {asked}, if the rig is as given"
    if not (run.median and run.high):
        return f"{told}."
    half, most = (level.in_words.removesuffix(" m") for level in (run.median, run.high))
    sure = f"to be sure of half of the rigs that it may be takes {half} m, of 95 % {most} m"
    return f"{told}; {sure}."


def tiles(study: Study) -> list[tuple[str, str]]:
    """The first answer's lengths, or the shortest belts of the study's rig by speed."""
    if study.answers:
        return _tiles_of_own_rig(study.answers[0])
    speeds = sorted({row.case.speed for row in study.rows})
    told = [(f"shortest belt at {speed:g} m/s", _longest(study.rows, speed)) for speed in speeds]
    worst = study.worst
    where = f"rise on {worst.case.length:g} m at {worst.case.speed:g} m/s, the largest"
    return [*told[: TILES - 1], (where, f"{two_digits(worst.drift.run)} K")]


def _longest(rows: Sequence[Row], speed: float) -> str:
    found = [row.shortest_run for row in rows if row.case.speed == speed]
    known = [length for length in found if length is not None]
    if len(known) < len(found):
        return f"more than {LONGEST:g} m"
    return f"{rounded_up(max(known))[0]} m"


def _tiles_of_own_rig(answer: Answer) -> list[tuple[str, str]]:
    run, case = answer.run, answer.case
    needed = "none" if run.shortest is None else f"{rounded_up(run.shortest)[0]} m"
    told = [("shortest belt, as the rig is given", needed)]
    told += [
        (f"enough for {part} of the rigs that it may be", level.in_words)
        for part, level in (("half", run.median), ("95 %", run.high))
        if level is not None
    ]
    on_own = f"rise on the belt of {case.length:g} m, as the rig is given"
    return [*told, (on_own, f"{two_digits(run.rise)} K")]
