"""stub"""

from numba import njit


@njit
def held_back(p, slow, t, h, s, friction):
    return 0.0, 1.0, 1.0, 1.0, 0.0


KINDS = {}
