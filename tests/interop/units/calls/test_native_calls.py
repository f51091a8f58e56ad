"""What the native unit takes and what it refuses, call by call, as a host in C would make them."""

from ctypes import byref, c_char_p, c_double, c_int, c_void_p

import pytest
from c_unit import ERROR, functions
from contradictory import CONTRADICTIONS
from stickslip import Parameters
from stickslip.contradictions import contradiction

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


@pytest.mark.parametrize(("changed", "said"), [
    ({"guid": b"{00000000-0000-0000-0000-000000000000}"}, "the GUID is not that of this unit"),
    ({"guid": None}, "the GUID is not that of this unit"),
    ({"kind": NO_KIND}, "this unit is for"),
    ({"name": None}, "has no name"),
    ({"name": b""}, "has no name"),
    ({"token": b"{0}"}, "the instantiation token is not that of this unit"),
    ({"required": 0, "name": None}, "has no name"),
    ({"required": 1}, "has no intermediate update"),
])  # fmt: skip
def test_an_instance_that_cannot_be_is_none(unit, unit3, changed, said):
    one = (unit3 if {*changed} & {"token", "required"} else unit).instance(**changed)
    assert one.handle is None
    ((status, category, text),) = one.messages
    assert (status, category) == (ERROR, "logStatusError") and said in text


def test_scheduled_execution_is_refused(unit3):
    make = unit3.library.fmi3InstantiateScheduledExecution
    make.restype = c_void_p
    assert make(b"a", unit3.guid, None, False, False, None, None, None, None, None) is None


@pytest.mark.parametrize(("version", "count"), [(2, 40), (3, 70)])
def test_every_function_of_the_standard_is_there_and_wants_an_instance(unit, unit3, version, count):
    found, library = functions(version), (unit if version == 2 else unit3).library
    assert len(found) == count
    for name, arguments in found.items():
        nothing = [kind() for kind in arguments]
        assert getattr(library, f"fmi{version}{name}")(None, *nothing) == ERROR, name
    free, told = (
        getattr(library, f"fmi{version}{name}") for name in ("FreeInstance", "GetVersion")
    )
    free.argtypes, told.restype = (c_void_p,), c_char_p
    free(None)
    assert told() == f"{version}.0".encode()


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


def test_a_step_that_nobody_would_wait_for_is_refused(block):
    """Damping that brakes the block within a microsecond, for a second."""
    block.begin(**{"structural_damping.coefficient": 1e6})
    block.march([0], 0.1)
    assert "shorter communication steps" in block.reason("DoStep", 0.1, 1.0, 1)


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


def test_a_freed_state_is_no_pointer_any_more(block):
    state = block.save()
    block.forget(state)
    block.done("FreeFMUstate", byref(state))  # of nothing there is nothing to free
    block.done("FreeFMUstate", None)


def test_the_time_reached_can_be_asked_for(running):
    time, ended = c_double(), c_int(7)
    running.done("GetRealStatus", 2, byref(time))
    running.done("GetBooleanStatus", 3, byref(ended))
    assert time.value == pytest.approx(0.5) and ended.value == 0
