"""Figures in words: digits, spans, and which of the nominal rig lie outside of their intervals."""

from __future__ import annotations

from collections.abc import Iterable

from ..case import Case

#: K, s or m: less is not told from nothing.
_NOTHING = 1e-4


def two_digits(value: float) -> str:
    """A figure whose doubt is a factor of 0.75 to 2; below 0.1 mK a rise is nothing."""
    return "0" if abs(value) < _NOTHING else f"{float(f'{value:.2g}'):g}"


def span(values: Iterable[float]) -> str:
    """The smallest and the largest of some figures, one where they are the same."""
    values = sorted(values)
    return " to ".join(dict.fromkeys(map(two_digits, (values[0], values[-1]))))


def percent(share: float) -> str:
    """A share, as a whole number."""
    return f"{100.0 * share:.0f} %"


def outside(name: str, value: float, low: float, high: float, unit: str) -> list[str]:
    """A figure of the nominal rig that lies beyond its interval; nothing where it does not."""
    if low <= value <= high:
        return []
    return [f"{name} ({two_digits(value)} {unit}, interval {span((low, high))} {unit})"]


def why_outside(found: list[str], case: Case) -> list[str]:
    """Why nominal figures lie outside of their intervals, by what the rigs have and it has not."""
    if not found:
        return []
    belt, more = case.rig.belt, []
    if not belt.rollers:
        more.append("rollers")
    elif not belt.roller_rise > 0.0:
        more.append("rollers up to 0.5 K warmer than the air")
    if not belt.railing_friction > 0.0:
        more.append("a railing that rubs")
    why = "what is in doubt of the rig acts to one side of what is given"
    if more:
        why = f"the rig as given has none of {', '.join(more)}, and the rigs of the interval do"
    return [f"Outside of their own intervals are, as the rig is given: {'; '.join(found)}: {why}."]
