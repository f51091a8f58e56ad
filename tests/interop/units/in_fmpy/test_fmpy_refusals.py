"""What the units refuse in fmpy: numbers, calls for what there is not, and calls out of turn.

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
from fmpy_instance import instance, refused


@pytest.mark.parametrize("time, size, message", [
    (0.5, -0.01, "step size is -0.01 s; must be greater than 0"),
    (0.5, 0.0, "step size is 0 s"),
    (0.5, 1e-17, "step size is 1e-17 s, lost in the rounding of the time"),
    (0.5, 1e4, "step size is 10000 s; must be at most 1000 s, as a step cannot be interrupted"),
    (0.5, math.nan, "of size nan: must be finite"),
    (math.inf, 0.01, "from t = inf"),
    (0.4, 0.01, "begins at t = 0.4 s, the last one ended at t = 0.5 s"),
    (0.6, 0.01, "begins at t = 0.6 s"),
])  # fmt: skip
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


#: Calls of a unit in its run, by their names or by those of variables, and why they are refused.
SENSELESS = [
    ("enterInitializationMode", (), "not allowed while the instance is stepping"),
    ("exitInitializationMode", (), "not allowed while the instance is stepping"),
    ("setupExperiment", (), "not allowed while the instance is stepping"),
    ("getReal", ([4711],), "value reference 4711: there is no such variable"),
    ("getReal", ([2**32 - 1],), "value reference 4294967295: there is no such variable"),
    ("setReal", ([4711], [1.0]), "value reference 4711: there is no such variable"),
    ("getInteger", ([0],), "surface_speed is a real number, not an integer"),
    ("getBoolean", ([0],), "surface_speed is a real number, not a Boolean"),
    ("setBoolean", ([0], [True]), "surface_speed is a real number, not a Boolean"),
    ("setInteger", ([0], [1]), "surface_speed is a real number, not an integer"),
    ("getString", ([0],), "fmi2GetString: no variable is a text"),
    ("setString", ([0], ["x"]), "fmi2SetString: no variable is a text"),
    ("set", ("surface_speed", math.nan), "surface_speed = nan: must be a finite number"),
    ("set", ("surface_speed", -math.inf), "surface_speed = -inf: must be a finite number"),
    ("set", ("interface_temperature", -300.0), "= -300: must lie in [-273.15, inf]"),
    ("set", ("rig.mass", 2.0), "rig.mass is fixed and cannot be set after initialisation"),
    ("set", ("x", 1.0), "x is an output and cannot be set"),
]


@pytest.mark.parametrize(("call", "arguments", "says"), SENSELESS)
def test_a_call_that_makes_no_sense_is_refused(block, call, arguments, says):
    block.initialise()
    block.march(0, 10, 0.01)
    state, before = block.slave.getFMUState(), block.everything()
    said = block.refuses(getattr(block, call, None) or getattr(block.slave, call), *arguments)
    assert said.endswith(says) and "\n" not in said
    assert block.everything() == before
    if not call.startswith("get"):  # to have asked harms nothing
        refused(block.slave.doStep, 0.1, 0.01)
        assert "failed before" in block.log.take_errors()
        block.slave.setFMUState(state)
    block.slave.doStep(0.1, 0.01)
    block.slave.freeFMUState(state)


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


@pytest.mark.parametrize(("name", "value", "allowed"), [
    ("rig.mass", 0.0, "must lie in (0, inf]"),
    ("rig.free_y", 2, "must lie in [0, 1]"),
    ("temperature_dependence.reference_degC", -1e308, "must lie in [-273.15, 0]"),
    ("friction.table_temperature_degC[2]", -1e308, "must lie in [-273.15, 1000]"),
    ("rig.attachment_angles_deg[1]", 1e308, "must lie in [-360, 360]"),
    # squares and quotients of it would be infinite
    ("rig.mass", 1e308, "must be 0, or of a size from 1e-100 to 1e+100"),
    ("rig.mass", 5e-324, "must be 0, or of a size from 1e-100 to 1e+100"),
    ("initial.x", -1e308, "must be 0, or of a size from 1e-100 to 1e+100"),
])  # fmt: skip
def test_a_parameter_out_of_range_is_refused(block, name, value, allowed):
    said = block.refuses(block.initialise, **{name: value})
    assert said.partition("; ")[0] == f"{name} = {value:g}: {allowed}"


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


# --- calls out of turn ---


def test_an_input_just_below_its_bound_is_at_it(unit, tmp_path):
    """A host that takes differences about 0 asks for a film that is thinner than none."""
    with instance(unit, tmp_path) as block:
        block.initialise(film_thickness=-1e-8)
        assert block.get("film_thickness") == 0.0


def test_the_experiment_is_set_up_once_and_makes_sense(block):
    block.slave.setupExperiment()
    said = block.refuses(block.slave.setupExperiment)
    assert said == "the experiment has been set up before"
    for arguments, says in (
        ({"startTime": math.nan}, "start time is nan; must be a finite number of seconds"),
        ({"startTime": 5.0, "stopTime": 4.0}, "stop time is 4 s; must not be before the start"),
        ({"tolerance": -1.0}, "tolerance is -1; must be a finite number of at least 0"),
    ):
        block.slave.reset()
        assert block.refuses(block.slave.setupExperiment, **arguments).startswith(says)


def test_no_step_goes_past_the_stop_time(block):
    block.slave.setupExperiment(stopTime=0.3)
    block.slave.enterInitializationMode()
    block.slave.exitInitializationMode()
    block.march(0, 3, 0.1)  # 0.2 + 0.1 is more than 0.3, by rounding
    state = block.slave.getFMUState()
    for _ in range(2):
        said = block.refuses(block.slave.doStep, 0.3, 1e-3)
        assert said == "step to t = 0.301 s goes past the stop time that was set up, 0.3 s"
        block.slave.setFMUState(state)
    block.slave.freeFMUState(state)


def test_no_step_after_the_end_and_none_before_the_beginning(block):
    refused(block.slave.doStep, 0.0, 0.01)
    said = block.log.take_errors()
    assert said == "fmi2DoStep: not allowed while the instance is instantiated"
    block.slave.reset()
    block.initialise()
    block.slave.terminate()
    assert block.get("x") == 0.0
    refused(block.slave.doStep, 0.0, 0.01)
    said = block.log.take_errors()
    assert said == "fmi2DoStep: not allowed while the instance is terminated"


def test_an_output_is_there_from_the_initialisation_on(block):
    said = block.refuses(block.get, "x")
    assert said == "fmi2GetReal: not allowed while the instance is instantiated"
