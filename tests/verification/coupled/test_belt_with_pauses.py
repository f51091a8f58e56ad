"""A belt that runs, stands for minutes, and runs again on melting ice: adaptive steps and fixed.

A drive written in Python gives the speed: half a second up to 3 m/s, a second there, half a second
down, a pause; twice. Its kinks are known, and are communication points of all runs. Compared are
the temperature of the interface and the melted mass at the kinks. Water comes and goes, the ice
melts and refreezes, and hardly anything happens for most of the time.
"""

import numpy as np
import pytest
from part import Restorable

from cosim import read_scenario
from cosim.coupling import (
    AdaptiveStep,
    Connection,
    CoupledSystem,
    Doubling,
    FmuParticipant,
    GaussSeidel,
    Tolerance,
    outputs,
    port_table,
    run,
)
from cosim.coupling.case import CONNECTIONS, MECHANICS, RESIDUALS, THERMAL
from cosim.coupling.case.thermal_participant import ThermalParticipant
from cosim.fmu.build import own_fmu
from thermal import BeltIceModel

ORDER = ("drive", MECHANICS, THERMAL)
RAMP, RUN, PAUSE, SPEED = 0.5, 1.0, 180.0, 3.0  # s, s, s, m/s
LENGTHS = 2 * (RAMP, RUN, RAMP, PAUSE)
KINKS = np.concatenate([[0.0], np.cumsum(LENGTHS)])
SPEEDS = np.array([0.0, *(2 * (SPEED, SPEED, 0.0, 0.0))])
#: With these fixed steps the temperature is off by no less than with the adaptive ones.
FIXED_STEP = 0.08
CASE = read_scenario("meltwater").changed(
    {
        "rig.degrees_of_freedom": ("x",),
        "initial.y": 0.0,
        "initial.phi": 0.0,
        "surface.speed": 0.0,
        "surface.run_up_time": 0.0,
        "belt.length": 1.0,
        "belt.cell_length": 4e-3,
        "ice.radial_elements": 3,
        "ice.axial_elements": 6,
    }
)


class Drive(Restorable):
    """Speed of the belt by straight pieces."""

    name, ports = "drive", port_table(outputs(speed="m/s"))

    def enter_initialisation(self, start, stop):
        self.time = start

    def read(self):
        return {"speed": float(np.interp(self.time, KINKS, SPEEDS))}

    def step(self, time, size):
        self.time = time + size


def belt(macro_step=None, control=None):
    mechanics = FmuParticipant(own_fmu(), MECHANICS, parameters=CASE.mechanics.flat())
    heat = ThermalParticipant(BeltIceModel(CASE.thermal), THERMAL)
    links = [*CONNECTIONS, Connection("drive.speed", f"{MECHANICS}.surface_speed")]
    with CoupledSystem([Drive(), mechanics, heat], links, RESIDUALS) as system:
        result = run(
            system,
            GaussSeidel(ORDER, "linear"),
            stop=float(KINKS[-1]),
            macro_step=macro_step,
            control=control,
            events=KINKS[1:-1].tolist(),
        )
    assert result.status == "complete", result.reason
    return result


def adaptive(tolerance):
    return belt(control=AdaptiveStep(Doubling(Tolerance(tolerance)), 0.01, 1e-4, PAUSE))


def errors(result, reference):
    """Largest ones at the kinks: of the interface, K; of the melted mass, part of the end's."""
    found, both = [], (result, reference)
    for port in ("thermal.interface_temperature", "thermal.melted_mass"):
        values, exact = (each[port][np.searchsorted(each.time, KINKS - 1e-9)] for each in both)
        found.append(float(np.abs(values - exact).max()))
    return found[0], found[1] / reference["thermal.melted_mass"][-1]


def steps_made(result):
    """Of the heat model: those taken back and made again count."""
    return result.statistics.participants[THERMAL].steps


@pytest.mark.slow
def test_adaptive_steps_are_a_fifth_of_fixed_ones_at_equal_error():
    """Counted with those that doubling and rejection repeat, there are 7 times fewer, without 22.

    Both errors are no larger than those of the fixed steps, which are chosen so that they stay so:
    where rounding makes an adaptive step stand or be repeated, its error changes, even twofold.
    The reference has a third of the tolerance; by fixed steps of 5 ms the errors are of one size.
    """
    reference, chosen, fixed = adaptive(1e-3), adaptive(3e-3), belt(FIXED_STEP)
    for adapted, plain in zip(errors(chosen, reference), errors(fixed, reference), strict=True):
        assert adapted <= plain
    assert 5 * steps_made(chosen) <= steps_made(fixed)
