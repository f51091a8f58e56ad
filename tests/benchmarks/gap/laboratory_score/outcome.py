"""Which kind of answer an answer is.

named          the hidden effects by name, and nothing else
class          a stated class, every hidden effect in it
partial        named as a part of the misfit, the hidden effects among them
none, unknown  right where they are true
wrong          a name that is not hidden and that no stated class excuses
failed         no answer
"""

from __future__ import annotations

from enum import StrEnum

from .answers import Row

NAMING = ("named", "class", "partial")  # verdicts that give a name


class Outcome(StrEnum):
    """Kinds of answers."""

    NAMED = "named"
    CLASS = "class"
    PARTIAL = "partial"
    NONE = "none"
    UNKNOWN = "unknown"
    WRONG = "wrong"
    FAILED = "failed"


def verdict(row: Row) -> str:
    """The product's own word; `failed` where there is no answer."""
    return str(row.found["verdict"]) if row.found else "failed"


def given(row: Row) -> frozenset[str]:
    """Every effect that the answer gives a name to."""
    if row.found is None or verdict(row) not in NAMING:
        return frozenset()
    return frozenset(row.found["effects"])


def stated(row: Row) -> frozenset[str]:
    """What is given a name, and what the answer says cannot be told from it."""
    names = given(row)
    groups = [frozenset(group) for group in (row.found or {}).get("classes") or ()]
    return names.union(*(group for group in groups if group & names))


def outcome(row: Row) -> Outcome:
    """The kind of an answer."""
    said, truth = verdict(row), row.truth
    if said in ("failed", "none", "unknown"):
        return Outcome(said)
    wanted = truth.members or truth.effects
    if not wanted:
        return Outcome.PARTIAL if said == "partial" and truth.kind else Outcome.WRONG
    if said == "named":
        exact = not truth.members and given(row) - truth.also_right == wanted - truth.also_right
        return Outcome.NAMED if exact else Outcome.WRONG
    if not wanted <= stated(row):
        return Outcome.WRONG
    return Outcome.CLASS if said == "class" else Outcome.PARTIAL


def is_right(row: Row) -> bool:
    """A right name, a class that holds what is hidden, or the right one of the other verdicts.

    A part (`partial`) of what the catalogue holds whole is no right answer, even with the name.
    """
    found = outcome(row)
    if row.truth.effects or row.truth.members:
        return found in (Outcome.NAMED, Outcome.CLASS)
    return found is not Outcome.WRONG and verdict(row) in row.truth.verdicts


def probability(row: Row) -> float | None:
    """How probable the answer says the one that it names to be; None where it names no one."""
    if verdict(row) != "named" or len(given(row)) != 1:
        return None
    ranked = (row.found or {}).get("ranking") or ()
    return next(
        (float(each["probability"]) for each in ranked if each["effect"] in given(row)), None
    )
