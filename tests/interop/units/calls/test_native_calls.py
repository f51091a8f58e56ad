"""What the native unit takes and what it refuses, call by call, as a host in C would make them."""

import math
import random
from ctypes import byref, c_double, c_int, c_size_t, c_uint, c_void_p, create_string_buffer

import pytest
from contradictory import CONTRADICTIONS
from native_unit import ARGUMENTS, CO_SIMULATION, DISCARD, ERROR
from phases import CO_SIMULATION_2
from stickslip import Parameters
from stickslip.contradictions import contradiction

NAN, INF = math.nan, math.inf
NO_KIND = 7
UNKNOWN = 9999  # a value reference

# What can be called at any time stands for itself below.
TAKEN = CO_SIMULATION_2.taken


@pytest.fixture
def block(unit):
    with unit.instance() as one:
        yield one


@pytest.fixture
def running(block):
    """An instance half a second after its start."""
    block.begin()
    block.march(range(50), 0.01)
    return block


# --- instances ---


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"guid": b"{00000000-0000-0000-0000-000000000000}"}, "the GUID is not that of this unit"),
        ({"guid": None}, "the GUID is not that of this unit"),
        ({"kind": NO_KIND}, "this unit is for"),
        ({"name": None}, "has no name"),
        ({"name": b""}, "has no name"),
    ],
)
def test_an_instance_that_cannot_be_is_none(unit, changed, said):
    one = unit.instance(**changed)
    assert one.handle is None
    ((status, category, text),) = one.messages
    assert (status, category) == (ERROR, "logStatusError") and said in text


def test_an_instance_needs_a_logger(unit):
    assert unit.library.fmi2Instantiate(b"a", CO_SIMULATION, unit.guid, None, None, 0, 0) is None


@pytest.mark.parametrize(
    "resources",
    [
        "file:/abs",
        "file:///abs/resources",
        "file://localhost/abs",
        "file:///home/R&D/fmu",
        "file:///home/\u00fcbung",
        "file:///a%20b%",
        "file:///a#b",
        "%s%n",
        "/no/uri",
        "",
        None,
    ],
)
def test_where_its_resources_lie_is_of_no_concern(unit, resources):
    with unit.instance(resources=resources and resources.encode()) as one:
        one.begin()
        one.march(range(3), 0.01)
        assert one.messages == []


def test_a_name_is_handed_to_the_logger_as_it_is(unit):
    with unit.instance(name="Block \u00fc %s %n".encode()) as one:
        assert "step size" not in one.reason("DoStep", 0.0, 0.0, 1)


@pytest.mark.parametrize("function", ARGUMENTS)
def test_without_an_instance_a_call_is_an_error(unit, function):
    nothing = [kind() for kind in ARGUMENTS[function]]
    assert getattr(unit.library, f"fmi2{function}")(None, *nothing) == ERROR
    unit.library.fmi2FreeInstance.argtypes = (c_void_p,)
    unit.library.fmi2FreeInstance(None)


# --- calls that are refused in the run ---


def reals(*values):
    return (c_double * len(values))(*values)


def one(reference):
    return byref(c_uint(reference))


def set_by_name(name, value):
    return lambda block: block.set_arguments(name, value)


def call(*arguments):
    return lambda block: arguments


def read(function, name, room):
    return lambda block: (function, one(block.unit.references[name]), 1, byref(room))


def too_short(block):
    return "SerializeFMUstate", block.save(), create_string_buffer(100), 100


