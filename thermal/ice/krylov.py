"""A small space that contains how a body of any shape answers a flux on its contact.

Heat conduction C u' + K u = b p(t) with one load b and the mean over the same contact as what is
asked for has the transfer function b^T (s C + K)^-1 b. The Galerkin space of the solutions of
(s C + K) u = b for shifts s interpolates it, with its derivative, at every shift, and stays
symmetric and dissipative (rational Krylov space; Antoulas, Approximation of Large-Scale Dynamical
Systems, 2005). The error falls geometrically with the number of shifts in a decade. With the
constant in the space, heat is conserved to rounding.
"""

import numpy as np
from scipy.sparse import csr_matrix, diags
from scipy.sparse.linalg import cg

from thermal.arrays import Array

#: Shifts, 1/s: from the first tenths of a millisecond to days, 2.5 in a decade.
SHIFTS = np.geomspace(1e4, 1e-6, 26)

#: A solution need not be exact to span the space: this changes the response by 1e-7 of itself.
_TOLERANCE = 1e-6
_MOST_ITERATIONS = 20_000

#: Directions that are the same but for this part are left out.
_DEPENDENT = 1e-11


def response_space(capacity: csr_matrix, conduction: csr_matrix, load: Array) -> Array:
    """Trial functions (N, n), orthonormal in the capacity; the first is constant.

    ArithmeticError when the equations cannot be solved.
    """
    ones = np.ones(load.size)
    space: Array = (ones / np.sqrt(ones @ (capacity @ ones)))[:, None]
    for shift in SHIFTS:
        system = (shift * capacity + conduction).tocsr()
        guess = space @ np.linalg.solve(space.T @ (system @ space), space.T @ load)
        found, failed = cg(
            system,
            load,
            x0=guess,
            rtol=_TOLERANCE,
            maxiter=_MOST_ITERATIONS,
            M=diags(1.0 / system.diagonal()),
        )
        if failed:
            raise ArithmeticError(
                f"its answer to heat at {shift:g} 1/s did not converge in {_MOST_ITERATIONS}"
                " iterations: are some of its elements very flat?"
            )
        space = _extended(space, found, capacity)
    return space


def _extended(space: Array, vector: Array, capacity: csr_matrix) -> Array:
    """Add a direction, unless it lies in the space; twice is enough."""
    size = np.sqrt(vector @ (capacity @ vector))
    for _ in range(2):
        vector = vector - space @ (space.T @ (capacity @ vector))
    left = np.sqrt(vector @ (capacity @ vector))
    return space if left <= _DEPENDENT * size else np.column_stack((space, vector / left))
