"""Friction that feels the heat it makes: where one pass is stable, and what an iteration mends.

A contact whose power falls with its temperature, and a body that the power warms; both are known in
closed form.
"""

from math import log

import numpy as np
import pytest
from part import Restorable

from cosim import coupling
from cosim.coupling import Connection, CoupledSystem, GaussSeidel, Iterated, Jacobi, run


class Friction(Restorable):
    """Power mu0 (1 - beta T) N v of a contact, which follows its temperature at once."""

    name, ports = "friction", coupling.port_table(coupling.inputs(T="K") + coupling.outputs(P="W"))

    def __init__(self, mu, beta, load, speed):
        self.mu, self.beta, self.strength, self.given = mu, beta, load * speed, 0.0

    def write(self, values):
        self.given = values["T"]

    def read(self):
        return {"P": self.mu * (1 - self.beta * self.given) * self.strength}


class Body(Restorable):
    """C T' = P - G T, solved exactly for a held power."""

    name, ports = "body", coupling.port_table(coupling.inputs(P="W") + coupling.outputs(T="K"))

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


@pytest.mark.parametrize(
    "acceleration", [coupling.Aitken(), coupling.QuasiNewton()], ids=["Aitken", "quasi-Newton"]
)
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