REFUSED = {
    "getReal of no variable": (
        call("GetReal", one(UNKNOWN), 1, reals(0.0)),
        "value reference 9999: there is no such variable",
    ),
    "setReal of no variable": (call("SetReal", one(UNKNOWN), 1, reals(0.0)), "reference 9999"),
    "getReal of the largest reference": (
        call("GetReal", one(2**32 - 1), 1, reals(0.0)),
        "reference 4294967295",
    ),
    "setReal of rig.free_y": (read("SetReal", "rig.free_y", c_double()), "rig.free_y is an int"),
    "getInteger of x": (read("GetInteger", "x", c_int()), "x is a real number, not an integer"),
    "setInteger of an input": (
        read("SetInteger", "surface_speed", c_int()),
        "surface_speed is a real number",
    ),
    "getBoolean": (read("GetBoolean", "mode", c_int()), "mode is an integer, not a Boolean"),
    "setBoolean": (read("SetBoolean", "mode", c_int()), "mode is an integer, not a Boolean"),
    "Boolean output": (read("SetBoolean", "off_belt", c_int()), "off_belt is an output and"),
    "getString": (call("GetString", None, 1, None), "no variable is a text"),
    "setString": (call("SetString", None, 1, None), "no variable is a text"),
    "getReal into nothing": (call("GetReal", one(0), 1, None), "fmi2GetReal: no value ref"),
    "getReal of nothing": (call("GetReal", None, 1, reals(0.0)), "fmi2GetReal: no value ref"),
    "getInteger into nothing": (call("GetInteger", one(0), 1, None), "fmi2GetInteger: no"),
    "setReal from nothing": (call("SetReal", one(0), 1, None), "fmi2SetReal: no value ref"),
    "setInteger from nothing": (call("SetInteger", None, 2, None), "fmi2SetInteger: no value"),
    "input out of range": (
        set_by_name("film_thickness", -1.0),
        "film_thickness = -1: must lie in [0, inf]",
    ),
    "input below": (
        set_by_name("interface_temperature", -300.0),
        "interface_temperature = -300: must lie in [-273.15, inf]",
    ),
    "input NaN": (set_by_name("surface_speed", NAN), "surface_speed = nan: must be a finite"),
    "input infinite": (set_by_name("external_moment", -INF), "external_moment = -inf: must be"),
    "fixed parameter": (
        set_by_name("rig.mass", 1.0),
        "rig.mass is fixed and cannot be set after initialisation",
    ),
    "fixed integer": (set_by_name("rig.free_phi", 0), "rig.free_phi is fixed"),
    "tunable out of range": (set_by_name("friction.mu_k", -0.1), "friction.mu_k = -0.1: must lie"),
    "tunable NaN": (set_by_name("friction.mu_s", NAN), "friction.mu_s = nan: must be a finite"),
    "output": (set_by_name("x", 1.0), "x is an output and cannot be set"),
    "whole output": (set_by_name("slip_count", 1), "slip_count is an output and cannot be set"),
    "step from before": (call("DoStep", 0.4, 0.01, 1), "begins at t = 0.4 s, the last one ended"),
    "step from later": (call("DoStep", 0.6, 0.01, 1), "the last one ended at t = 0.5 s"),
    "step from NaN": (call("DoStep", NAN, 0.01, 1), "step from t = nan"),
    "step of 0": (call("DoStep", 0.5, 0.0, 1), "step size is 0 s; must be greater than 0"),
    "step back": (call("DoStep", 0.5, -0.1, 1), "step size is -0.1 s"),
    "step of NaN": (call("DoStep", 0.5, NAN, 1), "of size nan: must be finite numbers"),
    "endless step": (call("DoStep", 0.5, INF, 1), "of size inf: must be finite numbers"),
    "step of no length": (call("DoStep", 0.5, 1e-17, 1), "step size is 1e-17 s, lost in the round"),
    "step too long": (
        call("DoStep", 0.5, 1e4, 1),
        "step size is 10000 s; must be at most 1000 s, as a step cannot be interrupted",
    ),
    "cancelStep": (call("CancelStep"), "fmi2CancelStep: no step is under way"),
    "setupExperiment": (
        call("SetupExperiment", 0, 0.0, 0.0, 0, 0.0),
        "fmi2SetupExperiment: not allowed while the instance is stepping",
    ),
    "enterInitializationMode": (
        call("EnterInitializationMode"),
        "fmi2EnterInitializationMode: not allowed while the instance is stepping",
    ),
    "exitInitializationMode": (call("ExitInitializationMode"), "not allowed while the instance"),
    "state into nothing": (call("GetFMUstate", None), "fmi2GetFMUstate: nowhere to put"),
    "state from nothing": (call("SetFMUstate", None), "fmi2SetFMUstate: there is no state"),
    "size of no state": (
        call("SerializedFMUstateSize", None, byref(c_size_t())),
        "fmi2SerializedFMUstateSize: there is no state",
    ),
    "bytes of no state": (
        call("SerializeFMUstate", None, create_string_buffer(9), 9),
        "fmi2SerializeFMUstate: no state",
    ),
    "too few bytes": (too_short, "fewer bytes than fmi2SerializedFMUstateSize asks for"),
    "state of no bytes": (
        call("DeSerializeFMUstate", None, 0, byref(c_void_p())),
        "fmi2DeSerializeFMUstate: no bytes",
    ),
    "state of wrong bytes": (
        call("DeSerializeFMUstate", b"{not a state", 12, byref(c_void_p())),
        "the state is damaged",
    ),
    "unknown category": (
        call("SetDebugLogging", 1, 1, (ARGUMENTS["SetDebugLogging"][2]._type_ * 1)(b"logMore")),
        "the categories are logStatusError",
    ),
    "no categories": (call("SetDebugLogging", 1, 3, None), "fmi2SetDebugLogging: no categories"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_a_refused_call_is_an_error_that_names_the_culprit(running, case):
    """Though logging is off; values stay, and only what makes things good is taken. But to have
    asked for a value that there is not harms nothing."""
    make, said = REFUSED[case]
    state, then = running.save(), running.everything()
    assert said in running.reason(*make(running))
    assert running.everything() == then
    if case.startswith("get"):
        running.march([50], 0.01)
        return
    for arguments in (
        ("DoStep", 0.5, 0.01, 1),
        running.set_arguments("surface_speed", 0.2),
        ("Terminate",),
        ("EnterInitializationMode",),
    ):
        assert "has failed before; reset it or set an earlier state" in running.reason(*arguments)
    running.restore(state)
    running.march([50], 0.01)
    running.forget(state)
    running.done("Reset")
    running.begin()
    running.march(range(50), 0.01)
    assert running.everything() == then


@pytest.mark.parametrize("logging", [False, True])
def test_errors_are_logged_however_logging_is_set(unit, logging):
    with unit.instance(logging=logging) as one:
        one.begin()
        one.done("SetDebugLogging", int(logging), 0, None)
        assert "step size" in one.reason("DoStep", 0.0, -1.0, 1)


def test_a_warning_is_for_who_wants_to_hear_it(unit):
    slow = {"friction.stick_creep": 0.01, "surface_speed": 0.005}
    heard = []
    for logging in (False, True):
        with unit.instance(logging=logging) as one:
            one.begin(**slow)
            one.march(range(3), 0.01)
            heard.append([text for _, _, text in one.messages])
    assert heard[0] == [] and len(heard[1]) == 1 and "never breaks away" in heard[1][0]


# --- calls that are refused before the run and after it ---


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("rig.mass", 0.0, "rig.mass = 0: must lie in (0, inf]"),
        ("rig.mass", NAN, "rig.mass = nan: must be a finite number"),
        ("speed_ripple.amplitude", 1.5, "speed_ripple.amplitude = 1.5: must lie in [0, 1]"),
        ("imperfections.seed", -1, "imperfections.seed = -1: must lie in [0, 2.14748e+09]"),
        ("rig.free_y", 2, "rig.free_y = 2: must lie in [0, 1]"),
        ("x", 0.0, "x is an output and cannot be set"),
    ],
)
def test_a_parameter_out_of_range_is_refused_at_once(block, name, value, said):
    assert said in block.reason(*block.set_arguments(name, value))


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ((0, 0.0, NAN, 0, 0.0), "start time is nan; must be a finite number"),
        ((0, 0.0, -INF, 0, 0.0), "start time is -inf"),
        ((0, 0.0, 1.0, 1, 0.5), "stop time is 0.5 s; must not be before the start time, 1 s"),
        ((0, 0.0, 1.0, 1, NAN), "stop time is nan s"),
        ((1, -1e-3, 0.0, 0, 0.0), "tolerance is -0.001; must be a finite number of at least 0"),
        ((1, NAN, 0.0, 0, 0.0), "tolerance is nan"),
    ],
)
def test_an_experiment_that_cannot_be_is_refused(block, arguments, said):
    assert said in block.reason("SetupExperiment", *arguments)


