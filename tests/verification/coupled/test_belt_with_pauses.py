"""A belt that runs, stands for minutes, and runs again on melting ice: adaptive steps and fixed.

A drive written in Python gives the speed: half a second up to 3 m/s, a second there, half a second
down, a pause; twice. Its kinks are known, and are communication points of all runs. Compared are
the temperature of the interface and the melted mass at the kinks. Water comes and goes, the ice
melts and refreezes, and hardly anything happens for most of the time.
"""

import numpy as np
import pytest
from heated_block import ON_A_LINE, ORDER, coupled
from part import Restorable

from cosim import coupling, read_scenario
from cosim.coupling import outputs, port_table

RAMP, RUN, PAUSE, SPEED = 0.5, 1.0, 180.0, 3.0  # s, s, s, m/s
LENGTHS = 2 * (RAMP, RUN, RAMP, PAUSE)
KINKS = np.concatenate([[0.0], np.cumsum(LENGTHS)])
SPEEDS = np.array([0.0, *(2 * (SPEED, SPEED, 0.0, 0.0))])
#: With these fixed steps the temperature is off by no less than with the adaptive ones.
FIXED_STEP = 0.08
STILL = {"surface.speed": 0.0, "surface.run_up_time": 0.0, "belt.length": 1.0}
CASE = read_scenario("meltwater").changed(ON_A_LINE | STILL)


class Drive(Restorable):
    """Speed of the belt by straight pieces."""

    name, ports = "drive", port_table(outputs(speed="m/s"))

    def enter_initialisation(self, start, stop):
        self.time = start

    def read(self):
        return {"speed": float(np.interp(self.time, KINKS, SPEEDS))}

    def step(self, time, size):
        self.time = time + size


def belt(**how):
    result = coupled(
        CASE, coupling.GaussSeidel(("drive", *ORDER), "linear"), Drive(),
        links=[coupling.Connection("drive.speed", "mechanics.surface_speed")],
        stop=float(KINKS[-1]), events=KINKS[1:-1].tolist(), **how,
    )  # fmt: skip
    assert result.status == "complete", result.reason
    return result


def adaptive(tolerance):
    estimate = coupling.Doubling(coupling.Tolerance(tolerance))
    return belt(control=coupling.AdaptiveStep(estimate, 0.01, 1e-4, PAUSE))


def errors(result, reference):
    """Largest ones at the kinks: of the interface, K; of the melted mass, part of the end's."""
    found, both = [], (result, reference)
    for port in ("thermal.interface_temperature", "thermal.melted_mass"):
        values, exact = (each[port][np.searchsorted(each.time, KINKS - 1e-9)] for each in both)
        found.append(float(np.abs(values - exact).max()))
    return found[0], found[1] / reference["thermal.melted_mass"][-1]


def steps_made(result):
    """Of the heat model: those taken back and made again count."""
    return result.statistics.participants["thermal"].steps


@pytest.mark.slow
def test_adaptive_steps_are_a_fifth_of_fixed_ones_at_equal_error():
    """Counted with those that doubling and rejection repeat, there are 7 times fewer, without 22.

    Both errors are no larger than those of the fixed steps, which are chosen so that they stay so:
    where rounding makes an adaptive step stand or be repeated, its error changes, even twofold.
    The reference has a third of the tolerance; by fixed steps of 5 ms the errors are of one size.
    """
    reference, chosen, fixed = adaptive(1e-3), adaptive(3e-3), belt(macro_step=FIXED_STEP)
    for adapted, plain in zip(errors(chosen, reference), errors(fixed, reference), strict=True):
        assert adapted <= plain
    assert 5 * steps_made(chosen) <= steps_made(fixed)
