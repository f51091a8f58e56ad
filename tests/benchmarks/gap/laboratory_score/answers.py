"""What is true of a campaign, from either of two forms of answer files, and rows of a benchmark."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

FAULT = "measurement."  # effects of the tracker, not of the block


@dataclass(frozen=True)
class Truth:
    """What would be right to say of a campaign.

    Attributes
    ----------
    verdicts : those that are right; of a campaign with one effect a class that holds it is besides
    effects : all that is hidden and has a name
    members : effects of which no data of this campaign can say which it is; empty: they can
    also_right : may be named beside `effects`
    kind : of a law that the catalogue does not hold, or None
    exponents : effect -> quantity -> power with which its strength goes, over the law as stated
    hidden : name, shape, law, strength and size of each hidden thing, as the laboratory wrote it
    contact, scatter : of the laboratory: mu_s, mu_k, form of the contact; relative scatter of mu
    """

    verdicts: tuple[str, ...]
    effects: frozenset[str]
    members: frozenset[str] = frozenset()
    also_right: frozenset[str] = frozenset()
    kind: str | None = None
    exponents: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    hidden: tuple[Mapping[str, Any], ...] = ()
    contact: Mapping[str, Any] = field(default_factory=dict)
    scatter: float | None = None

    @property
    def size(self) -> float | None:
        """Noise units of the smallest hidden thing; None where none is stated."""
        sizes = [each["size"]["size"] for each in self.hidden if each.get("size")]
        return min(sizes, default=None)


def truth_of(answer: Mapping[str, Any]) -> Truth:
    """The truth of one entry of an answers.json.

    The laboratory writes `effects`, `also_right`, `out_of_catalogue`, `hidden`; other campaigns
    with answers write `effect` or `members`, and nothing more than the verdict where none is
    hidden.
    """
    verdict = answer["verdict"]
    verdicts = (verdict,) if isinstance(verdict, str) else tuple(verdict)
    unknown = "unknown" in verdicts
    return Truth(
        verdicts=verdicts,
        effects=frozenset(answer.get("effects") or answer.get("effect") or ()),
        members=frozenset(answer.get("members") or ()),
        also_right=frozenset(answer.get("also_right") or ()),
        kind=answer.get("out_of_catalogue") or ("not told" if unknown else None),
        exponents=answer.get("exponents") or {},
        hidden=tuple(answer.get("hidden") or ()),
        contact=answer.get("contact") or {},
        scatter=answer.get("scatter"),
    )


@dataclass(frozen=True)
class Row:
    """One campaign with both answers.

    Attributes
    ----------
    suite, name : of the campaign
    truth : what is right
    found : gap.json, or None where there was no answer
    seconds : of the answer, wall time on one core; cpu : the same, of the processor
    error : what there was instead of an answer, or ""
    """

    suite: str
    name: str
    truth: Truth
    found: Mapping[str, Any] | None
    seconds: float = 0.0
    cpu: float = 0.0
    error: str = ""


def row_of(line: Mapping[str, Any]) -> Row:
    """A line of a benchmark's file as a row."""
    told = {key: line[key] for key in ("suite", "name", "found", "seconds", "cpu", "error")}
    return Row(truth=truth_of(line["answer"]), **told)


def read_lines(file: Path) -> Iterator[dict[str, Any]]:
    """Lines written so far; one that an interruption cut off is left out."""
    if not file.is_file():
        return
    for text in file.read_text(encoding="utf-8").splitlines():
        try:
            yield json.loads(text)
        except json.JSONDecodeError:
            continue


def rows_of(lines: Iterable[Mapping[str, Any]]) -> list[Row]:
    """The last line of every campaign, as rows in the order of suite and name."""
    last = {(line["suite"], line["name"]): line for line in lines}
    return [row_of(last[key]) for key in sorted(last)]
