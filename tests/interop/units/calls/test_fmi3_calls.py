"""What the unit for FMI 3.0 takes and what it refuses, call by call, as a host in C makes them."""

import ctypes
import random
from ctypes import byref, c_bool, c_double, c_int32, c_size_t, c_uint, c_void_p

import numpy as np
import pytest
from fmi3_unit import ERROR, OK, references
from phases import (
    CO_SIMULATION_3,
    CONTINUOUS,
    ENDED,
    EXCHANGE_3,
    FAILED,
    INITIALISING,
    NEW,
    STEPPING,
)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"token": b"{0}"}, "the instantiation token is not that of this unit"),
        ({"token": None}, "the instantiation token is not that of this unit"),
        ({"name": None}, "has no name"),
        ({"name": b""}, "has no name"),
        ({"required": 1}, "has no intermediate update"),
    ],
)
def test_an_instance_that_cannot_be_is_none(unit3, changed, said):
    block = unit3.instance(**changed)
    ((status, category, text),) = block.messages
    assert block.handle is None
    assert (status, category) == (ERROR, b"logStatusError") and said in text.decode()


def test_scheduled_execution_is_refused(unit3):
    make = unit3.library.fmi3InstantiateScheduledExecution
    make.restype = c_void_p
    assert make(b"a", unit3.token, None, False, False, None, None, None, None, None) is None


def one_float(place, count=1):
    """Arguments for one variable, by name or reference, and so many values."""
    name, _, inside = str(place).partition("+")
    reference = references()[name] + int(inside or 0) if isinstance(place, str) else place
    return byref(c_uint(reference)), 1, (c_double * max(count, 1))(), count


REFUSED = [
    ("GetFloat64", one_float(4711), "value reference 4711: there is no such variable"),
    ("GetFloat64", one_float(2**32 - 1), "value reference 4294967295: there is no such variable"),
    ("GetFloat64", one_float(0, 2), "fmi3GetFloat64: 2 values, the variables have 1"),
    ("GetFloat64", (None, 1, None, 1), "fmi3GetFloat64: no value references, or no values"),
    ("GetInt32", one_float(0), "surface_speed is a real number, not an integer"),
    ("SetFloat64", one_float("time"), "time is the independent variable and cannot be set"),
    ("SetFloat64", one_float("x"), "x is an output and cannot be set"),
    ("SetFloat64", one_float("rig.mass"), "rig.mass is fixed and cannot be set after"),
    ("GetFloat64", one_float("friction.table_mu", 3), "3 values, the variables have 96"),
    ("GetFloat64", one_float("friction.table_mu+1"), "no such variable, it is within an array"),
    ("GetBoolean", one_float(0), "surface_speed is a real number, not a Boolean"),
    ("SetString", one_float(0), "all variables are of the types Float64, Int32 and Boolean"),
    ("GetFloat32", one_float(0), "all variables are of the types Float64, Int32 and Boolean"),
    ("GetBinary", (None, 1, None, None, 1), "of the types Float64, Int32 and Boolean"),
    ("GetClock", (None, 1, None), "fmi3GetClock: this unit has no clocks"),
    ("SetIntervalFraction", (None, 1, None, None), "this unit has no clocks"),
    ("ActivateModelPartition", (0, 0.0), "this unit has no clocks"),
    ("EnterConfigurationMode", (), "this unit has no structural parameters"),
    ("ExitConfigurationMode", (), "this unit has no structural parameters"),
    ("GetVariableDependencies", (0, None, None, None, None, 0), "see the dependencies in"),
    ("GetNumberOfVariableDependencies", (0, None), "see the dependencies in"),
    ("EnterEventMode", (), "this instance was made without event mode"),
    ("GetOutputDerivatives", (byref(c_uint(0)), 1, (ctypes.c_int32 * 1)(1), (c_double * 1)(), 1),
     "output derivatives are of outputs that are real numbers"),
    ("DoStep", (0.0, 0.01, True, None, None, None, None), "nowhere to put what it tells"),
    ("SetDebugLogging", (True, 1, None), "fmi3SetDebugLogging: no categories"),
]  # fmt: skip


@pytest.mark.parametrize(("function", "arguments", "says"), REFUSED)
def test_a_call_that_makes_no_sense_is_refused(unit3, function, arguments, says):
    with unit3.instance() as block:
        block.begin()
        assert says in block.reason(function, *arguments)
        if function in ("GetFloat64", "GetInt32", "GetBoolean", "GetFloat32", "GetBinary"):
            block.step(0.01)  # to have asked harms nothing
            return
        assert "failed before" in block.reason("EnterEventMode")
        block.done("Reset")
        block.begin()


