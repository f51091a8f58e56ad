"""A force against the frame that grows with the velocity v of the block: d v + q |v| v.

The viscous part is that of materials and slow air, the quadratic one that of fast air (drag of a
bluff body). A moment r omega stands against the rotation.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...quantity import Table, quantity
from ..candidate import Candidate, FreeParameter, Scales
from ..effect import Case, Effect


class StructuralDamping(Table):
    """A force against the frame that grows with the velocity: viscous, or with its square."""

    coefficient: float = quantity(
        0.0, "N.s/m", "force per velocity of the block", ge=0, typical=(0.05, 2.0)
    )
    rotational: float = quantity(
        0.0, "N.m.s", "moment per angular velocity of the block", ge=0, typical=(1e-5, 1e-2)
    )
    quadratic: float = quantity(
        0.0,
        "N.s2/m2",
        "q, force per square of the block's velocity",
        ge=0,
        typical=(0.1, 10.0),
    )


def candidates(s: Scales) -> Iterator[Candidate]:
    """Viscous, weak or strong, or with the square of the velocity."""
    drag = 0.02 * (4.0 * s.stiffness * s.mass) ** 0.5  # a hundredth of the critical one
    for much in (1.0, 15.0):
        free = FreeParameter("structural_damping.coefficient", much * drag, drag, 0.0, 100.0 * drag)
        yield Candidate("structural_damping", "viscous", (free,))
    much = drag / s.speed
    square = FreeParameter("structural_damping.quadratic", 5.0 * much, much, 0.0, 1e3 * much)
    yield Candidate("structural_damping", "quadratic", (square,))


EFFECT = Effect(
    id="structural_damping",
    table=StructuralDamping,
    switch=("coefficient", "rotational", "quadratic"),
    enters="springs",
    axis="velocity",
    source="damping of a real rig",
    # loads, ledger and the velocity of a presliding contact are made of it
    core={
        "coefficient": "DAMPING",
        "rotational": "DAMPING_ROTATION",
        "quadratic": "DAMPING_QUADRATIC",
    },
    candidates=candidates,
    case=Case({"coefficient": 0.5}, window=(0.0, 8.0)),
)
