"""Eigenmodes of an assembled heat conduction problem with Newton cooling.

With the eigenmodes K phi = lambda C phi, phi^T C phi = 1, of C u' + K u = 0 any piecewise constant
load is propagated exactly.
"""

import numpy as np
from scipy.linalg import eigh

from .arrays import Array

#: Modes that carry the heat of long times; see `eigenmodes`.
_SLOWEST = 40


def eigenmodes(factor: Array, capacity: Array) -> tuple[Array, Array]:
    """Rates (n,) 1/s and shapes (n, n), shapes^T capacity shapes = 1.

    capacity (n, n) J/K; factor (any, n): its square F^T F is the form K, W/K.

    A dense eigensolver errs by rounding times the fastest rate, which over long runs is not small
    against the slowest. A Rayleigh-Ritz step with the form's factor among the slowest modes, and
    Rayleigh quotients for all, err by rounding.
    """
    shapes = eigh(factor.T @ factor, capacity)[1]
    slow = shapes[:, :_SLOWEST]
    powers = factor @ slow
    slow[:] = slow @ eigh(powers.T @ powers, slow.T @ capacity @ slow)[1]
    shapes /= np.sqrt(np.sum(shapes * (capacity @ shapes), axis=0))
    return np.sum(np.square(factor @ shapes), axis=0), shapes
