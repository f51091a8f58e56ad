"""A polynomial that stands in for the model, through some runs of it.

Legendre's on the unit cube, orthogonal under the even distribution of the points, up to a degree p
in the hyperbolic norm (sum n_i^q)^(1/q) <= p, which has few mixed terms (Blatman and Sudret 2011,
J. Comput. Phys. 230, 2345-2367); least squares; of the model's values or of their logarithms;
degree, norm and logarithm are those with the least error when each point is left out.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import legvander
from numpy.typing import NDArray

Array = NDArray[np.float64]

#: Degrees and norms that are tried; a fit takes at most this part of the points for its terms.
_DEGREES, _NORMS, _MOST_TERMS = (1, 2, 3, 4, 5), (0.5, 0.75, 1.0), 0.6


@dataclass(frozen=True)
class Polynomial:
    """indices (terms, dimensions), coefficients (terms,); of the logarithm if `logarithm`."""

    indices: NDArray[np.intp]
    coefficients: Array
    logarithm: bool

    def __call__(self, points: Array) -> Array:
        """Values at points (n, dimensions) of the unit cube."""
        values = _terms(points, self.indices) @ self.coefficients
        return np.exp(values) if self.logarithm else values


def fitted(points: Array, values: Array, kinds: tuple[bool, ...] = (False, True)) -> Polynomial:
    """Through points (n, dimensions) of the unit cube with values (n,).

    kinds: whether it may be one of the values (False), of their logarithms (True); the latter only
    where all are above 0.
    """
    fits = [
        _fit(points, values, indices, logarithm)
        for logarithm in (kinds if np.all(values > 0.0) else (False,))
        for indices in _index_sets(points.shape[1], int(_MOST_TERMS * len(points)))
    ]
    return min(fits, key=lambda fit: fit[1])[0]


def _fit(
    points: Array, values: Array, indices: NDArray[np.intp], logarithm: bool
) -> tuple[Polynomial, float]:
    """The fit, and the root mean square error of each point by a fit without it."""
    terms = _terms(points, indices)
    goal = np.log(values) if logarithm else values
    q, r = np.linalg.qr(terms)
    coefficients = np.linalg.solve(r, q.T @ goal)
    fit = terms @ coefficients
    left_out = goal - (goal - fit) / np.maximum(1.0 - np.sum(q**2, axis=1), 1e-6)
    said = np.exp(np.minimum(left_out, 50.0)) if logarithm else left_out
    return (
        Polynomial(indices, coefficients, logarithm),
        float(np.sqrt(np.mean((said - values) ** 2))),
    )


def _terms(points: Array, indices: NDArray[np.intp]) -> Array:
    """The polynomials of the indices at points: (n, terms)."""
    each = legvander(2.0 * points - 1.0, int(indices.max()))
    terms = np.ones((len(points), len(indices)))
    for dimension in range(points.shape[1]):
        terms *= each[:, dimension, indices[:, dimension]]
    return terms


def _index_sets(dimensions: int, most: int) -> Iterator[NDArray[np.intp]]:
    """Degrees of each dimension in each term: (terms, dimensions), at most `most` terms."""
    seen = set()
    for norm in _NORMS:
        for degree in _DEGREES:
            found = np.array(list(_within(dimensions, degree, norm, float(degree) ** norm)))
            if len(found) > most:
                break
            if len(found) not in seen:
                seen.add(len(found))
                yield found


def _within(dimensions: int, degree: int, norm: float, left: float) -> Iterator[tuple[int, ...]]:
    if dimensions == 0:
        yield ()
        return
    for n in range(degree + 1):
        rest = left - n**norm
        if rest < -1e-9:
            break
        for others in _within(dimensions - 1, degree, norm, rest):
            yield (n, *others)
