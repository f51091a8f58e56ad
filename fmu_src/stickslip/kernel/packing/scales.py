"""Scales of the motion, which the integrator needs."""

from __future__ import annotations

from math import sqrt

from .. import Floats
from ..layout import *
from ..terms import with_fastest_rate


def set_scales(v: Floats, p: Floats) -> None:
    """Rate and speed that belong to this rig, and the longest step.

    Rate and speed scale the integrator's error test only: where nothing sets a rate (no springs) it
    is 1 rad/s, where nothing sets a speed 1e-6 m/s. No step is longer than a twelfth of a period.
    """
    rate = max(sqrt(4.0 * p[P_STIFFNESS] / p[P_MASS]), 1.0)
    p[P_RATE] = rate
    given = max(rate * size_of(p, P_INITIAL), size_of(p, P_INITIAL + 3))
    p[P_SPEED_SCALE] = max(max(p[P_MU_S] * GRAVITY / rate, given), 1e-6)
    p[P_LONGEST_STEP] = 0.5 / rate
    fastest = with_fastest_rate(p, v, 0.0)
    if fastest > 0.0:
        p[P_LONGEST_STEP] = min(p[P_LONGEST_STEP], 0.5 / fastest)
    p[P_LONGEST_STICK] = p[P_LONGEST_STEP]


def size_of(p: Floats, at: int) -> float:
    """Length of a displacement (m) or velocity (m/s) ``p[at:]``, turns as far as the rim goes."""
    rim = p[P_RADIUS] * p[at + 2]
    return sqrt(p[at] * p[at] + p[at + 1] * p[at + 1] + rim * rim)
