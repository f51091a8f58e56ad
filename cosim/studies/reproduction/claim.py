"""What a judged claim is: rows of numbers, checks against limits, what turns them, its verdict."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import KW_ONLY, dataclass
from itertools import combinations

from stickslip.reference.scheme_errors import DESCRIPTIONS, PRINTED, Faults

from cosim.report.page import Picture

CLAIM_IDS = tuple(f"C{n}" for n in range(1, 19))


class UnknownClaim(ValueError):
    """An id that the study does not have; the message is one line."""


def claim_ids(wanted: Sequence[str]) -> tuple[str, ...]:
    """The ids asked for, once each and in the study's order; all of them for none asked."""
    for one in wanted:
        if one.upper() not in CLAIM_IDS:
            raise UnknownClaim(
                f"claim {one!r}: unknown, allowed are {CLAIM_IDS[0]} to {CLAIM_IDS[-1]}"
            )
    asked = {one.upper() for one in wanted} or set(CLAIM_IDS)
    return tuple(one for one in CLAIM_IDS if one in asked)


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
        unit = "" if self.unit == "1" else self.unit if self.unit == "°" else f" {self.unit}"
        return f"{self.what} {self.value:.4g}{unit}, limit {self.limit:.4g}{unit}"


@dataclass(frozen=True)
class Turn:
    """A part under a changed assumption: the change, what comes out, whether the part is then so.

    weight: what the change is to the study (`PUT_IN`, `OPEN`, `FAR`).
    """

    change: str
    figure: str
    sound: bool
    weight: str = FAR


@dataclass(frozen=True)
class Check:
    """One part of a claim, asked of each model; None: the model cannot tell.

    faults: those of which each, mended alone in the printed scheme, makes the part fail there;
    together: where none does, the pairs that do.
    """

    says: str
    printed: bool | None
    mended: bool | None
    exact: bool | None
    _: KW_ONLY
    faults: tuple[str, ...] = ()
    margin: Margin | None = None
    turns: tuple[Turn, ...] = ()
    together: tuple[tuple[str, str], ...] = ()

    @property
    def sound(self) -> bool | None:
        """Whether it is so: by the exact model, else the mended scheme, else the printed one."""
        asked = (self.exact, self.mended, self.printed)
        return next((answer for answer in asked if answer is not None), None)

    @property
    def turned_by(self) -> tuple[Turn, ...]:
        """The changes after which the answer is another one."""
        return tuple(turn for turn in self.turns if turn.sound != self.sound)

    @property
    def verdict(self) -> str:
        """One of the six words."""
        if self.sound is None:
            return CANNOT_BE_CHECKED
        weights = {turn.weight for turn in self.turned_by}
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
        if self.verdict != ONLY_WITH_FAULT:
            return self.verdict
        pairs = "; ".join(" and ".join(pair) for pair in self.together)
        named = f"of several together (ended by mending {pairs})" if pairs else SEVERAL
        return f"{ONLY_WITH_FAULT} {', '.join(self.faults) or named}"

    @property
    def reason(self) -> str:
        """The part with what the models say to it."""
        answers = zip(
            ("as printed", "mended", "exact"), (self.printed, self.mended, self.exact), strict=True
        )
        said = [f"{name}: {'yes' if one else 'no'}" for name, one in answers if one is not None]
        return f"{self.says} ({', '.join(said) or 'no figure to compare with'})"


@dataclass(frozen=True)
class Claim:
    """A claim of the study, judged.

    place: where the study makes it; rests: what the verdict rests on; first: what must be known to
    read the numbers; remarks: what was found on the way; assumed: what the study does not print and
    was assumed; leading: place of the row that stands for the claim; scope: how far the verdict
    reaches, where that is less far than the title.
    """

    id: str
    title: str
    rows: tuple[Row, ...]
    checks: tuple[Check, ...]
    remarks: tuple[str, ...] = ()
    assumed: tuple[str, ...] = ()
    pictures: tuple[Picture, ...] = ()
    leading: int = 0
    place: str = ""
    rests: str = ""
    first: str = ""
    scope: str = ""

    @property
    def word(self) -> str:
        """The verdict's word, without the faults."""
        told = [check.verdict for check in self.checks if check.verdict in ORDER]
        return max(told, key=ORDER.index) if told else CANNOT_BE_CHECKED

    @property
    def faults(self) -> tuple[str, ...]:
        """Faults behind the parts that hold only with one."""
        part = [check.faults for check in self.checks if check.verdict == ONLY_WITH_FAULT]
        return tuple(sorted(set().union(*part), key=lambda fault: int(fault[1:])))

    @property
    def verdict(self) -> str:
        """The word, and behind `holds only with fault` the faults."""
        if self.word != ONLY_WITH_FAULT:
            return self.word
        return f"{ONLY_WITH_FAULT} {', '.join(self.faults) or SEVERAL}"

    @property
    def deciding(self) -> tuple[Check, ...]:
        """The parts that the verdict is taken from."""
        return tuple(check for check in self.checks if check.verdict == self.word)

    @property
    def margins(self) -> tuple[Margin, ...]:
        """How far the deciding parts are from their limits."""
        return tuple(check.margin for check in self.deciding if check.margin is not None)

    @property
    def turns(self) -> tuple[Turn, ...]:
        """What turns a deciding part; where nothing that was tried does, all that was tried."""
        turned = tuple(turn for check in self.deciding for turn in check.turned_by)
        return turned or tuple(turn for check in self.deciding for turn in check.turns)

    @property
    def steady(self) -> bool:
        """Whether nothing that was tried turns a deciding part."""
        return not any(check.turned_by for check in self.deciding)

    @property
    def reason(self) -> str:
        """Why, in a sentence: the parts that decide, and what became of the others."""
        said = "; ".join(check.reason for check in self.deciding)
        words = [check.verdict for check in self.checks]
        others = [word for word in dict.fromkeys(words) if word != self.word]
        if others:
            said += " (other parts: " + ", ".join(f"{words.count(w)} {w}" for w in others) + ")"
        return said


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
