"""Contacts get hot before they part: friction falls with the speed above an onset.

    mu_k (1 - c (1 - 1 / (1 + (v / v_w)^8)^(1/8)))

Two bodies touch at small contacts, each for as long as it takes to slide over it. Faster than v_w,
a contact reaches the temperature at which it weakens while it still lives, and for the rest of its
life bears little: friction falls as v_w / v (Rice, J. Geophys. Res. 111, 2006), here rounded at the
onset as by Noda, Dunham & Rice (J. Geophys. Res. 114, 2009). Of ice, they melt (Bowden & Hughes,
Proc. R. Soc. A 172, 1939).
"""

from collections.abc import Iterator

from stickslip.effects import Candidate, Case, Effect, FreeParameter, Scales, Table, quantity

SHARPNESS = 8.0


class FlashHeating(Table):
    """Contacts get hot before they part: friction falls with the speed above an onset."""

    fall: float = quantity(
        0.0, "1", "c, part of mu_k that is lost at last", ge=0, le=1, typical=(0.2, 0.9)
    )
    onset: float = quantity(
        0.1, "m/s", "v_w, above which contacts get hot", gt=0, le=100, tried=(0.03, 0.3)
    )


def dry_factor(speed: float, fall: float, onset: float) -> float:
    """mu_k at a local sliding speed over its value at rest."""
    cool = (1.0 + (speed / onset) ** SHARPNESS) ** (-1.0 / SHARPNESS)
    return 1.0 - fall * (1.0 - cool)


def candidates(s: Scales) -> Iterator[Candidate]:
    """An onset below the campaign's speed, and one above it."""
    fall = FreeParameter("flash_heating.fall", 0.4, 0.1, 0.0, 1.0)
    for share in (0.5, 1.2):
        onset = FreeParameter(
            "flash_heating.onset", share * s.speed, 0.2, 0.1 * s.speed, 10.0 * s.speed, log=True
        )
        yield Candidate("flash_heating", "above an onset", (fall, onset))


EFFECT = Effect(
    id="flash_heating",
    table=FlashHeating,
    switch=("fall",),
    enters="friction",
    axis="sliding speed",
    source="Rice, J. Geophys. Res. 111 (2006); Noda, Dunham & Rice, J. Geophys. Res. 114 (2009)",
    terms=(dry_factor,),
    candidates=candidates,
    case=Case({"fall": 0.5, "onset": 0.05}),
)
