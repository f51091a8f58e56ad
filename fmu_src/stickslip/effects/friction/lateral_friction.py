"""Friction along the local relative velocity: lateral and spin components.

With the ratio kappa the contact feels the scaled sliding velocity (U_x, kappa U_y, kappa Omega) and
answers it with (F_x, kappa F_y, kappa M).
"""

from ...quantity import Table, quantity
from ..effect import Case, Effect


class LateralFriction(Table):
    """Friction along the local relative velocity: lateral and spin components.

    ratio : friction across the motion relative to that along x: 0 along x only, 1 along the local
        relative velocity
    """

    ratio: float = quantity(0.0, "1", ge=0, le=1, typical=(0.5, 1.0))


EFFECT = Effect(
    id="lateral_friction",
    table=LateralFriction,
    switch=("ratio",),
    enters="friction",
    source="Goyal, Ruina & Papadopoulos, Wear 143 (1991); named as missing by the source study",
    # every law of the contact is made of kappa (`kernel.friction`)
    core={"ratio": "LATERAL"},
    case=Case({"ratio": 1.0}, {"initial": {"vx": 0.15, "y": 0.01, "phi": 0.2}}),
)
