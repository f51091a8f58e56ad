"""Every effect of the catalogue with its laws and the places from which a fit sets out."""

from __future__ import annotations

from collections.abc import Collection

from stickslip import EFFECTS
from stickslip.effects.candidate import Candidate, Scales
from stickslip.plugins.load import file_of


def candidates(scales: Scales, also: Collection[str] = ()) -> tuple[Candidate, ...]:
    """All laws of all effects, in the catalogue's order; several starts of one law are several.

    also : effects that are not offered unless they are named, as those of one's own files are
    """
    return tuple(
        candidate
        for effect in EFFECTS
        if effect.offered or effect.id in also or file_of(effect) is not None
        for candidate in effect.candidates(scales)
    )


#: Where an effect enters the kernel that is a law of the sliding speed.
_DRY = "dry_factor"


def laws_of_speed() -> tuple[str, ...]:
    """Effects that are the dry contact's law of the sliding speed, whose place a table takes."""
    return tuple(
        effect.id for effect in EFFECTS if any(each.__name__ == _DRY for each in effect.terms)
    )
