"""Heat between two bodies: how many iterations a step takes, and where one pass is stable.

Two slabs: [-1, 0] of water and [0, 1] of steel, 0 outside, T(x, 0) = 500 sin(pi (x + 1) / 2);
linear elements with consistent mass, 100 each, backward Euler with 10 s, which is also the macro
step. The numbers for one solver, the contraction and the iterations were computed with an
independent program.
"""

from math import log, pi

import numpy as np
import pytest
from part import Restorable

from cosim.coupling import (
    Aitken,
    Connection,
    CoupledSystem,
    GaussSeidel,
    Iterated,
    Jacobi,
    QuasiNewton,
    Relaxation,
    Tolerance,
    inputs,
    outputs,
    port_table,
    run,
)

WATER, STEEL = (0.58, 999.7 * 4192.1), (48.9, 7836.0 * 443.0)  # W/(m K), J/(m3 K)
TIGHT = Tolerance(1e-10)
STEP = 10.0  # s


class Slab(Restorable):
    """A slab of 1 m: matrices of its nodes, the last of which lies at the interface."""

    def __init__(self, name, ports, material, start, elements=100):
        self.name, self.ports = name, port_table(ports)
        k, rho_c = material
        size, n = 1.0 / elements, elements + 1
        self.mass, self.stiff = np.zeros((n, n)), np.zeros((n, n))
        for i in range(elements):
            self.mass[i : i + 2, i : i + 2] += rho_c * size / 6 * np.array([[2.0, 1.0], [1.0, 2.0]])
            self.stiff[i : i + 2, i : i + 2] += k / size * np.array([[1.0, -1.0], [-1.0, 1.0]])
        self.t = np.asarray(start, dtype=float)
        self.given, self.flux = 0.0, 0.0
        self._inverse = {}

    def write(self, values):
        (self.given,) = values.values()

    def euler(self, size, last):
        """Inverse of mass / size + stiffness for the nodes from the second to `last`."""
        if size not in self._inverse:
            self._inverse[size] = np.linalg.inv((self.mass / size + self.stiff)[1:last, 1:last])
        return self._inverse[size]


class Driven(Slab):
    """Takes the temperature of the interface, gives the heat flux (W/m2) that leaves it there."""

    def __init__(self, name, *rest, **more):
        super().__init__(name, inputs(T="K") + outputs(q="W/m2"), *rest, **more)

    def read(self):
        return {"q": self.flux}

    def step(self, time, size):
        whole, old = self.mass / size + self.stiff, self.mass / size @ self.t
        new = np.zeros_like(self.t)
        new[-1] = self.given
        new[1:-1] = self.euler(size, -1) @ (old[1:-1] - whole[1:-1, -1] * self.given)
        # residual of the last node's equation: exact in the energy
        self.flux = float(old[-1] - whole[-1] @ new)
        self.t = new


class Heated(Slab):
    """Takes a heat flux at the interface, gives its temperature."""

    def __init__(self, name, *rest, **more):
        super().__init__(name, inputs(q="W/m2") + outputs(T="K"), *rest, **more)

    def read(self):
        return {"T": float(self.t[-1])}

    def step(self, time, size):
        load = (self.mass / size @ self.t)[1:]
        load[-1] += self.given
        self.t = np.concatenate([[0.0], self.euler(size, None) @ load])


def profile(elements=100):
    """From outside to the interface."""
    return 500.0 * np.sin(pi * np.linspace(0.0, 1.0, elements + 1) / 2)


def slabs(driven, heated):
    """A system of two materials, and its two participants."""
    pair = Driven("driven", driven, profile()), Heated("heated", heated, profile())
    links = [Connection("driven.q", "heated.q"), Connection("heated.T", "driven.T")]
    return CoupledSystem(pair, links), *pair


def iterated(acceleration, **more):
    settings = {"tolerance": TIGHT, "most_iterations": 60} | more
    return Iterated(("driven", "heated"), "held", acceleration=acceleration, **settings)


def stored(slab):
    return float(slab.mass.sum(axis=0) @ slab.t)


@pytest.mark.parametrize(
    "acceleration, most",
    [(Relaxation(), 14), (Relaxation(0.5), 16), (Relaxation(0.76447), 2), (Aitken(), 3)],
    ids=["plain", "half", "best", "Aitken"],
)
def test_water_driven_by_its_temperature_converges_as_theory_has_it(acceleration, most):
    system, *_ = slabs(WATER, STEEL)
    result = run(system, iterated(acceleration), stop=STEP, macro_step=STEP)
    assert result.status == "complete", result.reason
    # one iteration more or less is a matter of what is compared with 1e-10
    assert result.statistics.iterations <= most + 1


class Watched(Relaxation):
    """Plain iteration that keeps the changes."""

    def begin(self):
        self.changes = []

    def next(self, guess, found):
        self.changes.append(float((found - guess)[0]))
        return super().next(guess, found)


