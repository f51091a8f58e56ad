"""Friction that feels its own heat so strongly that explicit coupling goes astray.

160 kg on a disc of ice of 8 cm (312 kPa) at 3 m/s in air of -20 degC, friction that of ice on rock:
0.52 at -20 degC, 0.02 at melting (McCarthy et al., 2017). A kelvin takes 118 W from the friction
power, and a watt warms the interface, within a macro step of 0.1 s, by more than a hundredth of a
kelvin: what comes back is larger than what went out. Explicitly the interface jumps between -8 degC
and melting, and a gram of ice melts which in truth stays frozen, 2 K below melting.
"""

import numpy as np
import pytest
from heated_block import ON_A_LINE, ORDER, ROCK, coupled

from cosim import read_scenario
from cosim.coupling import Aitken, GaussSeidel, Iterated, QuasiNewton, Tolerance

STOP, MACRO_STEP = 4.0, 0.1
#: Of the temperature 1e-4 K + 1e-4 |T|: a thousandth of what the step itself is off by.
TOLERANCE = Tolerance(1e-4)
HEAVY = {
    "rig.mass": 160.0, "springs.stiffness": 6000.0, "structural_damping.coefficient": 2000.0,
    "surface.run_up_time": 2.0,
}  # fmt: skip
CASE = read_scenario("meltwater").changed(ROCK | ON_A_LINE | HEAVY)


def slide(scheme, macro_step=MACRO_STEP):
    return coupled(CASE, scheme, stop=STOP, macro_step=macro_step)


def iterated(acceleration):
    return Iterated(ORDER, "held", acceleration=acceleration, tolerance=TOLERANCE)


def interface(result):
    """At the multiples of the macro step after the run-up, degC."""
    times = np.arange(2.0, STOP + 0.5 * MACRO_STEP, MACRO_STEP)
    return np.interp(times, result.time, result["thermal.interface_temperature"])


@pytest.fixture(scope="module")
def resolved():
    """A tenth of the step, where the explicit scheme, too, is stable."""
    return slide(GaussSeidel(ORDER), 0.01)


@pytest.mark.parametrize("extrapolation", ["held", "linear"])
def test_explicit_coupling_melts_ice_that_does_not(resolved, extrapolation):
    result = slide(GaussSeidel(ORDER, extrapolation))
    assert resolved["thermal.melted_mass"][-1] == 0.0
    assert np.ptp(interface(result)) > 5.0 * np.ptp(interface(resolved))
    assert result["thermal.melted_mass"][-1] > 5e-4  # kg


@pytest.mark.parametrize("acceleration", [QuasiNewton(), Aitken()], ids=["quasi-Newton", "Aitken"])
def test_four_iterations_do(resolved, acceleration):
    result = slide(iterated(acceleration))
    assert result.status == "complete", result.reason
    assert result.statistics.most_iterations <= 4
    assert result["thermal.melted_mass"][-1] == 0.0
    # heat crosses once a step, first order: a hundredth of the 18 K of warming
    assert np.abs(interface(result) - interface(resolved)).max() < 0.2  # K
    assert abs(result.ledger.residual[-1]) < 1e-9 * result["mechanics.heat"][-1]
