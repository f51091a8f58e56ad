"""The reproduction as one self-contained HTML page: verdicts first, then each claim."""

from __future__ import annotations

import math
from importlib import resources

from jinja2 import Environment, StrictUndefined

from cosim.report.inline import inline

from .attributions import Datasets
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
from .readings import MARKS
from .result import OTHER_FAULTS

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
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {"number": number, "inline": inline}
    source = resources.files(__package__).joinpath("report.html.j2").read_text(encoding="utf-8")
    counts = {COUNTED[word]: sum(claim.word == word for claim in claims) for word in CLASSES}
    return environment.from_string(source).render(
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


def number(value: float | str | None, digits: int = 4) -> str:
    """So many significant digits, plain text as it is, a dash for none."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return "–"
    if isinstance(value, str):
        return value
    return f"{value:.{digits}g}".replace("-", "−")


def leading(claim: Claim) -> Row:
    """The row that stands for a claim in the first table."""
    return claim.rows[claim.leading]
