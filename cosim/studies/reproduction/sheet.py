"""What is written of each claim (`claims.toml`), filled in with computed numbers and judged.

A row, a check, a turn and a picture are named there; their texts have places in braces for what is
computed. A check compares a number of each model with its limit.
"""

from __future__ import annotations

import operator
import tomllib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from cosim.report.live import live_of
from cosim.report.page import Picture
from cosim.report.style import picture

from .claim import FAR, Check, Claim, Margin, Printed, Row, Turn
from .drawing import Panel, figure_of

WRITTEN: dict[str, Any] = tomllib.loads(
    Path(__file__).with_name("claims.toml").read_text(encoding="utf-8")
)
#: Every number of the study that is compared with, by name; the place stands in `claims.toml`.
STUDY: dict[str, Printed] = {
    name: Printed(value, place)
    for place, numbers in WRITTEN["study"].items()
    for name, value in numbers.items()
}
#: How a check compares a number with its limit.
COMPARED = {
    "above": operator.gt,
    "below": operator.lt,
    "at most": operator.le,
    "at least": operator.ge,
}
#: As printed, mended, exact; None: the model has no such number, or cannot tell.
Numbers = Iterable[float | None]
Answers = Iterable[bool | None]
NONE = (None, None, None)


class Sheet:
    """One claim as it is filled in; rows, checks and pictures stand in the order of the calls."""

    def __init__(self, claim: str) -> None:
        self.id, self._written = claim, WRITTEN[claim]
        self._rows: list[Row] = []
        self._checks: list[Check] = []
        self._pictures: list[Picture] = []

    def row(
        self,
        name: str,
        ours: Numbers = NONE,
        /,
        *,
        study: str = "",
        derived: Any = None,
        **said: Any,
    ) -> None:
        """A row of numbers; study: name of the study's, where the text does not say it."""
        written = self._written["row"][name]
        study = study or written.get("study", "")
        derived = written.get("derived") if derived is None else derived
        self._rows.append(
            Row(
                written["says"].format(**said),
                written.get("unit", "1"),
                STUDY[study] if study else None,
                *(None if one is None else float(one) for one in ours),
                digits=written.get("digits", 4),
                derived=derived,
                how=written.get("how", "").format(**said) if derived is not None else "",
            )
        )

    def rows(self, name: str, table: Any, /, **said: Any) -> None:
        """A row for each column of numbers (3, n); said: of each its own."""
        for i, ours in enumerate(np.transpose(table)):
            self.row(name, ours, **{key: values[i] for key, values in said.items()})

    def check(
        self,
        name: str,
        ours: Numbers = NONE,
        /,
        *,
        answers: Answers | None = None,
        margin: float | None = None,
        limit: float | None = None,
        faults: tuple[str, ...] = (),
        together: tuple[tuple[str, str], ...] = (),
        **said: Any,
    ) -> None:
        """A part of the claim: numbers against a limit, or answers that are known already.

        margin: the number beside the limit, where it is not that of the model that decides.
        """
        written = self._written["check"][name]
        compare = COMPARED[written.get("so", "below")]
        at = written.get("limit", 0.0) if limit is None else limit
        self._passes = lambda value: bool(compare(value, at))
        self._said = said | {"limit": at}
        ours = list(ours)
        if answers is None:
            answers = [None if one is None else self._passes(one) for one in ours]
        if margin is None:
            margin = next((one for one in reversed(ours) if one is not None), None)
        shown = None
        if margin is not None:
            what = written["margin"].format(**self._said)
            shown = Margin(what, float(margin), float(at), written.get("unit", "1"))
        self._checks.append(
            Check(
                written["says"].format(**self._said),
                *(None if one is None else bool(one) for one in answers),
                faults=faults,
                margin=shown,
                together=together,
            )
        )

    def turn(
        self,
        name: str,
        value: float | None = None,
        /,
        *,
        sound: Any = None,
        weight: str = "",
        **said: Any,
    ) -> None:
        """What the last check comes to under a change: a number against the same limit."""
        written = self._written["turn"][name]
        if sound is None and value is not None:
            sound = self._passes(value)
        said = self._said | said | {"value": value}
        turn = Turn(
            written["change"].format(**said),
            written["figure"].format(**said),
            bool(sound),
            weight or written.get("weight", FAR),
        )
        last = self._checks[-1]
        self._checks[-1] = replace(last, turns=(*last.turns, turn))

    def picture(
        self,
        name: str,
        rows: Sequence[Sequence[Panel]] = (),
        draw: Callable[..., Figure] = figure_of,
    ) -> None:
        """A figure as it is written, of panels in rows; draw: what makes it of them."""
        written = self._written["picture"][name]
        live = live_of if written.get("live") else None
        self._pictures.append(picture(name, written["caption"], live=live)(draw)(rows, written))

    def claim(self, **said: Any) -> Claim:
        """The judged claim; said: what its remarks, its scope and what is read first leave open."""
        written, shared = self._written, WRITTEN["assumed"]
        said = {"scope": written.get("scope", "")} | said
        return Claim(
            self.id,
            written["title"],
            tuple(self._rows),
            tuple(self._checks),
            remarks=_filled(written.get("remarks", ()), said),
            assumed=_filled([shared.get(one, one) for one in written.get("assumed", ())], said),
            pictures=tuple(self._pictures),
            leading=written.get("leading", 0),
            place=written["place"],
            rests=written["rests"].format(**said),
            first=written.get("first", "").format(**said),
            scope=said["scope"].format(**said),
        )


def _filled(texts: Sequence[str], said: dict[str, Any]) -> tuple[str, ...]:
    return tuple(text.format(**said) for text in texts)
