"""What is written of each claim (`claims.toml`), filled in with computed numbers and judged.

A row, a check, a turn and a picture are named there; their texts have places in braces for what is
computed. A check compares a number of each model with its limit. Changes that are one computation
with other numbers stand there with these.
"""

from __future__ import annotations

import operator
import tomllib
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from cosim.report.live import live_of
from cosim.report.page import Picture
from cosim.report.style import picture

from .claim import FAR, Check, Claim, Margin, Row, Turn
from .drawing import MODELS, Panel, figure_of

WRITTEN: dict[str, Any] = tomllib.loads(
    Path(__file__).with_name("claims.toml").read_text(encoding="utf-8")
)


class Printed(NamedTuple):
    """A number of the study, or in words a range between two of its numbers, and its place."""

    value: float | str
    place: str

    @property
    def number(self) -> float:
        """The value; ValueError where the study prints words."""
        return float(self.value)


#: Every number of the study that is compared with, by name.
STUDY = {
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
#: As printed, mended, exact; None, or nothing: the model has no such number, or cannot tell.
Numbers = Sequence[float | None] | np.ndarray
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
        self, name: str, ours: Numbers = (), /, *, study: str = "", derived: Any = None, **said: Any
    ) -> None:
        """A row of numbers; study: name of the study's, where the text does not say it."""
        written = self._written["row"][name]
        told, place = STUDY.get(study or written.get("study", ""), (None, ""))
        derived = written.get("derived") if derived is None else derived
        how = "" if derived is None else written["how"]
        numbers = [None if one is None else float(one) for one in (*ours, *NONE)[:3]]
        told_by = dict(zip(MODELS, numbers, strict=True))
        text, unit = written["says"].format(**said), written.get("unit", "1")
        digits = written.get("digits", 4)
        self._rows.append(Row(text, unit, told, place, derived, how, digits, **told_by))

    def rows(self, name: str, table: Any, /, **said: Any) -> None:
        """A row for each column of numbers (3, n); said: of each its own."""
        for i, ours in enumerate(np.transpose(table)):
            self.row(name, ours, **{key: values[i] for key, values in said.items()})

    def check(
        self,
        name: str,
        ours: Numbers = (),
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
        limit = written.get("limit", 0.0) if limit is None else limit
        compare, unit = COMPARED[written.get("so", "below")], written.get("unit", "1")
        self._said = said = said | {"limit": limit}
        self._passes: Callable[[float | None], bool | None] = lambda one: (
            None if one is None else bool(compare(one, limit))
        )
        known = [one for one in (*ours, margin) if one is not None]
        shown = None
        if known:
            shown = Margin(written["margin"].format(**said), float(known[-1]), float(limit), unit)
        if answers is None:
            answers = map(self._passes, ours)
        told = [None if one is None else bool(one) for one in (*answers, *NONE)[:3]]
        part = Check(written["says"].format(**said), *told, faults=faults, margin=shown)
        self._checks.append(replace(part, together=together))

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
        said = self._said | said | {"value": value}
        change, figure = (written[text].format(**said) for text in ("change", "figure"))
        sound = self._passes(value) if sound is None else sound
        turn = Turn(change, figure, bool(sound), weight or written.get("weight", FAR))
        last = self._checks[-1]
        self._checks[-1] = replace(last, turns=(*last.turns, turn))

    def turns(self, key: str) -> dict[str, Any]:
        """The changes that are written with their numbers under a key: name -> those."""
        written = self._written["turn"].items()
        return {name: one[key] for name, one in written if key in one}

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
        names = ("title", "place", "rests", "first", "scope")
        assumed = [shared.get(one, one) for one in written.get("assumed", ())]
        return Claim(
            self.id,
            rows=tuple(self._rows),
            checks=tuple(self._checks),
            pictures=tuple(self._pictures),
            leading=written.get("leading", 0),
            remarks=tuple(text.format(**said) for text in written.get("remarks", ())),
            assumed=tuple(text.format(**said) for text in assumed),
            **{name: written[name].format(**said) for name in names if name in written},
        )
