"""Two conducting bodies solved apart and coupled at their interface, against both solved at once.

One side is given the other's temperature and returns the heat flux that its equations leave over
at the interface; the other is given that flux and returns its temperature. Repeated within each
time step until the temperature no longer changes, with the temperature relaxed: by a constant, or
by Aitken's formula. Elements are scikit-fem's P2 or P1, time is backward Euler, as in the sources.
"""

import numpy as np
import pytest
from scipy.sparse.linalg import splu
from skfem import (
    CellBasis,
    ElementLineP1,
    ElementTriP2,
    LinearForm,
    MeshLine,
    MeshTri,
)
from skfem.models import laplace, mass

MOST_ITERATIONS = 60


class NotConverged(AssertionError):
    """The iteration of a time step did not settle."""


class Body:
    """One side: (capacity / dt) M + conductivity K, split at the nodes of the interface."""

    def __init__(self, basis, capacity, conductivity, dt, interface, held, order):
        self.basis, self.dt = basis, dt
        self.capacity = capacity * mass.assemble(basis)
        self.matrix = (self.capacity / dt + conductivity * laplace.assemble(basis)).tocsr()
        self.interface = interface[np.argsort(order(basis.doflocs[:, interface]))]
        self.held = np.setdiff1d(held, self.interface)
        self.u = np.zeros(basis.N)
        self._solvers = {}

    def _solve(self, right, given):
        """Unknowns from the equations of all nodes that are not given."""
        key = given.size
        free = np.setdiff1d(np.arange(self.u.size), given)
        if key not in self._solvers:
            self._solvers[key] = splu(self.matrix[free][:, free].tocsc())
        self._new[free] = self._solvers[key].solve(
            (right - self.matrix[:, given] @ self._new[given])[free]
        )

    def begin(self, source, held_values):
        """Start a time step: source at its end, values of the held nodes there."""
        self._right = self.capacity @ self.u / self.dt + source
        self._new = self.u.copy()
        self._new[self.held] = held_values

    def flux_for(self, temperature):
        """Power that the body takes at its interface nodes when they have this temperature."""
        self._new[self.interface] = temperature
        self._solve(self._right, np.concatenate((self.held, self.interface)))
        return (self.matrix @ self._new - self._right)[self.interface]

    def temperature_for(self, flux):
        """Interface temperature when this power flows in."""
        right = self._right.copy()
        right[self.interface] += flux
        self._solve(right, self.held)
        return self._new[self.interface].copy()

    def accept(self):
        self.u = self._new.copy()


def couple(dirichlet, neumann, temperature, relaxation, tolerance):
    """Iterate one time step; returns temperature and the number of iterations.

    relaxation: a constant, or "aitken" (Kuettler and Wall 2008, from 0.5 in the first iteration).
    """
    omega = 0.5 if relaxation == "aitken" else relaxation
    before = None
    scale = max(1.0, np.abs(temperature).max())
    for iteration in range(1, MOST_ITERATIONS + 1):
        residual = neumann.temperature_for(-dirichlet.flux_for(temperature)) - temperature
        if np.abs(residual).max() <= tolerance * scale:
            dirichlet.flux_for(temperature)
            return temperature, iteration
        if relaxation == "aitken" and before is not None:
            change = residual - before
            omega = -omega * (before @ change) / (change @ change)
        before = residual
        temperature = temperature + omega * residual
    raise NotConverged(f"{MOST_ITERATIONS} iterations leave {np.abs(residual).max():.3g}")


# T1: the partitioned heat equation of preCICE's tutorials.
ALPHA, BETA, WINDOW, END = 3.0, 1.2, 0.1, 1.0


def tutorial(x, t):
    return 1.0 + x[0] ** 2 + ALPHA * x[1] ** 2 + BETA * t


def square(left, cells):
    mesh = MeshTri.init_tensor(*2 * (np.linspace(0.0, 1.0, cells + 1),))
    if left > 0.0:  # the mirror image, so that the two bodies are equal on the mesh too
        mesh = MeshTri(np.stack((2.0 - mesh.p[0], mesh.p[1])), mesh.t)
    basis = CellBasis(mesh, ElementTriP2())
    at = basis.doflocs
    interface = np.flatnonzero(np.abs(at[0] - 1.0) < 1e-9)
    outer = np.flatnonzero(
        (np.abs(at[0] - 2.0 * left) < 1e-9) | (at[1] < 1e-9) | (at[1] > 1.0 - 1e-9)
    )
    return Body(basis, 1.0, 1.0, WINDOW, interface, outer, lambda places: places[1])


