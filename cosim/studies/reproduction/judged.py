"""Judged claims as a result, which can become what `stickslip reproduce` leaves."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import Any

from cosim.files import write_bytes, write_text
from cosim.result import Result

from .claim import Claim

#: What draws and writes; loaded when asked for.
DATA, DATASETS = f"{__package__}.result", f"{__package__}.attributions"
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
        of = import_module(DATASETS)
        return of.datasets() if {claim.id for claim in self} & set(of.CLAIMS) else None

    def summary(self) -> dict[str, Any]:
        """What `reproduction.json` holds."""
        found: dict[str, Any] = import_module(DATA).as_data(self, self.wall_time, self.datasets)
        return found

    def _answer(self) -> tuple[str, Sequence[tuple[str, str]]]:
        verdicts = Counter(claim.verdict for claim in self)
        return f"{len(self)} claims are judged.", [(name, str(n)) for name, n in verdicts.items()]

    def _page(self) -> str:
        from stickslip.reference.scheme_errors import DESCRIPTIONS

        text: str = import_module(DATA).page(self, DESCRIPTIONS, self.datasets)
        return text

    def _write(self, folder: Path) -> None:
        """Numbers first, then figures, then the page."""
        from cosim.report.files import json_text

        write_text(json_text(self.summary()), folder / RESULT)
        for claim in self:
            for picture in claim.pictures:
                write_bytes(picture.png, folder / f"{picture.name}.png")
        write_text(self._page(), folder / PAGE)
