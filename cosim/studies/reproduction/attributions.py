"""C5 to C7 under every reading of the scheme that the study's two datasets leave standing."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from . import readings
from .claim import WRITTEN
from .claims.friction_level import misfit, observed
from .claims.rotation import ROTATES, turns_far_and_near
from .readings import AS_PRINTED, MARKS, READINGS, Outcome, Reading, outcome, reading_figures

#: Claims that this bears on.
CLAIMS = ("C5", "C6", "C7")


def attribution(reading: Reading) -> dict[str, Any]:
    """What a reading makes of the claims, and which mended fault undoes it.

    rotates: #1 turns by more than the study's least (C5); without: #1's largest rotation with each
    of F2 and F13 mended, deg. misfits: with mu full, with a quarter, with mu full and F1 mended
    (C6): the quarter fits better, as the study has it, and F1 alone better than the quarter. both:
    #1 turns far and #2 stays within what was measured (C7).
    """

    def fit(one: Reading, dataset: int) -> float:
        return misfit(observed(lambda k: reading_figures(one, dataset, stiffness=k)))

    def turned(one: Reading, dataset: int) -> float:
        return reading_figures(one, dataset)["max_rotation"]

    first, second = turned(reading, 1), turned(reading, 2)
    full, quarter, mended = fit(reading, 1), fit(reading, 2), fit(reading.mended("F1"), 1)
    return {
        "rotates": first > ROTATES,
        "without": {fault: turned(reading.mended(fault), 1) for fault in ("F2", "F13")},
        "misfits": (full, quarter, mended),
        "both": turns_far_and_near(first, second),
        "quarter_fits_better": quarter < full,
        "one_spring_explains": mended < quarter,
        "reading": reading.name,
    }


def datasets() -> dict[str, Any]:
    """Every reading beside the marks, and the claims as printed and under those that stand."""
    bearing = dict.fromkeys([AS_PRINTED, *readings.standing()])
    return as_data([outcome(one) for one in READINGS], [attribution(one) for one in bearing])


def as_data(outcomes: Sequence[Outcome], every: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Whether the scheme gives the study's two datasets, in every reading; for JSON and page.

    says: what came of it, in sentences; bears: what it does to the three claims.
    """
    of, written = {one.reading: one for one in outcomes}, WRITTEN["datasets"]
    most = max(sum(one.met) for one in outcomes)
    found = most == len(MARKS)
    says = written["says"].format(
        printed=of[AS_PRINTED].values,
        balanced=of[readings.BALANCED].values,
        rounded=of[readings.ROUNDED],
        marks=len(MARKS),
        most=most,
        closest="; ".join(one.reading.name for one in outcomes if sum(one.met) == most),
    )
    turning = [one["without"] for one in every if one["rotates"]]
    others = "; ".join(one["reading"] for one in every if not one["one_spring_explains"])
    both = [one["reading"] for one in every if one["both"]]
    bears = written["bears"].format(
        all=len(every),
        turning=len(turning),
        ended=[sum(one[fault] < ROTATES for one in turning) for fault in ("F2", "F13")],
        explained=sum(one["one_spring_explains"] for one in every),
        others=f"; not in: {others}" if others else "",
        both=len(both),
        both_in=f": {'; '.join(both)}" if both else "",
    )
    return {
        "says": written["found" if found else "none"].format(said=says),
        "bears": bears,
        "found": found,
        "marks": MARKS,
        "readings": [
            {"values": one.values, "met": one.met, "reading": one.reading.name}
            | {"place": one.reading.place, "turned_by_1deg_after_s": one.onset}
            for one in outcomes
        ],
        "attributions": every,
    }
