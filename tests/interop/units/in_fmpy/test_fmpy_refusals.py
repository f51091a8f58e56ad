"""What the units refuse in fmpy.

fmi2Error with a message, the process lives on, a state or a reset recovers.
"""

import math
import os
import signal
import sys
import threading
import time
import traceback

import pytest
from fmpy_instance import refused


@pytest.mark.parametrize(
    "time, size, message",
    [
        (0.5, -0.01, "step size is -0.01 s; must be greater than 0"),
        (0.5, 0.0, "step size is 0 s"),
        (0.5, 1e-17, "step size is 1e-17 s, lost in the rounding of the time"),
        (0.5, 1e4, "step size is 10000 s; must be at most 1000 s, as a step cannot be interrupted"),
        (0.5, math.nan, "of size nan: must be finite"),
        (math.inf, 0.01, "from t = inf"),
        (0.4, 0.01, "begins at t = 0.4 s, the last one ended at t = 0.5 s"),
        (0.6, 0.01, "begins at t = 0.6 s"),
    ],
)
def test_a_step_that_cannot_be_is_an_error(block, time, size, message):
    block.initialise()
    block.march(0, 50, 0.01)
    state, x = block.slave.getFMUState(), block.get("x")
    refused(block.slave.doStep, time, size)
    assert message in block.log.take_errors()
    assert block.get("x") == x
    refused(block.slave.doStep, 0.5, 0.01)
    assert "failed before" in block.log.take_errors()
    block.slave.setFMUState(state)
    block.slave.doStep(0.5, 0.01)
    assert block.log.take_errors() == ""
    block.slave.freeFMUState(state)


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        *(
            ("surface_speed", value, f"surface_speed = {value}: must be a finite number")
            for value in (math.nan, math.inf, -math.inf)
        ),
        (
            "interface_temperature",
            -300.0,
            "interface_temperature = -300: must lie in [-273.15, inf]",
        ),
        ("rig.mass", 2.0, "rig.mass is fixed and cannot be set after initialisation"),
        ("x", 1.0, "x is an output and cannot be set"),
    ],
)
def test_what_cannot_be_set_in_the_run_is_refused(block, name, value, said):
    block.initialise()
    block.march(0, 10, 0.01)
    before = block.get(name)
    assert block.refuses(block.set, name, value) == said
    assert block.get(name) == before
    refused(block.slave.doStep, 0.1, 0.01)


def test_a_damaged_state_is_refused(block):
    block.initialise()
    whole = block.slave.serializeFMUState(block.slave.getFMUState())
    for damaged in (whole[: len(whole) // 2], b"{not a state"):
        said = block.refuses(
            lambda given=damaged: block.slave.setFMUState(block.slave.deserializeFMUState(given))
        )
        assert said == "the state is damaged, or was taken from another build of this unit"
        refused(block.slave.doStep, 0.0, 0.01)
        block.slave.reset()
        block.log.take_errors()
        block.initialise()


def test_what_initialisation_refuses_is_told_at_its_end_in_one_line(block):
    """And the instance is as alive as after any other error: it can be asked, reset and freed."""
    for _ in range(3):
        said = block.refuses(block.initialise, **{"rig.spring_natural_length": 1.0})
        assert said.startswith(
            "rig.spring_natural_length = 1 m is more than twice rig.spring_length = 0.2 m: "
        )
        assert said.endswith("allowed is at most twice the installed length")
        assert "\n" not in said
        block.get("rig.mass")
        block.slave.reset()
    block.initialise()
    block.march(0, 10, 0.01)
    assert block.log.take_errors() == ""


@pytest.mark.parametrize(
    ("name", "value", "range"),
    [
        ("rig.mass", 0.0, "(0, inf]"),
        ("rig.mass", -1.0, "(0, inf]"),
        ("rig.free_y", 2, "[0, 1]"),
        ("temperature_dependence.reference_degC", -1e308, "[-273.15, 0]"),
        ("friction.table_temperature_degC[2]", -1e308, "[-273.15, 1000]"),
        ("rig.attachment_angles_deg[1]", 1e308, "[-360, 360]"),
    ],
)
def test_a_parameter_out_of_range_is_refused(block, name, value, range):
    assert block.refuses(block.set, name, value) == f"{name} = {value:g}: must lie in {range}"


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("rig.mass", 1e308),
        ("rig.mass", 5e-324),
        ("initial.x", -1e308),
        ("surface_pattern.phase_deg", 1e308),
    ],
)
def test_what_nobody_can_compute_with_is_refused(block, name, value):
    """Squares and quotients of it would be infinite."""
    said = block.refuses(block.initialise, **{name: value})
    assert said == f"{name} = {value:g}: must be 0, or of a size from 1e-100 to 1e+100"


def test_ctrl_c_inside_a_step_is_an_error_and_the_state_is_that_before(python_block, ctrl_c):
    """In a Python host the signal arrives in the slave's own code; there it may not escape."""
    block = python_block
    block.initialise()
    block.march(0, 10, 0.01)
    x = block.get("x")
    host = threading.get_ident()

    def interrupt():
        """Once the host is in the slave: before, it would be the host's own."""
        while "do_step" not in {
            frame.f_code.co_name for frame, _ in traceback.walk_stack(sys._current_frames()[host])
        }:
            time.sleep(0.01)
        os.kill(os.getpid(), signal.SIGINT)

    threading.Thread(target=interrupt).start()
    refused(block.slave.doStep, 0.1, 1e3)
    assert "KeyboardInterrupt" in block.log.take_errors()
    assert block.get("x") == x
