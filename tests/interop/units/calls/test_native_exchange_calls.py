"""What the native unit takes and refuses in model exchange, call by call, as a host in C does."""

import math
from ctypes import byref, c_double, c_int, c_uint

import fmpy
import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    precondition,
    rule,
    run_state_machine_as_test,
)
from native_unit import ERROR, MODEL_EXCHANGE, OK, EventInfo, Unit
from phases import CONTINUOUS, ENDED, EVENT, EXCHANGE_2, FAILED, INITIALISING, NEW

NAN, INF = math.nan, math.inf
TAKEN = EXCHANGE_2.taken


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
        ("DoStep", (0.0, 0.01, 1)),
        ("SetRealInputDerivatives", (byref(c_uint(0)), 1, byref(c_int(1)), byref(c_double(1.0)))),
        ("EnterContinuousTimeMode", ()),
        ("EnterInitializationMode", ()),
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


def in_turn(function):
    """A rule for the phases that take a call; `out_of_turn` makes it in the others."""
    return precondition(lambda self: self.phase in TAKEN[function])


class Calls(RuleBasedStateMachine):
    """Calls in any order, beside what the standard says of each."""

    unit: Unit
    counts: tuple[int, int]

    def __init__(self):
        super().__init__()
        self.block = self.unit.instance(kind=MODEL_EXCHANGE)
        self.phase, self.has_experiment, self.time = NEW, False, 0.0
        self.states = (c_double * self.counts[0])()

    def teardown(self):
        self.block.free()

    def tries(self, function, *arguments, to=None):
        """Make a call; whether it was taken, which must be as the phase says."""
        self.block.messages.clear()
        expected = self.phase in TAKEN[function]
        status = self.block.call(function, *arguments)
        assert status == (OK if expected else ERROR), (self.phase, self.block.messages)
        assert [each[0] for each in self.block.messages] == ([] if expected else [ERROR])
        self.phase = (to or self.phase) if expected else FAILED
        return expected

    @in_turn("EnterInitializationMode")
    @rule()
    def enter(self):
        self.tries("EnterInitializationMode", to=INITIALISING)

    @in_turn("ExitInitializationMode")
    @rule()
    def exit(self):
        self.tries("ExitInitializationMode", to=EVENT)

    @precondition(lambda self: self.phase in {NEW, FAILED})
    @rule()
    def begin_anew(self):
        """All the way to the integration, which chance would seldom reach."""
        self.reset()
        for step in (self.enter, self.exit, self.update, self.go_on):
            step()

    @in_turn("EnterEventMode")
    @rule()
    def event(self):
        self.tries("EnterEventMode", to=EVENT)

    @in_turn("NewDiscreteStates")
    @rule()
    def update(self):
        told = EventInfo()
        if self.tries("NewDiscreteStates", byref(told)):
            assert not told.terminate and not told.new_discrete_states_needed
            if told.has_next:
                assert math.isfinite(told.next)

    @in_turn("EnterContinuousTimeMode")
    @rule()
    def go_on(self):
        self.tries("EnterContinuousTimeMode", to=CONTINUOUS)

    @in_turn("SetTime")
    @rule(size=st.sampled_from([0.0, 1e-4, 0.01, 0.3]))
    def advance_time(self, size):
        if self.tries("SetTime", self.time + size):
            self.time += size

    @in_turn("SetContinuousStates")
    @rule(share=st.sampled_from([0.0, 1e-4, 1e-3]), which=st.integers(0, 19))
    def move(self, share, which):
        """Somewhere near, not where the motion leads: a host's stages may be anywhere."""
        if not self.tries("GetContinuousStates", self.states, len(self.states)):
            return
        self.states[which % len(self.states)] += share
        self.tries("SetContinuousStates", self.states, len(self.states))

    @in_turn("GetDerivatives")
    @rule(function=st.sampled_from(["GetDerivatives", "GetNominalsOfContinuousStates"]))
    def look(self, function):
        numbers = (c_double * self.counts[0])()
        if self.tries(function, numbers, len(numbers)):
            assert all(map(math.isfinite, numbers))

    @in_turn("GetEventIndicators")
    @rule()
    def indicate(self):
        numbers = (c_double * self.counts[1])()
        if self.tries("GetEventIndicators", numbers, len(numbers)):
            assert all(map(math.isfinite, numbers))

    @in_turn("CompletedIntegratorStep")
    @rule()
    def complete(self):
        event, end = c_int(), c_int()
        if self.tries("CompletedIntegratorStep", 1, byref(event), byref(end)):
            assert not end.value

    @rule(
        call=st.sampled_from(
            [
                ("EnterInitializationMode",),
                ("ExitInitializationMode",),
                ("EnterEventMode",),
                ("EnterContinuousTimeMode",),
                ("NewDiscreteStates", byref(EventInfo())),
                ("CompletedIntegratorStep", 1, byref(c_int()), byref(c_int())),
                ("SetTime", 0.0),
                ("SetContinuousStates", (c_double * 99)(), 99),
                ("GetDerivatives", (c_double * 99)(), 99),
                ("GetEventIndicators", (c_double * 99)(), 99),
                ("DoStep", 0.0, 0.01, 1),
                ("Terminate",),
            ]
        )
    )
    def out_of_turn(self, call):
        if self.phase not in TAKEN[call[0]]:
            self.tries(*call)

    @in_turn("Terminate")
    @rule()
    def end(self):
        self.tries("Terminate", to=ENDED)

    @rule()
    def reset(self):
        self.tries("Reset", to=NEW)
        self.phase, self.time = NEW, 0.0

    @rule()
    def save_and_go_back(self):
        state = self.block.save()
        if self.phase == CONTINUOUS:
            self.advance_time(0.1)
        self.block.restore(state)
        content = self.block.as_bytes(state)
        again = self.block.save()
        assert self.block.as_bytes(again) == content
        self.block.forget(state)
        self.block.forget(again)
        if self.phase == CONTINUOUS:
            self.time -= 0.1

    @in_turn("GetReal")
    @rule(name=st.sampled_from(["x", "heat", "energy_residual", "surface_speed"]))
    def get(self, name):
        value = c_double()
        reference = c_uint(self.unit.references[name])
        if self.tries("GetReal", byref(reference), 1, byref(value)):
            assert math.isfinite(value.value)


def test_any_sequence_of_calls_is_answered_as_the_standard_says(unit, counts):
    machine = type("Calls", (Calls,), {"unit": unit, "counts": counts})
    run_state_machine_as_test(
        machine, settings=settings(max_examples=200, stateful_step_count=40, deadline=None)
    )
