"""What each suite has to show, as shares of its campaigns with the share that is wanted."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from . import outcome as of
from .answers import Row
from .exponents import exponents_are_near
from .outcome import Outcome, outcome
from .shares import Share, share

Holds = Callable[[Row], bool]
SMALL_GAP = 1.1  # noise units that may be left on held-out runs
LEVEL = 0.05  # part of the campaigns without anything that may gain `LEAST_GAIN` by chance


@dataclass(frozen=True)
class Score:
    """A share, and what is wanted of it: at least, at most, or a level within its interval."""

    what: str
    share: Share
    wanted: str = ""

    @property
    def met(self) -> bool | None:
        """Whether the share itself is as wanted; None where nothing is."""
        if not self.wanted or not self.share.total:
            return None
        sign, number = self.wanted[0], float(self.wanted[1:])
        if sign == "~":
            low, high = self.share.interval()
            return low <= number <= high
        return self.share.value >= number if sign == ">" else self.share.value <= number


def is_named(row: Row) -> bool:
    """By name alone."""
    return outcome(row) is Outcome.NAMED


def is_named_or_class(row: Row) -> bool:
    """By name or in a stated class."""
    return outcome(row) in (Outcome.NAMED, Outcome.CLASS)


def is_stated_at_all(row: Row) -> bool:
    """By name, in a class, or as a part."""
    return outcome(row) in (Outcome.NAMED, Outcome.CLASS, Outcome.PARTIAL)


def refuses_none(row: Row) -> bool:
    """Any verdict but `none`."""
    return of.verdict(row) not in ("none", "failed")


def gives_name(row: Row) -> bool:
    """A name is given as the whole of what is missing: named or class."""
    return of.verdict(row) in ("named", "class")


def has_right_exponent(row: Row) -> bool:
    """Named, with the power as it is."""
    return is_named(row) and exponents_are_near(row)


def hides(row: Row) -> bool:
    """Something with a name is hidden."""
    return bool(row.truth.effects or row.truth.members)


def hides_nothing(row: Row) -> bool:
    """Nothing is."""
    return not hides(row) and row.truth.kind is None


ONE: tuple[tuple[str, Holds, str], ...] = (
    ("named or in a stated class", is_named_or_class, ">0.97"),
    ("by name alone", is_named, ">0.90"),
)
ALL_KINDS: tuple[tuple[str, Holds, str], ...] = (
    ("not named as something else", lambda row: not gives_name(row), ">0.95"),
    ("not taken for `none`", refuses_none, ""),
    ("not named, not a part either", lambda row: not of.given(row), ""),
)
#: suite -> what is counted of its campaigns that hide something, and of those that do not
WANTED: dict[str, tuple[tuple[str, Holds, str], ...]] = {
    "contact_and_shapes": (
        ("named by effect", is_named, ">0.90"),
        ("named or in a stated class", is_named_or_class, ""),
    ),
    "one_effect": ONE,
    "scatter": (
        ("named or in a stated class", is_named_or_class, ">0.90"),
        ("by name alone", is_named, ""),
    ),
    "out_of_catalogue": ALL_KINDS,
    "held_back": ALL_KINDS,
    "faults": (
        ("named as such", is_named, ">0.90"),
        ("in a stated class with it", is_named_or_class, ""),
        ("named as physics", of.names_physics, "<0"),
    ),
    "two_effects": (("both named", is_named, ">0.85"),),
    "three_effects": (("all three named", is_named, ""),),
    "scaling": (
        ("named", is_named, ">0.90"),
        ("named, exponent within 0.2", has_right_exponent, ">0.90"),
    ),
}
OTHERWISE = (("right", of.is_right, ""),)  # of other folders of campaigns


def scores(suite: str, rows: Sequence[Row]) -> list[Score]:
    """All that is wanted of a suite."""
    empty = [row for row in rows if hides_nothing(row)]
    full = [row for row in rows if not hides_nothing(row)]
    found = [counted(full, *each) for each in WANTED.get(suite, OTHERWISE) if full]
    hiding = [row for row in full if hides(row)]
    if hiding:
        found.append(counted(hiding, "named, in a class, or as a part", is_stated_at_all))
    if empty:
        wanted = "<0" if suite == "contact_and_shapes" else ""
        found += [
            counted(empty, "nothing hidden: named", gives_name, wanted),
            counted(empty, "nothing hidden: named, or as a part", gives_part),
            counted(
                empty,
                "nothing hidden: `none` refused",
                refuses_none,
                f"~{LEVEL}",
            ),
        ]
    physics = [row for row in full if not row.truth.is_fault]
    if physics:
        found.append(counted(physics, "named as a fault of the measurement", of.names_fault, "<0"))
    right = [row for row in hiding if of.is_right(row) and of.gap(row, "after") is not None]
    if right:
        what = f"right answers: held-out gap after <= {SMALL_GAP}"
        found.append(counted(right, what, leaves_little, ">0.90"))
    return found


def gives_part(row: Row) -> bool:
    """A name is given, if only as a part."""
    return bool(of.given(row))


def leaves_little(row: Row) -> bool:
    """The gap that is left on held-out runs is measurement noise."""
    left = of.gap(row, "after")
    return left is not None and left <= SMALL_GAP


def counted(rows: Sequence[Row], what: str, holds: Holds, wanted: str = "") -> Score:
    """One share."""
    return Score(what, share(rows, holds), wanted)
