"""Judged claims as data, which is what `reproduction.json` holds, and as one HTML page."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from stickslip.reference.scheme_errors import DESCRIPTIONS

from cosim.report.files import without_nan
from cosim.report.page import render

from .claim import Claim

#: The study's faults that are no switch of the scheme but stand behind a verdict.
OTHER_FAULTS = {
    "F9": "one pass of the belt is counted, all heat goes to it, a conductivity is used as a rate",
    "F11": "the product of the friction force is misprinted: 4.0349 N by its own factors",
}


def as_data(
    claims: list[Claim], wall_time: float | None = None, datasets: dict[str, Any] | None = None
) -> dict[str, Any]:
    """A tree of plain values; numbers that a model does not have are None."""
    found: dict[str, Any] = without_nan(
        {
            "datasets": datasets,
            "referee": [_referee(one) for one in claims],
            "claims": [_claim(one) for one in claims],
            "faults": DESCRIPTIONS | OTHER_FAULTS,
            "wall_time": wall_time,
        }
    )
    return found


def _named(one: object, *names: str) -> dict[str, Any]:
    return {name: getattr(one, name) for name in names}


def _referee(claim: Claim) -> dict[str, Any]:
    """A claim in the referee's table: how firm its verdict is."""
    return _named(claim, "id", "place", "verdict", "scope", "steady") | {
        "claim": claim.title,
        "margins": [asdict(one) | {"text": one.text} for one in claim.margins],
        "turns": [asdict(one) for one in claim.turns],
        "rests_on": claim.rests,
    }


def _claim(claim: Claim) -> dict[str, Any]:
    words = ("id", "title", "place", "first", "verdict", "scope", "word", "faults", "reason")
    return _named(claim, *words, "remarks", "assumed") | {
        "checks": [asdict(check) | {"verdict": check.verdict} for check in claim.checks],
        "numbers": [asdict(row) for row in claim.rows],
        "figures": [f"{picture.name}.png" for picture in claim.pictures],
    }


def page(
    claims: list[Claim], faults: dict[str, str], datasets: dict[str, Any] | None = None
) -> str:
    """HTML with every picture inside; ``faults`` are the descriptions of the scheme's."""
    return render(
        "report.html.j2", "cosim.studies.reproduction", claims=claims, datasets=datasets,
        faults=faults | OTHER_FAULTS, words=[claim.word for claim in claims],
    )  # fmt: skip
