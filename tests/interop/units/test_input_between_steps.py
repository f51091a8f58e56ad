"""Inputs that a host gives step by step: the motion converges to that under the same drive inside.

The surface's speed is a sine of the size of a ripple. Inside, it is the effect `speed_ripple`; from
outside it comes in steps of h: held, going on as between the last two values, or with its rate.
What decides when a stick ends is the surface's acceleration, which is right to the order h in all
three, so the order of the motion is 1 in all; with a rate its error is several times smaller.
"""

import ctypes
import math

import fmpy
import numpy as np
import pytest
from fmpy.fmi2 import FMU2Slave
from test_fmpy import instance

AMPLITUDE, FREQUENCY, SPEED, STOP, SHOWN = 0.3, 1.0, 0.15, 8.0, 0.04
STEPS = (0.02, 0.01, 0.005, 0.0025, 0.00125)


class Block:
    """The unit on a belt whose speed is given from outside, or ripples by itself."""

    def __init__(self, fmu, folder):
        self.description = fmpy.read_model_description(fmu)
        self.folder = folder
        fmpy.extract(fmu, unzipdir=folder)
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}

    def motion(self, size, hold=0, with_rate=False, inside=False):
        """x every SHOWN seconds, the number of slips and the energy residual."""
        slave = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=str(self.folder),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
        )
        slave.instantiate()
        at = self.references
        if inside:
            names = [at["speed_ripple.amplitude"], at["speed_ripple.frequency"]]
            slave.setReal(names, [AMPLITUDE, FREQUENCY])
        slave.setInteger([at["input.hold"]], [hold])
        slave.setReal([at["surface_speed"]], [SPEED])
        slave.setupExperiment()
        slave.enterInitializationMode()
        slave.exitInitializationMode()
        x, each = [], round(SHOWN / size)
        for n in range(round(STOP / size)):
            turn = 2.0 * math.pi * FREQUENCY * n * size
            if not inside:
                slave.setReal([at["surface_speed"]], [SPEED * (1 + AMPLITUDE * math.sin(turn))])
            if with_rate:
                rate = SPEED * AMPLITUDE * 2.0 * math.pi * FREQUENCY * math.cos(turn)
                slave.setRealInputDerivatives([at["surface_speed"]], [1], [rate])
            slave.doStep(n * size, size)
            if (n + 1) % each == 0:
                x += slave.getReal([at["x"]])
        (slips,) = slave.getInteger([at["slip_count"]])
        (residual,) = slave.getReal([at["energy_residual"]])
        slave.terminate()
        slave.freeInstance()
        return np.array(x), slips, residual


@pytest.fixture(scope="module")
def block(fmu, tmp_path_factory):
    return Block(fmu, tmp_path_factory.mktemp("drive"))


@pytest.fixture(scope="module")
def exact(block):
    return block.motion(SHOWN, inside=True)


@pytest.mark.parametrize(
    ("given", "finest"),
    [({"hold": 0}, 6e-5), ({"hold": 1}, 1e-5), ({"with_rate": True}, 1e-5)],
)
def test_the_motion_converges_to_that_of_the_ripple_inside(block, exact, given, finest):
    errors = []
    for size in STEPS:
        x, slips, residual = block.motion(size, **given)
        errors.append(np.abs(x - exact[0]).max())
        assert abs(residual) < 1e-11
        if size <= 0.01:
            assert slips == exact[1]
    order = np.polyfit(np.log(STEPS), np.log(errors), 1)[0]
    # The error of an event is that of where it falls between two steps: the order scatters.
    assert 0.8 < order < 1.8
    assert errors[-1] < finest


def test_a_derivative_of_another_order_is_refused(block):
    slave = FMU2Slave(
        guid=block.description.guid,
        unzipDirectory=str(block.folder),
        modelIdentifier=block.description.coSimulation.modelIdentifier,
    )
    slave.instantiate()
    with pytest.raises(fmpy.fmi1.FMICallException):
        slave.setRealInputDerivatives([block.references["surface_speed"]], [2], [0.0])
    slave.freeInstance()


@pytest.mark.parametrize("hold", [0, 1])
def test_the_unit_in_python_takes_them_the_same_way(block, python_fmu, tmp_path, hold):
    x, slips, _ = block.motion(0.02, hold=hold)
    again, slips_again, _ = Block(python_fmu, tmp_path).motion(0.02, hold=hold)
    assert slips == slips_again
    np.testing.assert_array_equal(x, again)


def test_outputs_have_first_derivatives(fmu, tmp_path):
    """For who interpolates them between the steps: exact of what the model integrates."""
    with instance(fmu, tmp_path) as block:
        block.initialise(surface_speed=SPEED, **{"lateral_friction.ratio": 1.0, "initial.y": 0.01})
        block.march(0, 300, 0.01)
        at = {name: each.valueReference for name, each in block.variables.items()}

        def rate(name, order=1):
            value = ctypes.c_double()
            block.slave.fmi2GetRealOutputDerivatives(
                block.slave.component,
                ctypes.byref(ctypes.c_uint(at[name])),
                1,
                ctypes.byref(ctypes.c_int(order)),
                ctypes.byref(value),
            )
            return value.value

        for place, velocity in (("x", "vx"), ("y", "vy"), ("phi", "omega")):
            assert rate(place) == block.get(velocity)
        assert rate("surface_travel") == pytest.approx(SPEED)
        power = block.get("friction_force_x") * (SPEED - block.get("vx"))
        power -= block.get("friction_force_y") * block.get("vy")
        power -= block.get("friction_moment") * block.get("omega")
        assert rate("heat") == pytest.approx(power, rel=1e-9)
        with pytest.raises(fmpy.fmi1.FMICallException):
            rate("x", order=2)
