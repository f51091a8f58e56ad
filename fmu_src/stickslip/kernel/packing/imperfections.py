"""What a rig departs by from its drawing."""

from __future__ import annotations

from math import radians

from .. import Floats
from ..layout import *


def departure(d: Floats, i: int, deviation: float) -> float:
    """Draw i, normally distributed with a standard deviation and cut at three of them."""
    return deviation * max(-3.0, min(3.0, d[i]))


def set_mass(v: Floats, d: Floats, p: Floats) -> None:
    """Mass of the block, kg, as this rig has it."""
    p[P_MASS] = v[V_RIG_MASS] * (1.0 + departure(d, D_MASS, v[V_IMPERFECTIONS_MASS]))


def set_start(v: Floats, d: Floats, p: Floats) -> None:
    """Where the block stands at the start and how it moves: x, y, phi, vx, vy, omega."""
    for i in range(6):
        p[P_INITIAL + i] = v[V_INITIAL_X + i]
    for i in range(2):
        p[P_INITIAL + i] += departure(d, D_START_POSITION + i, v[V_IMPERFECTIONS_START_POSITION])
    turn = radians(v[V_IMPERFECTIONS_START_ANGLE_DEG])
    p[P_INITIAL + 2] += departure(d, D_START_ANGLE, turn)
