"""Friction along the local relative velocity: lateral and spin components.

With the ratio kappa the contact feels the scaled sliding velocity (U_x, kappa U_y, kappa Omega) and
answers it with (F_x, kappa F_y, kappa M).
"""

from __future__ import annotations

from collections.abc import Iterator

from ...quantity import Table, quantity
from ..candidate import ACROSS, Candidate, FreeParameter, Scales
from ..effect import Case, Effect


class LateralFriction(Table):
    """Friction along the local relative velocity: lateral and spin components."""

    ratio: float = quantity(
        0.0,
        "1",
        "friction across the motion relative to that along x: 0 along x only, 1 along the local "
        "relative velocity",
        ge=0,
        le=1,
        typical=(0.5, 1.0),
    )


#: Next to none is no other motion than none, but a stiff one: it takes a thousand times as long.
_LEAST_ACROSS = 0.05


def candidates(s: Scales) -> Iterator[Candidate]:
    """Isotropic, or less than along the motion."""
    yield Candidate("lateral_friction", "isotropic", (), ACROSS, lateral=True)
    for share in (0.8, 0.5):
        ratio = FreeParameter("lateral_friction.ratio", share, 0.1, _LEAST_ACROSS, 1.0)
        yield Candidate("lateral_friction", "less than along the motion", (ratio,), ACROSS, True)


EFFECT = Effect(
    id="lateral_friction",
    table=LateralFriction,
    switch=("ratio",),
    enters="friction",
    source="Goyal, Ruina & Papadopoulos, Wear 143 (1991); named as missing by the source study",
    # every law of the contact is made of kappa (`kernel.friction`)
    core={"ratio": "LATERAL"},
    candidates=candidates,
    case=Case({"ratio": 1.0}, {"initial": {"vx": 0.15, "y": 0.01, "phi": 0.2}}),
)