STATES = [(each, phase) for each in (CO_SIMULATION_3, EXCHANGE_3) for phase in each.phases]
FUNCTIONS = [*CO_SIMULATION_3.taken]
OF_STATES = (
    "SetContinuousStates",
    "GetContinuousStates",
    "GetContinuousStateDerivatives",
    "GetNominalsOfContinuousStates",
)


def said(value):
    """Of a test's parameter."""
    return value if isinstance(value, str) else "exchange" if value.exchanges else "co-simulation"


def in_phase(unit3, interface, phase):
    """An instance that has come that far."""
    block = unit3.instance(exchanges=interface.exchanges, events=True, early=True)
    if phase == NEW:
        return block
    block.set("surface_speed", 0.15)
    block.done("EnterInitializationMode", False, 0.0, 0.0, False, 0.0)
    if phase == INITIALISING:
        return block
    block.done("ExitInitializationMode")
    if phase == CONTINUOUS:
        block.update()
        block.done("EnterContinuousTimeMode")
    if phase == STEPPING:
        block.done("EnterStepMode")
    if phase == ENDED:
        block.done("Terminate")
    if phase == FAILED:
        block.reason("ExitInitializationMode")
    block.messages.clear()
    return block


def sensible(unit3, function):
    """Arguments that would do."""
    flags = [byref(c_bool()) for _ in range(5)]
    numbers, integer = (c_double * 20)(), (c_int32 * 1)()
    return {
        "EnterInitializationMode": (False, 0.0, 0.0, False, 0.0),
        "SetDebugLogging": (False, 0, None),
        "UpdateDiscreteStates": (*flags, byref(c_double())),
        "DoStep": (0.0, 0.01, True, *flags[:3], byref(c_double())),
        "SetTime": (0.001,),
        "CompletedIntegratorStep": (True, *flags[:2]),
        "GetEventIndicators": (numbers, 3),
        "GetNumberOfContinuousStates": (byref(c_size_t()),),
        "GetNumberOfEventIndicators": (byref(c_size_t()),),
        "GetFloat64": (byref(c_uint(0)), 1, numbers, 1),
        "SetFloat64": (byref(c_uint(0)), 1, numbers, 1),
        "GetInt32": (byref(c_uint(unit3.references["mode"])), 1, integer, 1),
        "SetInt32": (byref(c_uint(unit3.references["rig.free_y"])), 1, integer, 1),
        "GetOutputDerivatives": (None, 0, None, None, 0),
        **dict.fromkeys(OF_STATES, (numbers, 20)),
    }.get(function, ())


@pytest.mark.parametrize(("interface", "phase"), STATES, ids=said)
@pytest.mark.parametrize("function", FUNCTIONS)
def test_each_phase_takes_the_calls_of_the_standard(unit3, function, interface, phase):
    with in_phase(unit3, interface, phase) as block:
        taken = block.call(function, *sensible(unit3, function))
        expected = OK if phase in interface.taken[function] else ERROR
        assert taken == expected, block.messages
        if taken == ERROR:
            reasons = (f"fmi3{function}", "this instance", "rig.free_y is fixed")
            assert block.messages[0][2].decode().startswith(reasons)


@pytest.mark.parametrize(
    ("interface", "phase"),
    [(each, phase) for each, phase in STATES if phase in each.taken["GetFloat64"]],
    ids=said,
)
def test_every_variable_can_be_read_and_is_a_number(unit3, interface, phase):
    with in_phase(unit3, interface, phase) as block:
        for name in [*unit3.references]:
            assert np.all(np.isfinite(block.get(name))), name
        numbers = (c_double * 3)()
        last = unit3.references["time"]
        block.done("GetFloat64", (c_uint * 3)(last + 1, last + 2, last + 3), 3, numbers, 3)
        assert all(numbers)


def test_no_sequence_of_calls_is_too_much(unit3):
    """Whatever comes: an answer with a reason, numbers that are numbers, and a reset that helps."""
    answers = {OK: 0, ERROR: 0}
    under_way = [(each, phase) for each, phase in STATES if phase not in (ENDED, FAILED)]
    for seed in range(300):
        numbers = random.Random(seed)
        with in_phase(unit3, *numbers.choice(under_way)) as block:
            saved = []
            for _ in range(40):
                function = numbers.choice([*FUNCTIONS, "GetFMUState", "SetFMUState"])
                if function == "GetFMUState":
                    saved.append(block.save())
                elif function == "SetFMUState":
                    if saved:
                        block.done("SetFMUState", numbers.choice(saved))
                else:
                    block.messages.clear()
                    answer = block.call(function, *sensible(unit3, function))
                    answers[answer] += 1
                    assert (answer == ERROR) is bool(block.messages)
            for state in saved:
                block.done("FreeFMUState", byref(state))
            block.done("Reset")
    assert min(answers.values()) > 500
