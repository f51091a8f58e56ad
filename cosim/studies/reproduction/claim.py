"""A claim of the study as it is judged: rows of numbers, checks against limits, what turns them.

What is written of each claim stands in `claims.toml`, its texts with places in braces for what is
computed. A check compares a number of each model with its limit. Changes that are one computation
with other numbers stand there with these.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field
from itertools import combinations
from operator import ge, gt, le, lt
from typing import Any, NamedTuple

import numpy as np
from stickslip.packaged import packaged_tables
from stickslip.reference.scheme_options import DESCRIPTIONS, PRINTED, Faults

from cosim.report.page import Picture, number

CLAIM_IDS = tuple(f"C{n}" for n in range(1, 19))
WRITTEN = packaged_tables(__package__, "claims.toml")


class UnknownClaim(ValueError):
    """An id that the study does not have; the message is one line."""


def claim_ids(wanted: Sequence[str]) -> tuple[str, ...]:
    """The ids asked for, once each and in the study's order; all of them for none asked."""
    for one in wanted:
        if one.upper() not in CLAIM_IDS:
            raise UnknownClaim(
                f"claim {one!r}: unknown, allowed are {CLAIM_IDS[0]} to {CLAIM_IDS[-1]}"
            )
    asked = {one.upper() for one in wanted} or CLAIM_IDS
    return tuple(one for one in CLAIM_IDS if one in asked)


class Printed(NamedTuple):
    """A number of the study, or in words a range between two of its numbers, and its place."""

    value: Any
    place: str


#: Every number of the study that is compared with, by name.
STUDY = {
    name: Printed(value, place)
    for place, numbers in WRITTEN["study"].items()
    for name, value in numbers.items()
}
#: How a check compares a number with its limit.
COMPARED = {"above": gt, "below": lt, "at most": le, "at least": ge}
MODELS = ("printed", "mended", "exact")
#: As printed, mended, exact; None, or nothing: the model has no such number, or cannot tell.
Numbers = Sequence[Any] | np.ndarray

HOLDS = "holds"
FOLLOWS = "follows from the assumption"
UNDECIDED = "undecided"
ONLY_WITH_FAULT = "holds only with fault"
DOES_NOT_HOLD = "does not hold"
CANNOT_BE_CHECKED = "cannot be checked"
# where no fault by itself makes the part
SEVERAL = "of the scheme (several together)"
# from good to bad: a claim is as good as its worst part that can be checked
# (an undecided part may yet be one that does not hold)
ORDER = (HOLDS, FOLLOWS, ONLY_WITH_FAULT, UNDECIDED, DOES_NOT_HOLD)

# what a change of an assumption is to the study
PUT_IN = "put in"  # what was put in amounts to what came out
OPEN = "open"  # the study leaves it open
FAR = "far"  # the study says otherwise: only how far it is to the turn


@dataclass(frozen=True)
class Row:
    """One quantity: the study's figure, what follows from the study's numbers, and ours.

    study: what the study prints; place: where. derived: computed from the study's numbers, not
    printed there; how: in what way. None: there is none. digits: significant ones that are shown.
    """

    quantity: str
    unit: str
    study: float | str | None = None
    place: str = ""
    derived: float | str | None = None
    how: str = ""
    digits: int = 4
    printed: float | None = None
    mended: float | None = None
    exact: float | None = None


@dataclass(frozen=True)
class Margin:
    """How far a part is from its limit; of the model that decides."""

    what: str
    value: float
    limit: float
    unit: str = "1"

    @property
    def text(self) -> str:
        """In words."""
        unit = {"1": "", "°": "°"}.get(self.unit, f" {self.unit}")
        return f"{self.what} {number(self.value)}{unit}, limit {number(self.limit)}{unit}"


@dataclass(frozen=True)
class Turn:
    """A part under a changed assumption: the change, what comes out, whether the part is then so.

    weight: what the change is to the study (`PUT_IN`, `OPEN`, `FAR`).
    """

    change: str
    figure: str
    sound: bool
    weight: str = FAR


