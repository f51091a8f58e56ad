"""A viscous force against the frame.

Loads, ledger and the velocity of a presliding contact are made of it, so the core of the kernel
knows both coefficients by name.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...quantity import Table, quantity
from ..candidate import Candidate, FreeParameter, Scales
from ..effect import Case, Effect


class StructuralDamping(Table):
    """A viscous force against the frame."""

    coefficient: float = quantity(
        0.0, "N.s/m", "force per velocity of the block", ge=0, typical=(0.05, 2.0)
    )
    rotational: float = quantity(
        0.0, "N.m.s", "moment per angular velocity of the block", ge=0, typical=(1e-5, 1e-2)
    )


def candidates(s: Scales) -> Iterator[Candidate]:
    """Weak or strong."""
    drag = 0.02 * (4.0 * s.stiffness * s.mass) ** 0.5  # a hundredth of the critical one
    for much in (1.0, 15.0):
        free = FreeParameter("structural_damping.coefficient", much * drag, drag, 0.0, 100.0 * drag)
        yield Candidate("structural_damping", "viscous", (free,))


EFFECT = Effect(
    id="structural_damping",
    table=StructuralDamping,
    switch=("coefficient", "rotational"),
    enters="springs",
    axis="velocity",
    source="damping of a real rig",
    core={"coefficient": "DAMPING", "rotational": "DAMPING_ROTATION"},
    candidates=candidates,
    case=Case({"coefficient": 0.5}, window=(0.0, 8.0)),
)