def test_a_step_past_the_stop_time_is_refused(block):
    """Section 2.1.6 of the standard; but a stop time that is missed by rounding is none."""
    block.done("SetupExperiment", 0, 0.0, 0.0, 1, 0.3)
    block.done("EnterInitializationMode")
    block.done("ExitInitializationMode")
    block.march(range(3), 0.1)  # 0.2 + 0.1 is more than 0.3
    state = block.save()
    said = block.reason("DoStep", 0.3, 1e-3, 1)
    assert said == "step to t = 0.301 s goes past the stop time that was set up, 0.3 s"
    block.restore(state)
    assert "past the stop time" in block.reason("DoStep", 0.3, 1e-3, 1)
    block.forget(state)
    block.done("Reset")
    block.begin().march(range(4), 0.1)


def test_a_start_so_far_off_that_steps_are_lost_is_refused(block):
    block.begin(1e16)
    assert "lost in the rounding of the time" in block.reason("DoStep", 1e16, 0.01, 1)


def test_a_step_that_nobody_would_wait_for_is_refused(block):
    """Damping that brakes the block within a microsecond, for a quarter of an hour."""
    block.begin(**{"structural_damping.coefficient": 1e6})
    block.march([0], 0.1)
    assert "shorter communication steps" in block.reason("DoStep", 0.1, 900.0, 1)


def test_what_is_not_meant_is_not_looked_at(block):
    block.done("SetupExperiment", 0, NAN, 0.0, 0, NAN)


