"""Manufactured solutions of the ice: the expected order of P2 elements in the L2 norm.

Axisymmetric, through the modes that the model advances: rho c u_t - k laplace u = f with

    u = exp(-t/60 s) (2 + cos(2 r^2/a^2)) exp(-z/d) on uniform meshes,

Newton cooling and flux on the boundary replaced by k u_n + h u = g with g from u. The load on each
mode falls with exp(-t/60 s), so the modes answer in closed form and only the mesh errs.

Three-dimensional, steady: -k laplace u = f with u = cos(x/l) sin(1 + y/l) exp(-z/d) on a box.
"""

import numpy as np
import pytest
from sample_meshes import box
from scipy.sparse.linalg import spsolve
from skfem import CellBasis, FacetBasis, Functional, LinearForm

from thermal import Ice
from thermal.ice.body import IceBody
from thermal.ice.cylinder import assembled as assembled_cylinder
from thermal.ice.sample import assembled

ORDER_OF_P2 = 3
K, RHO, C, H = 2.2, 917.0, 2050.0, 40.0
A, HEIGHT, D, L = 0.04, 0.10, 0.03, 0.05
DECAY, END = 1.0 / 60.0, 100.0


def radial(r):
    """g, g' and g'' + g'/r of g = 2 + cos(2 r^2/a^2)."""
    s = 2.0 * r**2 / A**2
    return (
        2.0 + np.cos(s),
        -4.0 * r / A**2 * np.sin(s),
        -8.0 / A**2 * np.sin(s) - 16.0 * r**2 / A**4 * np.cos(s),
    )


def axisymmetric_error(elements):
    body = assembled_cylinder(
        Ice(air_heat_transfer=H),
        np.linspace(0.0, A, elements + 1),
        np.linspace(0.0, HEIGHT, elements + 1),
    )
    basis = body.basis
    ice = IceBody(body.space(np.eye(basis.N)))

    def exact(x):
        return radial(x[0])[0] * np.exp(-x[1] / D)

    def source(x):
        g, _, laplace = radial(x[0])
        return np.exp(-x[1] / D) * (-RHO * C * DECAY * g - K * (laplace + g / D**2))

    load = LinearForm(lambda v, w: 2.0 * np.pi * w.x[0] * source(w.x) * v).assemble(
        CellBasis(basis.mesh, basis.elem, intorder=8)
    )
    for part, normal in (("side", (1, 0)), ("top", (0, 1)), ("bottom", (0, -1))):
        h = 0.0 if part == "bottom" else H

        def flux(v, w, normal=normal, h=h):
            g, slope, _ = radial(w.x[0])
            outward = normal[0] * slope - normal[1] * g / D
            return 2.0 * np.pi * w.x[0] * np.exp(-w.x[1] / D) * (K * outward + h * g) * v

        load += LinearForm(flux).assemble(
            FacetBasis(basis.mesh, basis.elem, facets=part, intorder=8)
        )
    start = np.linalg.solve(ice._shapes, exact(basis.doflocs))
    forced = ice._shapes.T @ load
    decayed = np.exp(-ice.rates * END)
    ice.amplitudes[:] = start * decayed + forced * (
        (np.exp(-DECAY * END) - decayed) / (ice.rates - DECAY)
    )
    fine = CellBasis(basis.mesh, basis.elem, intorder=8)
    square = Functional(
        lambda w: 2.0 * np.pi * w.x[0] * (w.u - exact(w.x) * np.exp(-DECAY * END)) ** 2
    )
    return np.sqrt(square.assemble(fine, u=fine.interpolate(ice.nodal())))


def test_axisymmetric_order():
    errors = [axisymmetric_error(n) for n in (4, 8, 16)]
    orders = np.log2(errors[:-1] / np.array(errors[1:]))
    assert orders[-1] == pytest.approx(ORDER_OF_P2, abs=0.3)


def box_error(n):
    points, cells = box((n, n, n), (0.08, 0.06, HEIGHT))
    body = assembled(Ice(air_heat_transfer=H), points, cells, 1.0)
    mesh, element = body.basis.mesh, body.basis.elem

    def exact(x):
        return np.cos(x[0] / L) * np.sin(1.0 + x[1] / L) * np.exp(-x[2] / D)

    def gradient(x):
        along = np.exp(-x[2] / D)
        return (
            -np.sin(x[0] / L) * np.sin(1.0 + x[1] / L) * along / L,
            np.cos(x[0] / L) * np.cos(1.0 + x[1] / L) * along / L,
            -exact(x) / D,
        )

    fine = CellBasis(mesh, element, intorder=8)
    load = LinearForm(lambda v, w: K * (2.0 / L**2 - 1.0 / D**2) * exact(w.x) * v).assemble(fine)
    free = np.setdiff1d(mesh.boundary_facets(), mesh.boundaries["base"])
    for facets, h in ((free, H), (mesh.boundaries["base"], 0.0)):
        load += LinearForm(
            lambda v, w, h=h: (
                v
                * (
                    h * exact(w.x)
                    + K * sum(slope * n for slope, n in zip(gradient(w.x), w.n, strict=True))
                )
            )
        ).assemble(FacetBasis(mesh, element, facets=facets, intorder=8))
    found = spsolve(body.conduction().tocsc(), load)
    square = Functional(lambda w: (w.u - exact(w.x)) ** 2)
    return np.sqrt(square.assemble(fine, u=fine.interpolate(found)))


def test_three_dimensional_order():
    errors = [box_error(n) for n in (2, 4, 8)]
    orders = np.log2(errors[:-1] / np.array(errors[1:]))
    assert orders[-1] == pytest.approx(ORDER_OF_P2, abs=0.3)
