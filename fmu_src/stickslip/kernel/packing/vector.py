"""The vector ``p`` from the parameters' values and random draws."""

from __future__ import annotations

from .. import Floats
from ..layout import *
from ..terms import set_effect_numbers
from .friction import set_friction_law, set_kind_of_law
from .imperfections import set_mass, set_start
from .quadrature import set_quadrature
from .scales import set_scales
from .springs import place_springs, set_force_curve
from .tableau import set_tableau

# Rim speed over sliding speed up to which a few points of the disc tell how a law averages over it,
# to 1e-9 of what it varies by; the error grows with the eighth power.
FEW_POINTS = 0.07


def pack(v: Floats, d: Floats, p: Floats) -> None:
    """Make ``p`` of the parameters' values and the standard random numbers that go with them.

    The values are taken as checked; what ``p`` held before does not matter.
    """
    for i in range(P_SIZE):
        p[i] = 0.0
    set_rig(v, d, p)
    set_friction_law(v, p)
    set_effect_numbers(v, d, p)
    set_kind_of_law(p)
    set_start(v, d, p)
    place_springs(v, d, p)
    set_force_curve(v, p)
    set_scales(v, p)
    set_quadrature(p)
    set_tableau(p)


def set_rig(v: Floats, d: Floats, p: Floats) -> None:
    """The block, how it is guided and driven; an inertia of 0 is a disc of the contact radius."""
    set_mass(v, d, p)
    p[P_RADIUS] = v[V_RIG_CONTACT_RADIUS]
    p[P_INERTIA] = v[V_RIG_INERTIA]
    if p[P_INERTIA] == 0.0:
        p[P_INERTIA] = 0.5 * p[P_MASS] * (p[P_RADIUS] * p[P_RADIUS])
    p[P_NORMAL_FORCE] = p[P_MASS] * GRAVITY
    p[P_FREE_Y] = v[V_RIG_FREE_Y]
    p[P_FREE_PHI] = v[V_RIG_FREE_PHI]
    p[P_NATURAL_LENGTH] = v[V_RIG_SPRING_NATURAL_LENGTH]
    p[P_STIFFNESS] = v[V_SPRINGS_STIFFNESS]
    p[P_RUN_UP] = v[V_SURFACE_RUN_UP_TIME]
    p[P_TOLERANCE] = v[V_SOLVER_TOLERANCE]
    p[P_FEW_POINTS] = FEW_POINTS
