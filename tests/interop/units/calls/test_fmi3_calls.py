"""What the unit for FMI 3.0 takes and what it refuses, call by call, as a host in C makes them."""

import ctypes
from ctypes import byref, c_double, c_uint, c_void_p

import pytest
from fmi3_unit import references


def test_scheduled_execution_is_refused(unit3):
    make = unit3.library.fmi3InstantiateScheduledExecution
    make.restype = c_void_p
    assert make(b"a", unit3.guid, None, False, False, None, None, None, None, None) is None


def one_float(place, count=1):
    """Arguments for one variable, by name or reference, and so many values."""
    name, _, inside = str(place).partition("+")
    reference = references()[name] + int(inside or 0) if isinstance(place, str) else place
    return byref(c_uint(reference)), 1, (c_double * max(count, 1))(), count


REFUSED = [
    ("GetFloat64", one_float(4711), "value reference 4711: there is no such variable"),
    ("GetFloat64", one_float(0, 2), "fmi3GetFloat64: 2 values, the variables have 1"),
    ("GetFloat64", (None, 1, None, 1), "fmi3GetFloat64: no value references, or no values"),
    ("SetFloat64", one_float("time"), "time is the independent variable and cannot be set"),
    ("GetFloat64", one_float("friction.table_mu", 3), "3 values, the variables have 96"),
    ("GetFloat64", one_float("friction.table_mu+1"), "no such variable, it is within an array"),
    ("GetBoolean", one_float(0), "surface_speed is a real number, not a Boolean"),
    ("SetString", one_float(0), "all variables are of the types Float64, Int32 and Boolean"),
    ("GetClock", (None, 1, None), "fmi3GetClock: this unit has no clocks"),
    ("EnterConfigurationMode", (), "this unit has no structural parameters"),
    ("GetVariableDependencies", (0, None, None, None, None, 0), "see the dependencies in"),
    ("EnterEventMode", (), "this instance was made without event mode"),
    ("GetOutputDerivatives", (byref(c_uint(0)), 1, (ctypes.c_int32 * 1)(1), (c_double * 1)(), 1),
     "output derivatives are of outputs that are real numbers"),
    ("DoStep", (0.0, 0.01, True, None, None, None, None), "nowhere to put what it tells"),
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
