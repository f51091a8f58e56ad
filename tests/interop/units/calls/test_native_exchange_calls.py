"""What the native unit takes and refuses in model exchange, call by call, as a host in C does."""

import math
from ctypes import byref, c_double, c_int, c_uint

import fmpy
import pytest
from native_unit import MODEL_EXCHANGE, EventInfo

NAN, INF = math.nan, math.inf


@pytest.fixture(scope="module")
def counts(fmu):
    """How many states and indicators the description says there are."""
    description = fmpy.read_model_description(fmu)
    if description.modelExchange is None:
        pytest.skip("the unit is for co-simulation alone")
    return description.numberOfContinuousStates, description.numberOfEventIndicators


@pytest.fixture
def continuous(unit, counts):
    """An instance in continuous-time mode."""
    with unit.instance(kind=MODEL_EXCHANGE) as one:
        one.begin()
        one.done("NewDiscreteStates", byref(EventInfo()))
        one.done("EnterContinuousTimeMode")
        yield one


@pytest.mark.parametrize("by", [-1, 1])
@pytest.mark.parametrize(
    ("function", "which"),
    [
        ("SetContinuousStates", 0),
        ("GetContinuousStates", 0),
        ("GetDerivatives", 0),
        ("GetNominalsOfContinuousStates", 0),
        ("GetEventIndicators", 1),
    ],
)
def test_a_wrong_number_of_numbers_is_refused(continuous, counts, function, which, by):
    wrong = counts[which] + by
    said = continuous.reason(function, (c_double * wrong)(), wrong)
    assert f"{wrong} numbers asked for, there are {counts[which]}" in said


@pytest.mark.parametrize(
    ("function", "arguments"),
    [
        ("SetContinuousStates", (None, 20)),
        ("GetDerivatives", (None, 20)),
        ("NewDiscreteStates", (None,)),
        ("CompletedIntegratorStep", (1, None, None)),
        ("SetTime", (NAN,)),
        ("SetTime", (INF,)),
        ("SetRealInputDerivatives", (byref(c_uint(0)), 1, byref(c_int(1)), byref(c_double(1.0)))),
    ],
)
def test_a_refused_call_is_an_error(continuous, function, arguments):
    assert continuous.reason(function, *arguments)
    assert "has failed before" in continuous.reason("EnterEventMode")
    continuous.done("Reset")
    continuous.begin()


@pytest.mark.parametrize("seed", [NAN, INF])
def test_a_direction_that_is_no_number_is_refused(continuous, seed):
    vx, out = byref(c_uint(continuous.unit.references["vx"])), c_double()
    said = continuous.reason(
        "GetDirectionalDerivative", vx, 1, vx, 1, byref(c_double(seed)), byref(out)
    )
    assert f"the direction along vx is {seed:g}; must be a finite number" in said


def test_along_next_to_nothing_nothing_changes(continuous):
    """A seed so small that a difference along it would be beyond all numbers."""
    force, vx = (
        byref(c_uint(continuous.unit.references[name])) for name in ("friction_force_x", "vx")
    )
    out = c_double(NAN)
    seed = byref(c_double(1e-320))
    continuous.done("GetDirectionalDerivative", force, 1, vx, 1, seed, byref(out))
    assert abs(out.value) <= 1e-320


def test_states_that_are_no_numbers_do_not_pass_an_integrator_s_step(continuous, counts):
    states = (c_double * counts[0])(*[NAN] * counts[0])
    continuous.done("SetContinuousStates", states, counts[0])
    event, end = c_int(), c_int()
    said = continuous.reason("CompletedIntegratorStep", 1, byref(event), byref(end))
    assert "not a finite number" in said
