"""Two coupled oscillators (the preCICE oscillator) split between two participants.

m = 1, k1 = k2 = 4 pi^2, k12 = 16 pi^2, x1(0) = 1, the rest 0:

    x_i'' = -(k_i + k12) x_i + k12 x_j,   x_1,2(t) = (cos 2 pi t +- cos 6 pi t) / 2.

Each participant solves its own side exactly for an input held over the step, so that what is
measured is the coupling scheme alone. The expected errors were computed with an independent
program from the same closed forms.
"""

from math import cos, pi, sin, sqrt

import numpy as np
import pytest

from cosim.coupling import Connection, CoupledSystem, GaussSeidel, inputs, outputs, port_table, run

OWN_STIFFNESS, COUPLING_STIFFNESS = 4 * pi**2, 16 * pi**2
OMEGA = sqrt(OWN_STIFFNESS + COUPLING_STIFFNESS)

# Largest |x - x_exact| over 0 <= t <= 1 of Gauss-Seidel with held inputs.
EXPECTED_ERROR = {0.01: 0.1042, 0.005: 0.05223}


class Oscillator:
    """x'' = -omega^2 x + k12 other, solved exactly for `other` held over the step."""

    def __init__(self, name, displacement):
        self.name = name
        self.ports = port_table(inputs(other="m") + outputs(x="m", v="m/s"))
        self.x, self.v, self.other = displacement, 0.0, 0.0

    def enter_initialisation(self, start, stop):
        pass

    def exit_initialisation(self):
        pass

    def write(self, values):
        self.other = values["other"]

    def read(self):
        return {"x": self.x, "v": self.v}

    def step(self, time, size):
        rest = COUPLING_STIFFNESS * self.other / OMEGA**2
        c, s, x, v = cos(OMEGA * size), sin(OMEGA * size), self.x - rest, self.v
        self.x, self.v = rest + c * x + s / OMEGA * v, -OMEGA * s * x + c * v

    def close(self):
        pass


def oscillate(macro_step):
    pair = CoupledSystem(
        [Oscillator("first", 1.0), Oscillator("second", 0.0)],
        [Connection("first.x", "second.other"), Connection("second.x", "first.other")],
    )
    return run(pair, GaussSeidel(("first", "second")), stop=1.0, macro_step=macro_step)


def largest_error(result):
    slow, fast = np.cos(2 * pi * result.time), np.cos(6 * pi * result.time)
    first = np.abs(result["first.x"] - (slow + fast) / 2)
    second = np.abs(result["second.x"] - (slow - fast) / 2)
    return max(first.max(), second.max())


@pytest.mark.parametrize("macro_step", EXPECTED_ERROR)
def test_error_is_that_of_the_scheme(macro_step):
    assert largest_error(oscillate(macro_step)) == pytest.approx(
        EXPECTED_ERROR[macro_step], rel=5e-4
    )


def test_gauss_seidel_with_held_inputs_is_of_first_order():
    steps = np.array([0.01, 0.005, 0.0025, 0.00125])
    errors = [largest_error(oscillate(h)) for h in steps]
    order = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert order == pytest.approx(1.0, abs=0.02)


def test_a_shorter_last_step_ends_at_the_same_time():
    assert oscillate(0.0095).time[-1] == 1.0


def test_gauss_seidel_keeps_the_energy_at_the_communication_points():
    """With Jacobi and held inputs it doubles in the same second."""
    result = oscillate(0.01)
    x1, x2 = result["first.x"], result["second.x"]
    energy = (
        result["first.v"] ** 2
        + result["second.v"] ** 2
        + OWN_STIFFNESS * (x1**2 + x2**2)
        + COUPLING_STIFFNESS * (x1 - x2) ** 2
    ) / 2
    np.testing.assert_allclose(energy, energy[0], rtol=1e-13)
