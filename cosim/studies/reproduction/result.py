"""Judged claims as data: what `reproduction.json` holds."""

from __future__ import annotations

import json
import math
from dataclasses import asdict
from typing import Any

from stickslip.reference.faults import DESCRIPTIONS

from .claim import Claim

#: The study's faults that are no switch of the scheme but stand behind a verdict.
OTHER_FAULTS = {
    "F9": "one pass of the belt is counted, all heat goes to it, a conductivity is used as a rate",
    "F11": "the product of the friction force is misprinted: 4.0349 N by its own factors",
}


def as_data(claims: list[Claim], wall_time: float | None = None) -> dict[str, Any]:
    """A tree of plain values; numbers that a model does not have are None."""
    return {
        "claims": [_claim(one) for one in claims],
        "faults": DESCRIPTIONS | OTHER_FAULTS,
        "wall_time": wall_time,
    }


def as_json(claims: list[Claim], wall_time: float | None = None) -> str:
    """The same as JSON text, without NaN."""
    return json.dumps(
        as_data(claims, wall_time), indent=2, ensure_ascii=False, allow_nan=False
    ) + "\n"


def _claim(claim: Claim) -> dict[str, Any]:
    return {
        "id": claim.id,
        "title": claim.title,
        "verdict": claim.verdict,
        "word": claim.word,
        "faults": list(claim.faults),
        "reason": claim.reason,
        "checks": [
            asdict(check) | {"verdict": check.verdict, "faults": list(check.faults)}
            for check in claim.checks
        ],
        "numbers": [{key: _plain(value) for key, value in asdict(row).items()
                     if key != "digits"}
                    for row in claim.rows],
        "remarks": list(claim.remarks),
        "assumed": list(claim.assumed),
        "figures": [f"{picture.name}.png" for picture in claim.pictures],
    }


def _plain(value: Any) -> Any:
    """NaN and infinities are no JSON."""
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