def run_tutorial(relaxation, tolerance, cells=4):
    """Largest error at t = 1 and iterations of the steps."""
    bodies = [square(0.0, cells), square(1.0, cells)]
    for body in bodies:
        body.u = tutorial(body.basis.doflocs, 0.0)
        # The interface's corners belong to the outer boundary, where the solution is given.
        inner = np.isin(
            body.interface,
            np.flatnonzero((body.basis.doflocs[1] > 1e-9) & (body.basis.doflocs[1] < 1.0 - 1e-9)),
        )
        body.held = np.union1d(body.held, body.interface[~inner])
        body.interface = body.interface[inner]
    left, right = bodies
    temperature, iterations = right.u[right.interface], []
    for step in range(1, round(END / WINDOW) + 1):
        for body in bodies:
            load = LinearForm(lambda v, w: (BETA - 2.0 - 2.0 * ALPHA) * v).assemble(body.basis)
            body.begin(load, tutorial(body.basis.doflocs[:, body.held], step * WINDOW))
        temperature, count = couple(left, right, temperature, relaxation, tolerance)
        iterations.append(count)
        for body in bodies:
            body.accept()
    error = max(np.abs(body.u - tutorial(body.basis.doflocs, END)).max() for body in bodies)
    return error, iterations


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9])
def test_partitioned_heat_errs_by_the_tolerance_alone(tolerance):
    """P2 and backward Euler hold the solution exactly: what the iteration leaves is the error."""
    error, _ = run_tutorial(0.4, tolerance)
    assert 1e-2 * tolerance < error < 10.0 * tolerance


def test_partitioned_heat_converges_at_once_with_one_half():
    """Two equal bodies mirror each other: the unrelaxed iteration swings, half of it is right."""
    error, iterations = run_tutorial(0.5, 1e-10)
    assert error < 1e-9
    assert max(iterations) <= 2
    with pytest.raises(NotConverged):
        run_tutorial(1.0, 1e-10)


# T2: water and steel.
WATER = (999.7 * 4192.1, 0.58)
STEEL = (7836.0 * 443.0, 48.9)
ELEMENTS, DT, STEPS = 100, 10.0, 100
INTERFACE_AFTER = 484.77653186
HEAT_AFTER = {"water": 1.33291735e9, "steel": 1.06778827e9}


def slab(left, capacity, conductivity):
    mesh = MeshLine(np.linspace(left, left + 1.0, ELEMENTS + 1))
    basis = CellBasis(mesh, ElementLineP1())
    at = basis.doflocs[0]
    body = Body(
        basis,
        capacity,
        conductivity,
        DT,
        np.flatnonzero(np.abs(at) < 1e-9),
        np.flatnonzero(np.abs(np.abs(at) - 1.0) < 1e-9),
        lambda places: places[0],
    )
    body.u = 500.0 * np.sin(0.5 * np.pi * (at + 1.0))
    return body


def run_slabs(on_water, relaxation, steps=STEPS):
    """Interface temperature, heats J/m2, and iterations of the first step."""
    water, steel = slab(-1.0, *WATER), slab(0.0, *STEEL)
    dirichlet, neumann = (water, steel) if on_water else (steel, water)
    temperature, first = water.u[water.interface], 0
    for _ in range(steps):
        for body in (water, steel):
            body.begin(0.0, 0.0)
        temperature, count = couple(dirichlet, neumann, temperature, relaxation, 1e-10)
        first = first or count
        for body in (water, steel):
            body.accept()
    heats = [float((body.capacity @ body.u).sum()) for body in (water, steel)]
    return float(temperature[0]), heats, first


@pytest.mark.parametrize("on_water", [True, False])
def test_water_and_steel_end_where_the_whole_does(on_water):
    temperature, heats, _ = run_slabs(on_water, "aitken")
    assert temperature == pytest.approx(INTERFACE_AFTER, rel=1e-9)
    assert heats == pytest.approx(list(HEAT_AFTER.values()), rel=1e-8)


@pytest.mark.parametrize(
    ("relaxation", "most"), [(1.0, 14), (0.5, 16), (0.76447, 3), ("aitken", 3)]
)
def test_iterations_of_water_and_steel(relaxation, most):
    """Contraction 0.3081 with the temperature given to the water."""
    assert run_slabs(True, relaxation, steps=1)[2] <= most


def test_temperature_given_to_the_steel_diverges_unless_relaxed():
    """Contraction 3.246: the side of the larger effusivity must not be the one that is given it."""
    with pytest.raises(NotConverged):
        run_slabs(False, 1.0, steps=1)
    assert run_slabs(False, "aitken", steps=1)[2] <= 3
