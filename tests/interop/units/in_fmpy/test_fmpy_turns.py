"""Calls out of turn in fmpy, and calls for what there is not: each is an error with its reason."""

import math

import pytest
from fmpy_instance import instance, refused


@pytest.mark.parametrize(
    ("call", "arguments", "says"),
    [
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
    ],
)
def test_a_call_that_makes_no_sense_is_refused(block, call, arguments, says):
    block.initialise()
    block.march(0, 10, 0.01)
    state = block.slave.getFMUState()
    said = block.refuses(getattr(block.slave, call), *arguments)
    assert said.endswith(says) and "\n" not in said
    if not call.startswith("get"):  # to have asked harms nothing
        refused(block.slave.doStep, 0.1, 0.01)
        assert "failed before" in block.log.take_errors()
        block.slave.setFMUState(state)
    block.slave.doStep(0.1, 0.01)
    block.slave.freeFMUState(state)


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
