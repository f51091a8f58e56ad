"""Every effect of the catalogue with its laws and the places from which a fit sets out."""

from __future__ import annotations

from stickslip import EFFECTS
from stickslip.effects.candidate import Candidate, Scales


def candidates(scales: Scales) -> tuple[Candidate, ...]:
    """All laws of all effects, in the catalogue's order; several starts of one law are several."""
    return tuple(candidate for effect in EFFECTS for candidate in effect.candidates(scales))