@pytest.mark.parametrize("materials, expected", [((WATER, STEEL), 0.3081), ((STEEL, WATER), 3.246)])
def test_the_contraction_is_that_of_the_two_materials(materials, expected):
    """Of the error, from one plain iteration to the next."""
    system, *_ = slabs(*materials)
    watched = Watched()
    scheme = iterated(watched, most_iterations=6)
    run(system, scheme, stop=STEP, macro_step=STEP, on_divergence="accept")
    # half a unit of the last digit given
    assert -watched.changes[2] / watched.changes[1] == pytest.approx(expected, rel=2e-4)


def test_steel_driven_by_its_temperature_needs_an_acceleration():
    def status(acceleration):
        system, *_ = slabs(STEEL, WATER)
        return run(system, iterated(acceleration), stop=10 * STEP, macro_step=STEP)

    failed = status(Relaxation())
    assert failed.status == "failed" and "has not converged" in failed.reason
    for acceleration in (Aitken(), QuasiNewton()):
        done = status(acceleration)
        assert done.status == "complete" and done.statistics.most_iterations <= 4


def test_the_slabs_are_where_one_solver_has_them():
    system, water, steel = slabs(WATER, STEEL)
    result = run(system, iterated(QuasiNewton()), stop=1000.0, macro_step=STEP)
    assert result["heated.T"][-1] == pytest.approx(484.77653186, abs=1e-6)
    assert stored(water) == pytest.approx(1.33291735e9, rel=1e-7)
    assert stored(steel) == pytest.approx(1.06778827e9, rel=1e-7)


class Friction(Restorable):
    """Power mu0 (1 - beta T) N v of a contact, which follows its temperature at once."""

    name, ports = "friction", port_table(inputs(T="K") + outputs(P="W"))

    def __init__(self, mu, beta, load, speed):
        self.mu, self.beta, self.strength, self.given = mu, beta, load * speed, 0.0

    def write(self, values):
        self.given = values["T"]

    def read(self):
        return {"P": self.mu * (1 - self.beta * self.given) * self.strength}


class Body(Restorable):
    """C T' = P - G T, solved exactly for a held power."""

    name, ports = "body", port_table(inputs(P="W") + outputs(T="K"))

    def __init__(self, capacity, loss):
        self.capacity, self.loss, self.t, self.given = capacity, loss, 0.0, 0.0

    def write(self, values):
        self.given = values["P"]

    def read(self):
        return {"T": self.t}

    def step(self, time, size):
        end = self.given / self.loss
        self.t = end + (self.t - end) * np.exp(-self.loss / self.capacity * size)


LOOP = {"capacity": 50.0, "loss": 2.0}
HOT = 0.4 * 500.0 * 3.0 / (2.0 + 0.4 * 0.02 * 500.0 * 3.0)  # 42.857 K


def friction_loop(beta=0.02):
    links = [Connection("friction.P", "body.P"), Connection("body.T", "friction.T")]
    return CoupledSystem([Friction(0.4, beta, 500.0, 3.0), Body(**LOOP)], links)


def test_the_friction_heat_loop_is_stable_below_its_border():
    """kappa = mu0 beta N v / G = 6: H < -(C/G) ln(1 - 2 / (1 + kappa)) = 8.4118 s."""
    border = -50.0 / 2.0 * log(1 - 2 / 7)
    assert border == pytest.approx(8.4118, abs=1e-4)
    for order in (("friction", "body"), ("body", "friction")):
        for macro_step, settles in ((0.99 * border, True), (1.01 * border, False)):
            result = run(
                friction_loop(), Jacobi(order), stop=200 * macro_step, macro_step=macro_step
            )
            away = np.abs(result["body.T"] - HOT)
            assert (away[150:].max() < away[50:100].max()) == settles


@pytest.mark.parametrize("acceleration", [Aitken(), QuasiNewton()], ids=["Aitken", "quasi-Newton"])
def test_a_feedback_that_diverges_explicitly_converges_iterated(acceleration):
    """kappa = 60, and steps as long as the body's own time: explicit steps run away."""

    def hot(scheme):
        return run(friction_loop(beta=0.2), scheme, stop=500.0, macro_step=25.0)

    end = 0.4 * 500.0 * 3.0 / (2.0 + 0.4 * 0.2 * 500.0 * 3.0)
    explicit = hot(GaussSeidel(("friction", "body")))
    assert abs(explicit["body.T"][-1]) > 1e6 * end
    implicit = hot(Iterated(("body", "friction"), "held", acceleration=acceleration))
    assert implicit.status == "complete"
    assert implicit["body.T"][-1] == pytest.approx(end, rel=1e-6)
    assert implicit.statistics.most_iterations <= 4
