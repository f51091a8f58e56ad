"""A force against the velocity v of the block: d v + q |v| v + F v / (v^2 + v_0^2)^(1/2).

The viscous part is that of materials and slow air, the quadratic one that of fast air (drag of a
bluff body), the last one dry friction in guides and joints, which turns round within some v_0. A
moment r omega stands against the rotation.
"""

from collections.abc import Iterator

from ...quantity import Table, quantity
from ..effect import Candidate, Case, Effect, FormsOf, Scales


class StructuralDamping(Table):
    """A force against the velocity in the frame: viscous, with its square, or dry friction.

    coefficient : force per velocity of the block
    rotational : moment per angular velocity of the block
    quadratic : q, force per square of the block's velocity
    dry_force : F, dry friction of guides and joints
    dry_speed : v_0, velocity within which dry friction turns round
    """

    coefficient: float = quantity(0.0, "N.s/m", ge=0, typical=(0.05, 2.0))
    rotational: float = quantity(0.0, "N.m.s", ge=0, typical=(1e-5, 1e-2))
    quadratic: float = quantity(0.0, "N.s2/m2", ge=0, typical=(0.1, 10.0))
    dry_force: float = quantity(0.0, "N", ge=0, typical=(0.003, 0.1))
    dry_speed: float = quantity(0.01, "m/s", gt=0, tried=(3e-3, 0.1))


own = FormsOf("structural_damping")


def candidates(s: Scales) -> Iterator[Candidate]:
    """Viscous, weak or strong, with the square of the velocity, or dry."""
    drag = 0.02 * (4.0 * s.stiffness * s.mass) ** 0.5  # a hundredth of the critical one
    for much in (1.0, 15.0):
        yield own.form("viscous", own.free("coefficient", much * drag, drag, 0.0, 100.0 * drag))
    much = drag / s.speed
    yield own.form("quadratic", own.free("quadratic", 5.0 * much, much, 0.0, 1e3 * much))
    force = own.free("dry_force", drag * s.speed, 0.3 * drag * s.speed, 0.0, s.force)
    within = own.free("dry_speed", 0.3 * s.speed, 0.5, 1e-3, 1.0, log=True)
    yield own.form("dry", force, within)


EFFECT = Effect(
    id="structural_damping",
    table=StructuralDamping,
    switch=("coefficient", "rotational", "quadratic", "dry_force"),
    enters="springs",
    axis="velocity",
    source="damping of a real rig",
    # loads, ledger and the velocity of a presliding contact are made of it
    core={
        "coefficient": "DAMPING",
        "rotational": "DAMPING_ROTATION",
        "quadratic": "DAMPING_QUADRATIC",
        "dry_force": "DAMPING_DRY",
        "dry_speed": "DAMPING_DRY_SPEED",
    },
    candidates=candidates,
    case=Case({"coefficient": 0.5}, window=(0.0, 8.0)),
)