def test_an_experiment_is_set_up_once(block):
    block.done("SetupExperiment", 0, 0.0, 0.0, 0, 0.0)
    assert "set up before" in block.reason("SetupExperiment", 0, 0.0, 0.0, 0, 0.0)


@pytest.mark.parametrize(
    "arguments",
    [
        ("DoStep", 0.0, 0.01, 1),
        ("ExitInitializationMode",),
        ("Terminate",),
        ("GetReal", one(0), 1, reals(0.0)),
    ],
)
def test_a_call_before_its_time_is_refused(block, arguments):
    said = block.reason(*arguments)
    assert said == f"fmi2{arguments[0]}: not allowed while the instance is instantiated"


@pytest.mark.parametrize(
    "arguments", [("DoStep", 0.5, 0.01, 1), ("Terminate",), ("SetReal", one(0), 1, reals(0.1))]
)
def test_after_its_end_a_run_can_be_read_and_no_more(running, arguments):
    then = running.everything()
    running.done("Terminate")
    assert running.everything() == then
    assert "not allowed while the instance is terminated" in running.reason(*arguments)


# negative numbers in the table are out of range one by one
BY_RANGE = {"TABLE_AT_NEGATIVE_SPEED", "TABLE_OF_NEGATIVE_FRICTION"}


@pytest.mark.parametrize("code", sorted(CONTRADICTIONS.keys() - BY_RANGE))
def test_contradictions_are_refused_in_the_words_of_python(unit, code):
    for given, _ in CONTRADICTIONS[code]:
        with unit.instance() as one:
            for name, value in given.items():
                one.set(name, value)
            one.done("EnterInitializationMode")
            said = one.reason("ExitInitializationMode")
            assert said == contradiction(Parameters().flat() | given) != ""


def test_contradictions_in_a_sequence_of_settings_are_none(block):
    """Only what stands at the end counts: a host sets one after the other."""
    block.set("friction.presliding_distance", 5e-5)
    block.set("friction.transition_speed", 3e-3)
    block.begin()


def test_a_freed_state_is_no_pointer_any_more(block):
    state = block.save()
    block.forget(state)
    block.done("FreeFMUstate", byref(state))  # of nothing there is nothing to free
    block.done("FreeFMUstate", None)


@pytest.mark.parametrize(
    ("function", "room"),
    [
        ("GetStatus", c_int),
        ("GetIntegerStatus", c_int),
        ("GetStringStatus", ARGUMENTS["GetStringStatus"][1]._type_),
    ],
)
def test_of_a_step_that_is_never_pending_there_is_nothing_to_ask(running, function, room):
    assert running.call(function, 0, byref(room())) == DISCARD
    running.march([50], 0.01)


def test_the_time_reached_can_be_asked_for(running):
    time, ended = c_double(), c_int(7)
    running.done("GetRealStatus", 2, byref(time))
    running.done("GetBooleanStatus", 3, byref(ended))
    assert time.value == pytest.approx(0.5) and ended.value == 0


# --- the motion, where calls decide over it ---

DRIVES = {
    "plain": {},
    "run-up": {"surface.run_up_time": 10.0},
    "ripple": {"speed_ripple.amplitude": 0.4, "speed_ripple.frequency": 1.3},
}


@pytest.mark.parametrize("start", [-5.0, 5.0, 1e6])
@pytest.mark.parametrize("drive", DRIVES)
def test_a_run_that_starts_at_another_time_is_the_same(unit, start, drive):
    motions = []
    for first in (0.0, start):
        with unit.instance() as one:
            one.begin(first, **DRIVES[drive])
            rows = []
            for n in range(400):
                one.march([n], 0.03125, first)
                rows += one.get("x", "vx", "heat", "surface_speed_actual")
            motions.append(rows)
    assert motions[1] == pytest.approx(motions[0], abs=1e-9)


def test_a_tuned_coefficient_acts_from_now_on_and_keeps_the_balance_of_energy(unit):
    numbers = random.Random(3)
    with unit.instance() as tuned, unit.instance() as left:
        for one in (tuned, left):
            one.begin(**{"lateral_friction.ratio": 1.0, "initial.phi": 0.05})
            one.march(range(150), 0.01)
        assert tuned.everything() == left.everything()
        for n in range(150, 1000, 50):
            low = numbers.uniform(0.05, 0.2)
            tuned.set("friction.mu_k", low)
            tuned.set("friction.mu_s", low + numbers.uniform(0.0, 0.2))
            tuned.march(range(n, n + 50), 0.01)
        left.march(range(150, 1000), 0.01)
        assert abs(tuned.get("heat")[0] - left.get("heat")[0]) > 0.01
        for one in (tuned, left):
            assert abs(one.get("energy_residual")[0]) < 1e-9
