"""What the native unit takes and what it refuses, call by call, as a host in C would make them."""

import math
from ctypes import (
    byref,
    c_char_p,
    c_double,
    c_int,
    c_size_t,
    c_uint,
    c_void_p,
    create_string_buffer,
)  # fmt: skip

import pytest
from c_instance import DISCARD, ERROR, functions
from contradictory import CONTRADICTIONS
from native_unit import CO_SIMULATION
from stickslip import Parameters
from stickslip.contradictions import contradiction

NAN, INF = math.nan, math.inf
NO_KIND = 7


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


@pytest.mark.parametrize("function", functions(2))
def test_without_an_instance_a_call_is_an_error(unit, function):
    nothing = [kind() for kind in functions(2)[function]]
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
    "setReal of rig.free_y": (read("SetReal", "rig.free_y", c_double()), "rig.free_y is an int"),
    "Boolean output": (read("SetBoolean", "off_belt", c_int()), "off_belt is an output and"),
    "getReal into nothing": (call("GetReal", one(0), 1, None), "fmi2GetReal: no value ref"),
    "getReal of nothing": (call("GetReal", None, 1, reals(0.0)), "fmi2GetReal: no value ref"),
    "getInteger into nothing": (call("GetInteger", one(0), 1, None), "fmi2GetInteger: no"),
    "setReal from nothing": (call("SetReal", one(0), 1, None), "fmi2SetReal: no value ref"),
    "setInteger from nothing": (call("SetInteger", None, 2, None), "fmi2SetInteger: no value"),
    "input out of range": (
        set_by_name("film_thickness", -1.0),
        "film_thickness = -1: must lie in [0, inf]",
    ),
    "input infinite": (set_by_name("external_moment", -INF), "external_moment = -inf: must be"),
    "fixed integer": (set_by_name("rig.free_phi", 0), "rig.free_phi is fixed"),
    "tunable out of range": (set_by_name("friction.mu_k", -0.1), "friction.mu_k = -0.1: must lie"),
    "tunable NaN": (set_by_name("friction.mu_s", NAN), "friction.mu_s = nan: must be a finite"),
    "whole output": (set_by_name("slip_count", 1), "slip_count is an output and cannot be set"),
    "cancelStep": (call("CancelStep"), "fmi2CancelStep: no step is under way"),
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
    "too few bytes": (too_short, "fewer bytes than a saved state takes"),
    "state of no bytes": (
        call("DeSerializeFMUstate", None, 0, byref(c_void_p())),
        "fmi2DeSerializeFMUstate: no bytes",
    ),
    "unknown category": (
        call("SetDebugLogging", 1, 1, (c_char_p * 1)(b"logMore")),
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


def test_a_start_so_far_off_that_steps_are_lost_is_refused(block):
    block.begin(1e16)
    assert "lost in the rounding of the time" in block.reason("DoStep", 1e16, 0.01, 1)


def test_a_step_that_nobody_would_wait_for_is_refused(block):
    """Damping that brakes the block within a microsecond, for a second."""
    block.begin(**{"structural_damping.coefficient": 1e6})
    block.march([0], 0.1)
    assert "shorter communication steps" in block.reason("DoStep", 0.1, 1.0, 1)


def test_what_is_not_meant_is_not_looked_at(block):
    block.done("SetupExperiment", 0, NAN, 0.0, 0, NAN)


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
        ("GetStringStatus", c_char_p),
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
