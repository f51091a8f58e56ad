"""The two coupled oscillators of preCICE's partitioned tutorials, split between two participants.

m = 1, k1 = k2 = 4 pi^2, k12 = 16 pi^2, x1(0) = 1, the rest 0:

    x_i'' = -(k_i + k12) x_i + k12 x_j,   x_1,2(t) = (cos 2 pi t +- cos 6 pi t) / 2.

Each participant solves its own side exactly, so that what is measured is the coupling scheme alone.
The expected errors were computed with an independent program from the same closed forms.
"""

from math import pi

import numpy as np
import pytest
from linear_participant import Linear

from cosim import coupling
from cosim.coupling import GaussSeidel, Iterated, Jacobi, Tolerance, run

OWN, BETWEEN = 4 * pi**2, 16 * pi**2
ORDER = ("first", "second")
# far below the schemes' errors
TIGHT = Tolerance(1e-12)

# Largest |x - x_exact| over 0 <= t <= 1 with H = 0.01 and 0.005 s, and the drift of the energy with
# 0.01; to the digits that were given.
EXPECTED = {
    "Jacobi, held": (Jacobi(ORDER), 0.4040, 0.1986, 1.02),
    "Gauss-Seidel, held": (GaussSeidel(ORDER), 0.1042, 0.05223, 0.0),
    "Jacobi, linear": (Jacobi(ORDER, "linear"), 0.03340, 0.008303, 0.0212),
    "Gauss-Seidel, linear": (GaussSeidel(ORDER, "linear"), 0.01540, 0.003889, 0.0097),
    "iterated, end value": (Iterated(ORDER, "held", tolerance=TIGHT), 0.4056, 0.1987, 0.369),
    "iterated, linear": (Iterated(ORDER, "linear", tolerance=TIGHT), 0.006596, 0.001657, 0.00115),
}


def oscillate(scheme, macro_step=None, control=None, stop=1.0):
    def side(name, displacement):
        return Linear(
            name, [[0, 1], [-(OWN + BETWEEN), 0]], [[0], [BETWEEN]], np.eye(2), ins={"other": "m"},
            outs={"x": "m", "v": "m/s"}, x=[displacement, 0.0],
        )  # fmt: skip

    pair = coupling.CoupledSystem(
        [side("first", 1.0), side("second", 0.0)],
        [coupling.Connection("first.x", "second.other"),
         coupling.Connection("second.x", "first.other")],
    )  # fmt: skip
    result = run(pair, scheme, stop=stop, macro_step=macro_step, control=control)
    assert result.status == "complete", result.reason
    return result


def largest_error(result):
    slow, fast = np.cos(2 * pi * result.time), np.cos(6 * pi * result.time)
    first = np.abs(result["first.x"] - (slow + fast) / 2)
    second = np.abs(result["second.x"] - (slow - fast) / 2)
    return max(first.max(), second.max())


def drift(result):
    x1, x2 = result["first.x"], result["second.x"]
    twice = result["first.v"] ** 2 + result["second.v"] ** 2 + OWN * (x1**2 + x2**2)
    energy = (twice + BETWEEN * (x1 - x2) ** 2) / 2
    return np.abs(energy / energy[0] - 1).max()


@pytest.mark.parametrize("name", EXPECTED)
def test_error_and_energy_are_those_of_the_scheme(name):
    scheme, coarse, fine, lost = EXPECTED[name]
    result = oscillate(scheme, 0.01)
    # half a unit of the fourth digit given
    assert largest_error(result) == pytest.approx(coarse, rel=5e-4)
    assert largest_error(oscillate(scheme, 0.005)) == pytest.approx(fine, rel=5e-4)
    # Gauss-Seidel with held inputs is symplectic: what is left is rounding over 100 steps
    assert drift(result) == pytest.approx(lost, rel=5e-3, abs=1e-13)


@pytest.mark.parametrize("degree, waveform", [(0, "held"), (1, "linear"), (2, "quadratic")])
@pytest.mark.parametrize("make", [Jacobi, GaussSeidel, Iterated])
def test_the_order_is_one_more_than_the_polynomial_s_degree(make, degree, waveform):
    steps = np.array([0.005, 0.0025, 0.00125])
    errors = [largest_error(oscillate(make(ORDER, waveform), h)) for h in steps]
    order = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert order == pytest.approx(make(ORDER, waveform).accuracy, abs=0.04)
    assert make(ORDER, waveform).accuracy == degree + 1


@pytest.mark.parametrize("estimate, power", [(coupling.Defect, 1.0), (coupling.Doubling, 0.5)])
def test_an_adaptive_step_follows_its_tolerance(estimate, power):
    """Second order: the error over the run goes with H^2, the inputs' defect too, and the error of
    one step in x, which is integrated twice from an input, with H^4."""

    def error(relative):
        control = coupling.AdaptiveStep(estimate(Tolerance(relative)), 1e-3, 1e-6, 0.1)
        return largest_error(oscillate(GaussSeidel(ORDER, "linear"), control=control))

    found = np.log(error(1e-3) / error(1e-5)) / np.log(100.0)
    assert found == pytest.approx(power, abs=0.1)
