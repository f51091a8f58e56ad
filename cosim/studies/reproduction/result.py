"""Judged claims as a result, which can become what `stickslip reproduce` leaves."""

import re
from collections import Counter
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

from stickslip.reference.scheme_options import DESCRIPTIONS

from cosim.report.files import plain_data, write_json
from cosim.report.page import render, texts, write_page
from cosim.result import Result

from .claim import WRITTEN, Claim

RESULT, PAGE = "reproduction.json", "report.html"
#: The study's faults: those of its scheme, and two more that stand behind a verdict.
FAULTS = DESCRIPTIONS | WRITTEN["faults"]


class Reproduction(list[Claim], Result):
    """Claims in the study's order, each judged.

    wall_time : that they took, s; None where nobody has looked

    >>> from cosim.studies.reproduction import reproduce
    >>> found = reproduce(["C1"])
    >>> found.summary()["claims"][0]["verdict"], found.save("results/claims").name
    ('holds', 'claims')
    """

    wall_time: float | None = None

    @cached_property
    def datasets(self) -> Any:
        """The study's datasets in every reading, where a claim hangs on them; None elsewhere."""
        from .attributions import CLAIMS, datasets

        return datasets() if {claim.id for claim in self} & set(CLAIMS) else None

    def summary(self) -> dict[str, Any]:
        """What `reproduction.json` holds; numbers that a model does not have are None."""
        found = {
            "datasets": self.datasets,
            "referee": [_referee(claim) for claim in self],
            "claims": [_told(claim) for claim in self],
            "faults": FAULTS,
            "wall_time": self.wall_time,
        }
        return dict(plain_data(found))

    def _answer(self) -> tuple[str, Sequence[tuple[str, str]]]:
        verdicts = Counter(claim.verdict for claim in self)
        return f"{len(self)} claims are judged.", [(name, str(n)) for name, n in verdicts.items()]

    def _page(self) -> str:
        return render(
            "report.html.j2", __package__ or "", claims=self, datasets=self.datasets,
            faults=FAULTS, words=[claim.word for claim in self],
        )  # fmt: skip

    def _write(self, folder: Path) -> None:
        """Numbers first, then figures, then the page."""
        write_json(self.summary(), folder / RESULT)
        write_page(self._page(), [one for claim in self for one in claim.pictures], folder)


def printed(claims: Reproduction) -> str:
    """What the command prints."""
    written = texts("printed.txt.j2", __package__ or "", {})
    return str(written.printed(claims, DESCRIPTIONS, _names))


def _names(text: str, code: str) -> bool:
    return re.search(rf"\b{code}\b", text) is not None


def _named(claim: Claim, words: str) -> dict[str, Any]:
    return {word: getattr(claim, word) for word in words.split()}


def _referee(claim: Claim) -> dict[str, Any]:
    """A claim in the referee's table: how firm its verdict is."""
    return _named(claim, "id place verdict scope steady") | {
        "claim": claim.title,
        "margins": [vars(one) | {"text": one.text} for one in claim.margins],
        "turns": claim.turns,
        "rests_on": claim.rests,
    }


def _told(claim: Claim) -> dict[str, Any]:
    words = "id title place first verdict scope word faults reason remarks assumed"
    return _named(claim, words) | {
        "checks": [vars(check) | {"verdict": check.verdict} for check in claim.checks],
        "numbers": claim.rows,
        "figures": [f"{picture.name}.png" for picture in claim.pictures],
    }
