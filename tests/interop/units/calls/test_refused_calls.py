"""Calls that a unit refuses in its run, as a host in C makes them: of FMI 2 and 3, and in exchange.

None of these can be made by fmpy, which puts arguments right; what it can is in `in_fmpy`.
"""

import math
from ctypes import byref, c_char_p, c_double, c_int, c_int32, c_uint, create_string_buffer

import pytest
from c_unit import OK, references, references3
from fmpy.fmi2 import fmi2EventInfo

from cosim.fmu.exchange import INDICATORS, states

NAN, COUNT = math.nan, len(states())
HALF = c_double(0.5)


@pytest.fixture
def host(request, unit, unit3):
    """Co-simulation of FMI 2, half a second after its start, and of 3; continuous-time mode."""
    made = {"2": unit, "3": unit3, "exchange": unit}[request.param]
    with made.instance(exchanges=request.param == "exchange") as one:
        one.begin()
        if request.param == "2":
            one.march(range(50), 0.01)
        elif request.param == "exchange":
            one.done("NewDiscreteStates", byref(fmi2EventInfo()))
            one.done("EnterContinuousTimeMode")
        yield one


def one(reference):
    return byref(c_uint(reference))


def floats(place, count=1, inside=0):
    """Arguments for one variable of FMI 3, by name or reference, and so many values."""
    reference = references3()[place] + inside if isinstance(place, str) else place
    return one(reference), 1, (c_double * max(count, 1))(), count


def along_vx(seed):
    vx = one(references()["vx"])
    return "GetDirectionalDerivative", vx, 1, vx, 1, byref(c_double(seed)), byref(c_double())


def no_numbers_as_states(block):
    block.done("SetContinuousStates", (c_double * COUNT)(*[NAN] * COUNT), COUNT)
    return "CompletedIntegratorStep", 1, byref(c_int()), byref(c_int())


#: Host, the call or what makes it, and why it is refused.
REFUSED = [
    ("2", ("GetReal", one(0), 1, None), "fmi2GetReal: no value ref"),
    ("2", ("SetReal", one(0), 1, None), "fmi2SetReal: no value ref"),
    ("2", lambda block: block.set_arguments("film_thickness", -1.0),
     "film_thickness = -1: must lie in [0, inf]"),
    ("2", ("CancelStep",), "fmi2CancelStep: no step is under way"),
    ("2", ("GetFMUstate", None), "fmi2GetFMUstate: nowhere to put"),
    ("2", ("SetFMUstate", None), "fmi2SetFMUstate: there is no state"),
    ("2", lambda block: ("SerializeFMUstate", block.save(), create_string_buffer(100), 100),
     "fewer bytes than a saved state takes"),
    ("2", ("SetDebugLogging", 1, 1, (c_char_p * 1)(b"logMore")), "categories are logStatusError"),
    ("2", ("SetDebugLogging", 1, 3, None), "fmi2SetDebugLogging: no categories"),
    ("3", ("GetFloat64", *floats(4711)), "value reference 4711: there is no such variable"),
    ("3", ("GetFloat64", *floats(0, 2)), "fmi3GetFloat64: 2 values, the variables have 1"),
    ("3", ("GetFloat64", None, 1, None, 1), "fmi3GetFloat64: no value references, or no values"),
    ("3", ("SetFloat64", *floats("time")), "time is the independent variable and cannot be set"),
    ("3", ("GetFloat64", *floats("friction.table_mu", 3)), "3 values, the variables have 96"),
    ("3", ("GetFloat64", *floats("friction.table_mu", inside=1)), "it is within an array"),
    ("3", ("GetBoolean", *floats(0)), "surface_speed is a real number, not a Boolean"),
    ("3", ("SetString", *floats(0)), "all variables are of the types Float64, Int32 and Boolean"),
    ("3", ("GetClock", None, 1, None), "fmi3GetClock: this unit has no clocks"),
    ("3", ("EnterConfigurationMode",), "this unit has no structural parameters"),
    ("3", ("GetVariableDependencies", 0, None, None, None, None, 0), "see the dependencies in"),
    ("3", ("EnterEventMode",), "this instance was made without event mode"),
    ("3", ("GetOutputDerivatives", one(0), 1, (c_int32 * 1)(1), (c_double * 1)(), 1),
     "output derivatives are of outputs that are real numbers"),
    ("3", ("DoStep", 0.0, 0.01, True, None, None, None, None), "nowhere to put what it tells"),
    *(("exchange", (function, (c_double * (count + by))(), count + by),
       f"{count + by} numbers asked for, there are {count}")
      for function, count in (("SetContinuousStates", COUNT), ("GetContinuousStates", COUNT),
                              ("GetDerivatives", COUNT), ("GetNominalsOfContinuousStates", COUNT),
                              ("GetEventIndicators", INDICATORS))
      for by in (-1, 1)),
    ("exchange", ("SetContinuousStates", None, COUNT), ""),
    ("exchange", ("GetDerivatives", None, COUNT), ""),
    ("exchange", ("NewDiscreteStates", None), ""),
    ("exchange", ("CompletedIntegratorStep", 1, None, None), ""),
    ("exchange", ("SetTime", NAN), ""),
    ("exchange", ("SetTime", math.inf), ""),
    ("exchange", ("SetRealInputDerivatives", one(0), 1, byref(c_int(1)), byref(HALF)), ""),
    *(("exchange", along_vx(seed), f"the direction along vx is {seed:g}; must be a finite number")
      for seed in (NAN, math.inf)),
    ("exchange", no_numbers_as_states, "not a finite number"),
]  # fmt: skip
#: What harms nothing: to have asked for a variable.
ASKS = ("GetReal", "GetFloat64", "GetBoolean")


@pytest.mark.parametrize(("host", "call", "says"), REFUSED, indirect=["host"])
def test_a_refused_call_is_an_error_that_names_the_culprit(host, call, says):
    """Though logging is off; values stay, and only what makes things good is taken."""
    function, *arguments = call(host) if callable(call) else call
    then = repr(host.everything())
    said = host.reason(function, *arguments)
    assert said and says in said
    assert repr(host.everything()) == then
    if function in ASKS:
        assert host.call(*host.set_arguments("surface_speed", 0.2)) == OK
        return
    for again in (("EnterEventMode",), ("Terminate",), host.set_arguments("surface_speed", 0.2)):
        assert "failed before" in host.reason(*again)
    host.done("Reset")
    host.begin()


def test_along_next_to_nothing_nothing_changes(unit):
    """A seed so small that a difference along it would be beyond all numbers."""
    force, vx = (one(references()[name]) for name in ("friction_force_x", "vx"))
    with unit.instance(exchanges=True) as block:
        block.begin()
        out, seed = c_double(NAN), byref(c_double(1e-320))
        block.done("GetDirectionalDerivative", force, 1, vx, 1, seed, byref(out))
    assert abs(out.value) <= 1e-320