@dataclass
class Check:
    """One part of a claim, asked of each model; None: the model cannot tell.

    faults: those of which each, mended alone in the printed scheme, makes the part fail there;
    together: where none does, the pairs that do.
    """

    says: str
    printed: bool | None = None
    mended: bool | None = None
    exact: bool | None = None
    _: KW_ONLY
    faults: Sequence[str] = ()
    margin: Margin | None = None
    turns: list[Turn] = field(default_factory=list)
    together: Sequence[tuple[str, str]] = ()

    @property
    def sound(self) -> bool | None:
        """Whether it is so: by the exact model, else the mended scheme, else the printed one."""
        asked = (self.exact, self.mended, self.printed)
        return next((answer for answer in asked if answer is not None), None)

    @property
    def turned_by(self) -> list[Turn]:
        """The changes after which the answer is another one."""
        return [turn for turn in self.turns if turn.sound != self.sound]

    @property
    def verdict(self) -> str:
        """One of the six words."""
        weights = {turn.weight for turn in self.turned_by}
        if self.sound is None:
            return CANNOT_BE_CHECKED
        if self.sound and PUT_IN in weights:
            return FOLLOWS
        if OPEN in weights:
            return UNDECIDED
        if self.sound:
            return HOLDS
        return ONLY_WITH_FAULT if self.printed else DOES_NOT_HOLD

    @property
    def verdict_with_faults(self) -> str:
        """The word, and behind `holds only with fault` the faults, or pairs that act together."""
        pairs = "; ".join(" and ".join(pair) for pair in self.together)
        several = f"of several together (ended by mending {pairs})" if pairs else SEVERAL
        return _with_faults(self.verdict, self.faults, several)

    @property
    def reason(self) -> str:
        """The part with what the models say to it."""
        models = {"as printed": self.printed, "mended": self.mended, "exact": self.exact}
        said = [f"{name}: {'yes' if so else 'no'}" for name, so in models.items() if so is not None]
        return f"{self.says} ({', '.join(said) or 'no figure to compare with'})"


def _with_faults(verdict: str, faults: Sequence[str], several: str = SEVERAL) -> str:
    """A verdict, with the faults by which it holds only."""
    return f"{verdict} {', '.join(faults) or several}" if verdict == ONLY_WITH_FAULT else verdict


