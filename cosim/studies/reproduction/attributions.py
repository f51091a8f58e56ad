"""C5 to C7 under every reading of the scheme that the study's two datasets leave standing."""

from collections.abc import Sequence
from typing import Any

from cosim.report.page import sentences, texts

from . import readings
from .cases import DATASETS
from .claims.friction_level import misfit, observed
from .claims.rotation import ROTATES, turns_far_and_near
from .readings import AS_PRINTED, MARKS, Reading, outcome, reading_figures, rotation

#: Claims that this bears on.
CLAIMS = ("C5", "C6", "C7")
Row = dict[str, Any]


def attribution(reading: Reading) -> Row:
    """What a reading makes of the claims, and which mended fault undoes it.

    rotates: #1 turns by more than the study's least (C5); without: #1's largest rotation with each
    of F2 and F13 mended, deg. misfits: with mu full, with a quarter, with mu full and F1 mended
    (C6): the quarter fits better, as the study has it, and F1 alone better than the quarter. both:
    #1 turns far and #2 stays within what was measured (C7).
    """

    def fit(one: Reading, dataset: int) -> float:
        return misfit(observed(lambda k: reading_figures(one, dataset, stiffness=k)))

    full, quarter, mended = fit(reading, 1), fit(reading, 2), fit(reading.mended("F1"), 1)
    turned = [rotation(reading, dataset) for dataset in DATASETS]
    return {
        "rotates": turned[0] > ROTATES,
        "without": {fault: rotation(reading.mended(fault), 1) for fault in ("F2", "F13")},
        "misfits": (full, quarter, mended),
        "both": turns_far_and_near(*turned),
        "quarter_fits_better": quarter < full,
        "one_spring_explains": mended < quarter,
        "reading": reading.name,
    }


def datasets() -> Row:
    """Every reading beside the marks, and the claims as printed and under those that stand."""
    bearing = dict.fromkeys([AS_PRINTED, *readings.standing()])
    return as_data([*map(outcome, readings.READINGS)], [*map(attribution, bearing)])


def as_data(outcomes: Sequence[Row], every: Sequence[Row]) -> Row:
    """Whether the scheme gives the study's two datasets, in every reading; for JSON and page.

    says: what came of it, in sentences; bears: what it does to the three claims.
    """
    of, most = {one["reading"]: one for one in outcomes}, max(sum(one["met"]) for one in outcomes)
    shown = [of[one.name] for one in (AS_PRINTED, readings.BALANCED, readings.ROUNDED)]
    closest = [one["reading"] for one in outcomes if sum(one["met"]) == most]
    written = texts("datasets.txt.j2", __package__ or "", {"MARKS": MARKS, "ROTATES": ROTATES})
    return {
        "says": " ".join(sentences(written.says(most, closest, *shown))),
        "bears": " ".join(sentences(written.bears(every))),
        "found": most == len(MARKS),
        "marks": MARKS,
        "readings": outcomes,
        "attributions": every,
    }
