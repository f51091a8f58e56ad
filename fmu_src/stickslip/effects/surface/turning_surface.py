"""The surface is a turning slab: its speed varies over the disc and has a lateral part.

With the curvature c = 1/R the surface turns at the rate v c about (0, R), with v at the place of
installation.
"""

from ...quantity import Table, quantity
from ..effect import Case, Effect


class TurningSurface(Table):
    """The surface is a turning slab: its speed varies over the disc and has a lateral part.

    curvature : 1/R of a surface that turns about (0, R); 0 is a belt
    """

    curvature: float = quantity(0.0, "1/m", ge=-20, le=20, typical=(-4.0, 4.0))


EFFECT = Effect(
    id="turning_surface",
    table=TurningSurface,
    switch=("curvature",),
    enters="surface",
    source="the source study's rotating slab, whose turning it leaves out",
    # stick and quasi-steady sliding need its accelerations (`kernel.rig.surface`)
    core={"curvature": "CURVATURE"},
    case=Case({"curvature": 4.0}, {"lateral_friction": {"ratio": 1.0}}),
)