@dataclass
class Claim:
    """A claim of the study; rows, checks and pictures stand in the order of the calls.

    place: where the study makes it; rests: what the verdict rests on; first: what must be known to
    read the numbers; remarks: what was found on the way; assumed: what the study does not print and
    was assumed; leading: place of the row that stands for the claim; scope: how far the verdict
    reaches, where that is less far than the title.
    """

    id: str
    title: str = ""
    place: str = ""
    rests: str = ""
    first: str = ""
    scope: str = ""
    leading: int = 0
    remarks: Sequence[str] = ()
    assumed: Sequence[str] = ()
    rows: list[Row] = field(default_factory=list)
    checks: list[Check] = field(default_factory=list)
    pictures: list[Picture] = field(default_factory=list)

    def row(
        self, name: str, ours: Numbers = (), /, *, study: str = "", derived: Any = None, **said: Any
    ) -> None:
        """A row of numbers; study: name of the study's, where the text does not say it."""
        written = WRITTEN[self.id]["row"][name]
        told, place = STUDY.get(study or written.get("study", ""), (None, ""))
        derived = written.get("derived") if derived is None else derived
        how = "" if derived is None else written["how"]
        numbers = [None if one is None else float(one) for one in ours]
        text, unit = written["says"].format(**said), written.get("unit", "1")
        self.rows.append(
            Row(text, unit, told, place, derived, how, written.get("digits", 4), *numbers)
        )

    def row_each(self, name: str, table: Any, /, **said: Any) -> None:
        """A row for each column of numbers (3, n); said: of each its own."""
        for i, ours in enumerate(np.transpose(table)):
            self.row(name, ours, **{key: values[i] for key, values in said.items()})

    def check(
        self,
        name: str,
        ours: Numbers = (),
        /,
        margin: float | None = None,
        limit: float | None = None,
        faults: Sequence[str] = (),
        together: Sequence[tuple[str, str]] = (),
        **said: Any,
    ) -> None:
        """A part of the claim: numbers against a limit, or answers that are known already.

        margin: the number beside the limit, where it is not that of the model that decides.
        """
        written = WRITTEN[self.id]["check"][name]
        limit = written.get("limit", 0.0) if limit is None else limit
        compare = COMPARED[written.get("so", "below")]
        self._said = said = said | {"limit": limit}
        #: Whether the last check would let a number pass, or an answer that is known already.
        self.passes: Callable[[Any], bool] = lambda one: bool(
            one if isinstance(one, (bool, np.bool_)) else compare(one, limit)
        )
        beside = next((one for one in (margin, *ours[::-1]) if one is not None), None)
        shown = None
        if beside is not None:
            what, unit = written["margin"].format(**said), written.get("unit", "1")
            shown = Margin(what, float(beside), float(limit), unit)
        says = written["says"].format(**said)
        answers = [None if one is None else self.passes(one) for one in ours]
        self.checks.append(Check(says, *answers, faults=faults, margin=shown, together=together))

    def turn(
        self, name: str, value: Any = None, /, *, sound: Any = None, weight: str = "", **said: Any
    ) -> None:
        """What the last check comes to under a change: a number against the same limit."""
        written, said = WRITTEN[self.id]["turn"][name], self._said | said | {"value": value}
        change, figure = (written[text].format(**said) for text in ("change", "figure"))
        sound = self.passes(value) if sound is None else sound
        weight = weight or written.get("weight", FAR)
        self.checks[-1].turns.append(Turn(change, figure, bool(sound), weight))

    def changes(self, key: str) -> dict[str, Any]:
        """The changes that are written with their numbers under a key: name -> those."""
        written = WRITTEN[self.id]["turn"].items()
        return {name: one[key] for name, one in written if key in one}

    @property
    def word(self) -> str:
        """The verdict's word, without the faults."""
        told = [check.verdict for check in self.checks if check.verdict in ORDER]
        return max(told, key=ORDER.index) if told else CANNOT_BE_CHECKED

    @property
    def faults(self) -> list[str]:
        """Faults behind the parts that hold only with one."""
        part = [check.faults for check in self.checks if check.verdict == ONLY_WITH_FAULT]
        return sorted(set().union(*part), key=lambda fault: int(fault[1:]))

    @property
    def verdict(self) -> str:
        """The word, and behind `holds only with fault` the faults."""
        return _with_faults(self.word, self.faults)

    @property
    def deciding(self) -> list[Check]:
        """The parts that the verdict is taken from."""
        return [check for check in self.checks if check.verdict == self.word]

    @property
    def margins(self) -> list[Margin]:
        """How far the deciding parts are from their limits."""
        return [check.margin for check in self.deciding if check.margin is not None]

    @property
    def turns(self) -> list[Turn]:
        """What turns a deciding part; where nothing that was tried does, all that was tried."""
        turned = [turn for check in self.deciding for turn in check.turned_by]
        return turned or [turn for check in self.deciding for turn in check.turns]

    @property
    def steady(self) -> bool:
        """Whether nothing that was tried turns a deciding part."""
        return not any(check.turned_by for check in self.deciding)

    @property
    def reason(self) -> str:
        """Why, in a sentence: the parts that decide, and what became of the others."""
        said = "; ".join(check.reason for check in self.deciding)
        words = [check.verdict for check in self.checks if check.verdict != self.word]
        others = ", ".join(f"{words.count(word)} {word}" for word in dict.fromkeys(words))
        return f"{said} (other parts: {others})" if others else said


#: What computes the numbers of a claim, and returns what its texts leave open.
Judge = Callable[[Claim], Mapping[str, Any]]


def judged(claim: str, judge: Judge) -> Claim:
    """A claim with its numbers, its checks and its texts."""
    written, found = WRITTEN[claim], Claim(claim)
    said = judge(found)
    for name in ("title", "place", "rests", "first", "scope"):
        setattr(found, name, written.get(name, "").format(**said))
    assumed = [WRITTEN["assumed"].get(one, one) for one in written.get("assumed", ())]
    found.assumed = [text.format(**said) for text in assumed]
    found.remarks = [text.format(**said) for text in written.get("remarks", ())]
    found.leading = written.get("leading", 0)
    return found


def responsible(holds: Callable[[Faults], bool]) -> tuple[str, ...]:
    """Faults of which each, mended alone, makes ``holds`` fail; empty if it fails as printed."""
    if not holds(PRINTED):
        return ()
    return tuple(fault for fault in DESCRIPTIONS if not holds(PRINTED.without(fault)))


def responsible_pairs(holds: Callable[[Faults], bool]) -> tuple[tuple[str, str], ...]:
    """Pairs of faults that, mended together, make ``holds`` fail; for where no single one does."""
    return tuple(
        pair for pair in combinations(DESCRIPTIONS, 2) if not holds(PRINTED.without(*pair))
    )
