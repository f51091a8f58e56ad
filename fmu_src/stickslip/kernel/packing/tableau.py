"""The Runge-Kutta coefficients of ``dormand_prince.toml``, where the integrator looks.

It takes any explicit tableau of this shape from the parameter vector.
"""

from __future__ import annotations

from .. import Floats
from ..layout import *


def set_tableau(p: Floats) -> None:
    """Put the tableau where the integrator looks; what a row leaves unused is 0."""
    k = 0
    for i in range(ALL_STAGES):  # the rows of T_B follow those of T_A
        for j in range(i):
            p[P_TABLEAU + T_A + ALL_STAGES * i + j] = STAGE_WEIGHTS[k]
            k += 1
    for i in range(ALL_STAGES):
        p[P_TABLEAU + T_C + i] = NODES[i]
    for i in range(STAGES):
        p[P_TABLEAU + T_E5 + i] = ERROR_WEIGHTS_5[i]
        p[P_TABLEAU + T_E3 + i] = ERROR_WEIGHTS_3[i]
    for i in range(EXTRA_POWERS * ALL_STAGES):
        p[P_TABLEAU + T_D + i] = INTERPOLANT_WEIGHTS[i]
