"""Conduction in two dimensions against manufactured solutions: the order of the P2 element.

On [0, a] x [0, d], insulated at the ends, film h at both faces, as the belt's cross-section:

    rho c u_t - lambda (u_xx + u_zz) = f,      lambda u_n + h u = g.

With a source f that is constant in time, the eigenmodes propagate the assembled problem exactly,
so all that is left is the error of the elements: order 3 in L2, 2 in the gradient.
"""

import numpy as np
import pytest
from scipy.optimize import brentq
from skfem import (
    CellBasis,
    ElementQuad2,
    ElementTriP2,
    FacetBasis,
    Functional,
    LinearForm,
    MeshQuad,
    MeshTri,
)

from thermal.assembly import Body
from thermal.materials import Medium
from thermal.relaxation import eigenmodes, mean_decay

A, D, H = 0.02, 0.01, 40.0
MEDIUM = Medium(700.0, 840.0, 0.5)
ORDER_IN_L2, ORDER_OF_GRADIENT = 3, 2
ASYMPTOTIC = 0.2
CELLS = (2, 4, 8)


def slowest_in_thickness():
    """beta with beta tan beta = h d / (2 lambda): cos(beta (1 - 2 z/d)) obeys both films."""
    biot = H * D / (2.0 * MEDIUM.conductivity)
    return brentq(lambda b: b * np.tan(b) - biot, 1e-6, 1.5, xtol=1e-15)


BETA = slowest_in_thickness()
RATE = MEDIUM.conductivity / MEDIUM.capacity * ((np.pi / A) ** 2 + (2.0 * BETA / D) ** 2)


def wave(x):
    """A mode of the exact problem: it obeys all boundary conditions with g = 0."""
    return np.cos(np.pi * x[0] / A) * np.cos(BETA * (1.0 - 2.0 * x[1] / D))


def wave_gradient(x):
    angle = BETA * (1.0 - 2.0 * x[1] / D)
    return np.stack(
        (
            -np.pi / A * np.sin(np.pi * x[0] / A) * np.cos(angle),
            2.0 * BETA / D * np.cos(np.pi * x[0] / A) * np.sin(angle),
        )
    )


def hill(x):
    """No mode of anything; flat at the ends."""
    return np.cos(np.pi * x[0] / A) ** 2 * np.exp(x[1] / D)


def hill_gradient(x):
    return np.stack((-np.pi / A * np.sin(2.0 * np.pi * x[0] / A) * np.exp(x[1] / D), hill(x) / D))


def hill_source(x):
    second = -2.0 * (np.pi / A) ** 2 * np.cos(2.0 * np.pi * x[0] / A) * np.exp(x[1] / D)
    return -MEDIUM.conductivity * (second + hill(x) / D**2)


def setting(cells, element):
    mesh = MeshQuad.init_tensor(np.linspace(0, A, 2 * cells + 1), np.linspace(0, D, cells + 1))
    if element is ElementTriP2:
        mesh = MeshTri.init_tensor(np.linspace(0, A, 2 * cells + 1), np.linspace(0, D, cells + 1))
    basis = CellBasis(mesh, element(), intorder=8)
    faces = FacetBasis(
        mesh,
        element(),
        intorder=8,
        facets=mesh.facets_satisfying(lambda x: (x[1] < 1e-9) | (x[1] > D - 1e-9)),
    )
    body = Body(basis, MEDIUM, H, faces, None, faces, one, one, D)
    space = body.space(np.eye(basis.N))
    return basis, faces, *eigenmodes(space.factor(1.0), space.capacity)


def one(x):
    return np.ones_like(x[0])


def errors(basis, nodal, exact, gradient, scale):
    """L2 norms of the error and of its gradient."""
    field = basis.interpolate(nodal)
    value = Functional(lambda w: (w["u"] - scale * exact(w.x)) ** 2).assemble(basis, u=field)
    slope = Functional(
        lambda w: sum((w["u"].grad[i] - scale * gradient(w.x)[i]) ** 2 for i in (0, 1))
    ).assemble(basis, u=field)
    return np.sqrt([value, slope])


def transient(cells, element):
    """u = (1 - exp(-rate t)) wave, from f = rate rho c wave."""
    basis, _, rates, shapes = setting(cells, element)
    time = 0.7 / RATE
    source = LinearForm(lambda v, w: RATE * MEDIUM.capacity * wave(w.x) * v).assemble(basis)
    amplitudes = time * mean_decay(rates * time) * (shapes.T @ source)
    return errors(basis, shapes @ amplitudes, wave, wave_gradient, 1.0 - np.exp(-0.7))


def steady(cells, element):
    """u = hill for ever, from its source and the flux that its faces need."""
    basis, faces, rates, shapes = setting(cells, element)
    load = LinearForm(lambda v, w: hill_source(w.x) * v).assemble(basis)
    load = load + LinearForm(
        lambda v, w: (
            (
                MEDIUM.conductivity * sum(hill_gradient(w.x)[i] * w.n[i] for i in (0, 1))
                + H * hill(w.x)
            )
            * v
        )
    ).assemble(faces)
    amplitudes = (shapes.T @ load) / rates
    return errors(basis, shapes @ amplitudes, hill, hill_gradient, 1.0)


@pytest.mark.parametrize("element", [ElementQuad2, ElementTriP2])
@pytest.mark.parametrize("solution", [transient, steady])
def test_order_of_p2(solution, element):
    found = np.array([solution(cells, element) for cells in CELLS])
    order = np.log2(found[:-1] / found[1:])[-1]
    assert order[0] == pytest.approx(ORDER_IN_L2, abs=ASYMPTOTIC)
    assert order[1] == pytest.approx(ORDER_OF_GRADIENT, abs=ASYMPTOTIC)
