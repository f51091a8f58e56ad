"""Exact step of M q'' + K q = load under a load that is linear in time over the step.

With W = M^-1 K and load accelerations a0, a1 at the ends of a step h

    q1  =    Co q0 + Si q0' + P2 a0 + P3 (a1 - a0)
    q1' = -W Si q0 + Co q0' + Si a0 + (P2/h) (a1 - a0)

Co = sum (-W h^2)^n/(2n)!, Si = h sum (-W h^2)^n/(2n+1)!, P2 and P3 = h^2 sum (-W h^2)^n/(2n+2)!
and /(2n+3)!: the blocks of the matrix exponential with a first-order hold.
"""

from __future__ import annotations

import numpy as np
from numba import njit

CO, SI, P2, P3, WSI = 0, 1, 2, 3, 4
# steps are 0.1 ms: |W h^2| < 0.02 even at 9999 N/m, where the ninth term is below 1e-30
TERMS = 8


@njit(cache=True)
def _times(a, b):
    """Product of two (3, 3)."""
    product = np.zeros((3, 3))
    for i in range(3):
        for j in range(3):
            for n in range(3):
                product[i, j] += a[i, n] * b[n, j]
    return product


@njit(cache=True)
def propagator(w, h, out):
    """Write Co, Si, P2, P3 and W Si for the step ``h`` into ``out`` (5, 3, 3); w (3, 3), 1/s2."""
    out[:, :, :] = 0.0
    power = np.eye(3)
    factor = 1.0  # 1/(2n)!
    for n in range(TERMS):
        even = 2.0 * n
        out[CO] += power * factor
        factor /= even + 1.0
        out[SI] += power * (factor * h)
        factor /= even + 2.0
        out[P2] += power * (factor * h * h)
        out[P3] += power * (factor * h * h / (even + 3.0))
        power = _times(power, w * (-h * h))
    out[WSI] = _times(w, out[SI])


@njit(cache=True)
def step(prop, h, q, v, a0, a1, q1, v1):
    """Write the state after the step into ``q1``, ``v1`` (3,); the others are left alone."""
    for i in range(3):
        place = 0.0
        speed = 0.0
        for j in range(3):
            ramp = a1[j] - a0[j]
            place += (
                prop[CO, i, j] * q[j]
                + prop[SI, i, j] * v[j]
                + prop[P2, i, j] * a0[j]
                + prop[P3, i, j] * ramp
            )
            speed += (
                prop[CO, i, j] * v[j]
                - prop[WSI, i, j] * q[j]
                + prop[SI, i, j] * a0[j]
                + prop[P2, i, j] / h * ramp
            )
        q1[i] = place
        v1[i] = speed
