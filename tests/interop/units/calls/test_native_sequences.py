"""Any sequence of calls of the native unit, beside what the standard says of each."""

import math
from ctypes import byref, c_double, c_int, c_uint

from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    Bundle,
    RuleBasedStateMachine,
    invariant,
    precondition,
    rule,
    run_state_machine_as_test,
)
from native_unit import ERROR, OK, Unit
from phases import CO_SIMULATION_2, ENDED, FAILED, INITIALISING, NEW, STEPPING

NAN, INF = math.nan, math.inf
NO_KIND = 7
UNKNOWN = 9999  # a value reference

# What can be called at any time stands for itself below.
TAKEN = CO_SIMULATION_2.taken


def reals(*values):
    return (c_double * len(values))(*values)


def one(reference):
    return byref(c_uint(reference))


def in_turn(function):
    """A rule for the phases that take a call; `out_of_turn` makes it in the others."""
    return precondition(lambda self: self.phase in TAKEN[function])


class Calls(RuleBasedStateMachine):
    """Calls in any order, beside what the standard says of each."""

    unit: Unit
    states = Bundle("states")

    def __init__(self):
        super().__init__()
        self.block = self.unit.instance()
        self.phase, self.has_experiment, self.time = NEW, False, 0.0

    def teardown(self):
        self.block.free()

    def tries(self, function, *arguments, also=True, harmless=False):
        """Make a call; whether it was taken, which must be as the phase says."""
        self.block.messages.clear()
        expected = self.phase in TAKEN[function] and also
        status = self.block.call(function, *arguments)
        assert status == (OK if expected else ERROR), self.block.messages
        assert [each[0] for each in self.block.messages] == ([] if expected else [ERROR])
        if not (expected or harmless):
            self.phase = FAILED
        return expected

    @in_turn("SetupExperiment")
    @rule(start=st.sampled_from([0.0, -5.0, 1e6]))
    def set_up_experiment(self, start):
        if self.tries("SetupExperiment", 0, 0.0, start, 0, 0.0, also=not self.has_experiment):
            self.has_experiment, self.time = True, start

    @in_turn("EnterInitializationMode")
    @rule()
    def enter(self):
        if self.tries("EnterInitializationMode"):
            self.phase = INITIALISING

    @in_turn("ExitInitializationMode")
    @rule()
    def exit(self):
        if self.tries("ExitInitializationMode"):
            self.phase = STEPPING

    @in_turn("DoStep")
    @rule(size=st.sampled_from([1e-6, 0.001, 0.01, 0.3]), times=st.integers(1, 20))
    def step(self, size, times):
        for _ in range(times):
            if self.tries("DoStep", self.time, size, 1):
                self.time += size

    @in_turn("DoStep")
    @rule(size=st.sampled_from([0.0, -0.1, NAN, 1e4]))
    def step_that_cannot_be(self, size):
        self.tries("DoStep", self.time, size, 1, also=False)

    @in_turn("DoStep")
    @rule()
    def step_elsewhere(self):
        self.tries("DoStep", self.time + 1.0, 0.01, 1, also=False)

    @in_turn("Terminate")
    @rule()
    def end(self):
        if self.tries("Terminate"):
            self.phase = ENDED

    @rule()
    def reset(self):
        self.tries("Reset")
        self.phase, self.has_experiment, self.time = NEW, False, 0.0

    @rule(
        call=st.sampled_from(
            [
                ("SetupExperiment", 0, 0.0, 0.0, 0, 0.0),
                ("EnterInitializationMode",),
                ("ExitInitializationMode",),
                ("DoStep", 0.0, 0.01, 1),
                ("Terminate",),
                ("CancelStep",),
                ("GetReal", one(0), 1, reals(0.0)),
                ("SetReal", one(0), 1, reals(0.1)),
            ]
        )
    )
    def out_of_turn(self, call):
        if self.phase not in TAKEN[call[0]]:
            self.tries(*call)

    @in_turn("SetReal")
    @rule(
        name=st.sampled_from(["surface_speed", "external_force_x", "friction.mu_k"]),
        value=st.sampled_from([0.0, 0.1, 0.15, 0.2, 0.25, NAN]),
    )
    def set_in_the_run(self, name, value):
        self.tries(*self.block.set_arguments(name, value), also=math.isfinite(value))

    @in_turn("SetReal")
    @rule(
        name=st.sampled_from(["rig.mass", "initial.vx", "imperfections.seed", "rig.free_phi"]),
        value=st.sampled_from([1, 1, 1, -1]),
    )
    def set_before_the_run(self, name, value):
        function, *arguments = self.block.set_arguments(name, value)
        is_good = value > 0 or name == "initial.vx"
        self.tries(function, *arguments, also=is_good and self.phase in {NEW, INITIALISING})

    @in_turn("GetReal")
    @rule(name=st.sampled_from(["x", "mode", "energy_residual", "rig.mass", "slip_count"]))
    def get(self, name):
        number = c_double() if name not in self.unit.integers else c_int()
        function = "GetReal" if name not in self.unit.integers else "GetInteger"
        reference = c_uint(self.unit.references[name])
        if self.tries(function, byref(reference), 1, byref(number)):
            assert math.isfinite(number.value)

    @in_turn("SetReal")
    @rule(function=st.sampled_from(["GetReal", "SetReal", "GetInteger", "SetInteger"]))
    def miss(self, function):
        room = c_double() if function.endswith("Real") else c_int()
        asks = function.startswith("Get") and self.phase in TAKEN[function]
        self.tries(function, byref(c_uint(UNKNOWN)), 1, byref(room), also=False, harmless=asks)

    @rule(target=states, as_bytes=st.booleans())
    def save(self, as_bytes):
        state = self.block.save()
        content = self.block.as_bytes(state)
        if as_bytes:
            self.block.forget(state)
            state = self.block.from_bytes(content)
        self.block.restore(state)
        self.block.forget(state)
        return content, self.phase, self.has_experiment, self.time

    @rule(kept=states)
    def restore(self, kept):
        content, self.phase, self.has_experiment, self.time = kept
        state = self.block.from_bytes(content)
        self.block.restore(state)
        assert self.block.as_bytes(state) == content
        self.block.forget(state)

    @precondition(lambda self: self.phase == FAILED)
    @rule()
    def begin_anew(self):
        """All the way to the first step, which chance would seldom reach again."""
        self.reset()
        self.enter()
        self.exit()

    @invariant()
    def inputs_are_numbers(self):
        if self.phase in TAKEN["GetReal"]:
            assert all(map(math.isfinite, self.block.get("surface_speed", "external_force_x")))


def test_any_sequence_of_calls_is_answered_as_the_standard_says(unit):
    machine = type("Calls", (Calls,), {"unit": unit})
    run_state_machine_as_test(
        machine, settings=settings(max_examples=200, stateful_step_count=40, deadline=None)
    )
