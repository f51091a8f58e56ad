"""Eigenmodes of an assembled heat conduction problem with Newton cooling.

scikit-fem assembles  C u' + K u = 0  with C = int rho c u v and
K = int k grad u . grad v + sum over the films of int h u v. With the eigenmodes
K phi = lambda C phi, phi^T C phi = 1, any piecewise constant load is propagated exactly.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.sparse import spmatrix
from skfem import BilinearForm, CellBasis, FacetBasis, LinearForm

from .materials import Medium

Array = NDArray[np.float64]
#: Places (d, ...) -> what an element of them counts.
Measure = Callable[[Array], Array]
Films = Sequence[tuple[FacetBasis, float]]

#: Modes that carry the heat of long times; see `_sharpen`.
_SLOWEST = 40


@dataclass(frozen=True)
class Eigenmodes:
    """n modes on N degrees of freedom.

    rates (n,) 1/s; shapes (N, n); heat (n,) J for amplitude 1; air (n,) W given to the
    air for amplitude 1.
    """

    rates: Array
    shapes: Array
    heat: Array
    air: Array


def _weighted_gradients(
    basis: CellBasis, films: Films, medium: Medium, measure: Measure, shape: Array
) -> Array:
    """Vector g of a shape at the quadrature points with phi^T K psi = g(phi) . g(psi)."""
    weight = medium.conductivity * measure(basis.global_coordinates()) * basis.dx
    parts = [np.sqrt(weight) * basis.interpolate(shape).grad]
    for film, h in films:
        weight = h * measure(film.global_coordinates()) * film.dx
        parts.append(np.sqrt(weight) * np.asarray(film.interpolate(shape)))
    return np.concatenate([part.ravel() for part in parts])


def _sharpen(shapes: Array, capacity: spmatrix, gradients: Callable[[Array], Array]) -> Array:
    """Separate the slowest modes from each other again, in place; returns all rates.

    A dense eigensolver errs by rounding times the FASTEST rate, which over long runs is not small
    against the slowest. Stiffnesses formed as sums of squares have no such error: a Rayleigh-Ritz
    step with them among the slowest modes, and Rayleigh quotients for all, err by rounding.
    """
    slow = shapes[:, :_SLOWEST]
    factors = np.stack([gradients(shape) for shape in slow.T])
    slow[:] = slow @ eigh(factors @ factors.T, slow.T @ (capacity @ slow))[1]
    shapes /= np.sqrt(np.sum(shapes * (capacity @ shapes), axis=0))
    return np.array([np.sum(np.square(gradients(shape))) for shape in shapes.T])


def eigenmodes(basis: CellBasis, films: Films, medium: Medium, measure: Measure) -> Eigenmodes:
    """Assemble and solve.

    films: facet bases, each with its heat transfer coefficient in W/m2K; measure: weight of the
    volume element from coordinates (1 for a slab, 2 pi r for a body of revolution).
    """
    capacity = BilinearForm(lambda u, v, w: medium.capacity * measure(w.x) * u * v).assemble(basis)
    conduction = BilinearForm(
        lambda u, v, w: (
            medium.conductivity
            * measure(w.x)
            * sum(u.grad[i] * v.grad[i] for i in range(basis.mesh.dim()))
        )
    ).assemble(basis)
    film_form = BilinearForm(lambda u, v, w: measure(w.x) * u * v)
    film_load = LinearForm(lambda v, w: measure(w.x) * v)
    stiffness = conduction.toarray()
    air = np.zeros(basis.N)
    for film, h in films:
        stiffness += h * film_form.assemble(film).toarray()
        air += h * film_load.assemble(film)
    shapes = eigh(stiffness, capacity.toarray())[1]
    rates = _sharpen(shapes, capacity, partial(_weighted_gradients, basis, films, medium, measure))
    heat = capacity.T @ np.ones(basis.N)
    return Eigenmodes(rates, shapes, heat=heat @ shapes, air=air @ shapes)
