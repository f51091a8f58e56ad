"""Judged claims as data, which is what `reproduction.json` holds, and as one HTML page."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any

import numpy as np
from stickslip.reference.scheme_errors import DESCRIPTIONS

from cosim.report.page import render

from .attributions import Attribution, Datasets
from .claim import (
    CANNOT_BE_CHECKED,
    DOES_NOT_HOLD,
    FOLLOWS,
    HOLDS,
    ONLY_WITH_FAULT,
    UNDECIDED,
    Claim,
    Row,
)
from .readings import MARKS, Outcome

#: The study's faults that are no switch of the scheme but stand behind a verdict.
OTHER_FAULTS = {
    "F9": "one pass of the belt is counted, all heat goes to it, a conductivity is used as a rate",
    "F11": "the product of the friction force is misprinted: 4.0349 N by its own factors",
}


def as_data(
    claims: list[Claim], wall_time: float | None = None, datasets: Datasets | None = None
) -> dict[str, Any]:
    """A tree of plain values; numbers that a model does not have are None."""
    return _plain(
        {
            "datasets": _datasets(datasets) if datasets else None,
            "referee": [_referee(one) for one in claims],
            "claims": [_claim(one) for one in claims],
            "faults": DESCRIPTIONS | OTHER_FAULTS,
            "wall_time": wall_time,
        }
    )


def _referee(claim: Claim) -> dict[str, Any]:
    """A claim in the referee's table: how firm its verdict is."""
    return {
        "id": claim.id,
        "claim": claim.title,
        "place": claim.place,
        "verdict": claim.verdict,
        "scope": claim.scope,
        "margins": [asdict(one) | {"text": one.text} for one in claim.margins],
        "steady": claim.steady,
        "turns": [asdict(one) for one in claim.turns],
        "rests_on": claim.rests,
    }


def _datasets(datasets: Datasets) -> dict[str, Any]:
    """The study's datasets in every reading of its scheme."""
    return {
        "says": datasets.says,
        "bears": datasets.bears,
        "found": datasets.found,
        "marks": [asdict(mark) for mark in MARKS],
        "readings": [_outcome(one) for one in datasets.outcomes],
        "attributions": [_attribution(one) for one in datasets.attributions],
    }


def _outcome(outcome: Outcome) -> dict[str, Any]:
    return {
        "reading": outcome.reading.name,
        "place": outcome.reading.place,
        "values": list(outcome.values),
        "met": list(outcome.met),
        "turned_by_1deg_after_s": outcome.onset,
    }


def _attribution(one: Attribution) -> dict[str, Any]:
    return asdict(one) | {
        "reading": one.reading.name,
        "quarter_fits_better": one.quarter_fits_better,
        "one_spring_explains": one.one_spring_explains,
    }


def _claim(claim: Claim) -> dict[str, Any]:
    return {
        "id": claim.id,
        "title": claim.title,
        "place": claim.place,
        "first": claim.first,
        "verdict": claim.verdict,
        "scope": claim.scope,
        "word": claim.word,
        "faults": list(claim.faults),
        "reason": claim.reason,
        "checks": [
            asdict(check) | {"verdict": check.verdict, "faults": list(check.faults)}
            for check in claim.checks
        ],
        "numbers": [_number(row) for row in claim.rows],
        "remarks": list(claim.remarks),
        "assumed": list(claim.assumed),
        "figures": [f"{picture.name}.png" for picture in claim.pictures],
    }


def _number(row: Row) -> dict[str, Any]:
    """The study's number stands beside its place, not in a tree of its own."""
    data = {key: value for key, value in asdict(row).items() if key != "digits"}
    study = data.pop("study") or {"value": None, "place": ""}
    return data | {"study": study["value"], "place": study["place"]}


def _plain(value: Any) -> Any:
    """NaN and infinities are no JSON, numpy's numbers neither."""
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


CLASSES = {
    HOLDS: "holds",
    FOLLOWS: "follows",
    ONLY_WITH_FAULT: "fault",
    UNDECIDED: "undecided",
    DOES_NOT_HOLD: "fails",
    CANNOT_BE_CHECKED: "unknown",
}
#: The verdicts after a number of claims.
COUNTED = {
    HOLDS: "hold",
    FOLLOWS: "follow from an assumption",
    ONLY_WITH_FAULT: "hold only with a fault",
    UNDECIDED: "are undecided",
    DOES_NOT_HOLD: "do not hold",
    CANNOT_BE_CHECKED: "cannot be checked",
}
#: Changes of assumptions that are told of a claim in the referee's table.
TOLD = 3
MODELS = ("printed", "mended", "exact")


def page(claims: list[Claim], faults: dict[str, str], datasets: Datasets | None = None) -> str:
    """HTML with every picture inside; ``faults`` are the descriptions of the scheme's."""
    counts = {COUNTED[word]: sum(claim.word == word for claim in claims) for word in CLASSES}
    return render(
        "report.html.j2",
        "cosim.studies.reproduction",
        claims=claims,
        classes=CLASSES,
        models=MODELS,
        faults=faults | OTHER_FAULTS,
        counts=counts,
        leading=leading,
        datasets=datasets,
        marks=MARKS,
        told=TOLD,
    )


def leading(claim: Claim) -> Row:
    """The row that stands for a claim in the first table."""
    return claim.rows[claim.leading]
