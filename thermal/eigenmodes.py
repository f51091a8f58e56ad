"""Eigenmodes of an assembled heat conduction problem with Newton cooling.

scikit-fem assembles  C u' + K u = 0  with C = int rho c u v and
K = int k grad u . grad v + sum over the films of int h u v. With the eigenmodes
K phi = lambda C phi, phi^T C phi = 1, any piecewise constant load is propagated exactly.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh
from skfem import BilinearForm, CellBasis, FacetBasis, LinearForm

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Medium:
    """Density kg/m3, heat capacity J/kgK, conductivity W/mK."""

    density: float
    heat_capacity: float
    conductivity: float

    @property
    def capacity(self) -> float:
        """Heat capacity of a volume, J/m3K."""
        return self.density * self.heat_capacity


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


def _rayleigh_rates(basis: CellBasis, films: Sequence[tuple[FacetBasis, float]], medium: Medium,
                    measure: Callable, shapes: Array) -> Array:
    """Rayleigh quotients with numerators summed as squares.

    A dense eigensolver errs by rounding times the LARGEST rate, which over long runs is not
    small against the slowest rates. A sum of squares has no cancellation and errs by rounding
    times the rate itself.
    """
    weight = medium.conductivity * measure(basis.global_coordinates()) * basis.dx
    rates = np.empty(shapes.shape[1])
    for n, shape in enumerate(shapes.T):
        gradient = basis.interpolate(shape).grad
        rates[n] = np.sum(weight * np.sum(np.square(gradient), axis=0))
        for film, h in films:
            value = np.asarray(film.interpolate(shape))
            rates[n] += h * np.sum(measure(film.global_coordinates()) * np.square(value) * film.dx)
    return rates


def eigenmodes(basis: CellBasis, films: Sequence[tuple[FacetBasis, float]], medium: Medium,
               measure: Callable) -> Eigenmodes:
    """Assemble and solve.

    films: facet bases, each with its heat transfer coefficient in W/m2K; measure: weight of the
    volume element from coordinates (1 for a slab, 2 pi r for a body of revolution).
    """
    capacity = BilinearForm(lambda u, v, w: medium.capacity * measure(w.x) * u * v).assemble(basis)
    conduction = BilinearForm(
        lambda u, v, w: medium.conductivity * measure(w.x) * sum(
            u.grad[i] * v.grad[i] for i in range(basis.mesh.dim()))).assemble(basis)
    film_form = BilinearForm(lambda u, v, w: measure(w.x) * u * v)
    film_load = LinearForm(lambda v, w: measure(w.x) * v)
    stiffness = conduction.toarray()
    air = np.zeros(basis.N)
    for film, h in films:
        stiffness += h * film_form.assemble(film).toarray()
        air += h * film_load.assemble(film)
    shapes = eigh(stiffness, capacity.toarray())[1]
    shapes /= np.sqrt(np.sum(shapes * (capacity @ shapes), axis=0))
    heat = capacity.T @ np.ones(basis.N)
    return Eigenmodes(_rayleigh_rates(basis, films, medium, measure, shapes), shapes,
                      heat=heat @ shapes, air=air @ shapes)
