"""Judged claims as a result, which can become what `stickslip reproduce` leaves."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

from stickslip.reference.scheme_errors import DESCRIPTIONS

from cosim.files import write_bytes, write_text
from cosim.report.files import json_text
from cosim.result import Result

from .claim import Claim

RESULT, PAGE = "reproduction.json", "report.html"


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
        """What `reproduction.json` holds."""
        from .result import as_data

        return as_data(self, self.wall_time, self.datasets)

    def _answer(self) -> tuple[str, Sequence[tuple[str, str]]]:
        verdicts = Counter(claim.verdict for claim in self)
        return f"{len(self)} claims are judged.", [(name, str(n)) for name, n in verdicts.items()]

    def _page(self) -> str:
        from .result import page

        return page(self, DESCRIPTIONS, self.datasets)

    def _write(self, folder: Path) -> None:
        """Numbers first, then figures, then the page."""
        write_text(json_text(self.summary()), folder / RESULT)
        for claim in self:
            for picture in claim.pictures:
                write_bytes(picture.png, folder / f"{picture.name}.png")
        write_text(self._page(), folder / PAGE)
