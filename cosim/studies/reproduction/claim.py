"""What a claim is, and the verdict that follows from its numbers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from stickslip.reference.faults import DESCRIPTIONS, PRINTED, Faults

from cosim.studies.drawing import Picture

HOLDS = "holds"
ONLY_WITH_FAULT = "holds only with fault"
DOES_NOT_HOLD = "does not hold"
CANNOT_BE_CHECKED = "cannot be checked"
# from good to bad: a claim is as good as its worst part that can be checked
ORDER = (HOLDS, ONLY_WITH_FAULT, DOES_NOT_HOLD)


@dataclass(frozen=True)
class Row:
    """One quantity: the study's figure as it stands there, and ours; None: there is none.

    digits: significant ones that are shown of ours.
    """

    quantity: str
    unit: str
    study: float | str | None = None
    printed: float | None = None
    mended: float | None = None
    exact: float | None = None
    digits: int = 4


@dataclass(frozen=True)
class Check:
    """One part of a claim, asked of each model; None: the model cannot tell.

    faults: those of which each, mended alone in the printed scheme, makes the part fail there.
    """

    says: str
    printed: bool | None
    mended: bool | None
    exact: bool | None
    faults: tuple[str, ...] = ()

    @property
    def sound(self) -> bool | None:
        """Whether it is so: by the exact model, else the mended scheme, else the printed one."""
        asked = (self.exact, self.mended, self.printed)
        return next((answer for answer in asked if answer is not None), None)

    @property
    def verdict(self) -> str:
        """One of the four words."""
        if self.sound is None:
            return CANNOT_BE_CHECKED
        if self.sound:
            return HOLDS
        return ONLY_WITH_FAULT if self.printed else DOES_NOT_HOLD


@dataclass(frozen=True)
class Claim:
    """A claim of the study, judged.

    remarks: what was found on the way; assumed: what the study does not print and was assumed;
    leading: place of the row that stands for the claim.
    """

    id: str
    title: str
    rows: tuple[Row, ...]
    checks: tuple[Check, ...]
    remarks: tuple[str, ...] = ()
    assumed: tuple[str, ...] = ()
    pictures: tuple[Picture, ...] = ()
    leading: int = 0

    @property
    def word(self) -> str:
        """The verdict's word, without the faults."""
        told = [check.verdict for check in self.checks if check.verdict in ORDER]
        return max(told, key=ORDER.index) if told else CANNOT_BE_CHECKED

    @property
    def faults(self) -> tuple[str, ...]:
        """Faults behind the parts that hold only with one."""
        found = {
            fault
            for check in self.checks
            if check.verdict == ONLY_WITH_FAULT
            for fault in check.faults
        }
        return tuple(sorted(found, key=lambda fault: int(fault[1:])))

    @property
    def verdict(self) -> str:
        """holds / holds only with fault Fn / does not hold / cannot be checked."""
        if self.word != ONLY_WITH_FAULT:
            return self.word
        return f"{ONLY_WITH_FAULT} {', '.join(self.faults) or 'of the scheme (several together)'}"

    @property
    def reason(self) -> str:
        """Why, in a sentence: the parts that decide, and how many are sound."""
        sound = sum(check.verdict == HOLDS for check in self.checks)
        deciding = [check for check in self.checks if check.verdict == self.word]
        said = "; ".join(_reason(check) for check in deciding)
        if sound and self.word != HOLDS:
            said += f" ({sound} of {len(self.checks)} parts hold)"
        return said


def _reason(check: Check) -> str:
    """A part with what the models say to it."""
    answers = [
        f"{model}: {'yes' if answer else 'no'}"
        for model, answer in (
            ("as printed", check.printed), ("mended", check.mended), ("exact", check.exact)
        )
        if answer is not None
    ]
    return f"{check.says} ({', '.join(answers) or 'no figure to compare with'})"


def responsible(holds: Callable[[Faults], bool]) -> tuple[str, ...]:
    """Faults of which each, mended alone, makes ``holds`` fail; empty if it fails as printed."""
    if not holds(PRINTED):
        return ()
    return tuple(fault for fault in DESCRIPTIONS if not holds(PRINTED.without(fault)))
