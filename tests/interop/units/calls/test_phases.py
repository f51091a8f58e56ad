"""Which phase of an instance takes which call.

Of both versions of FMI, for co-simulation and model exchange, read off the tables of FMI 2.0.4
(3.2.3, 4.2.4) and the states of FMI 3.0 (2.3, 3.2, 4.2). What they leave to a unit: of a failed
instance it gives variables, and no rates.
"""

import csv
from ctypes import byref, c_bool, c_double, c_int, c_int32, c_size_t, c_uint
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from c_unit import ERROR, OK
from fmpy.fmi2 import fmi2EventInfo

from cosim.fmu.exchange import INDICATORS, states

NEW, INITIALISING, STEPPING, EVENT = "new", "initialising", "stepping", "event"
CONTINUOUS, ENDED, FAILED = "continuous", "ended", "failed"
_LETTERS = {"I": NEW, "N": INITIALISING, "S": STEPPING, "E": EVENT, "C": CONTINUOUS}
_LETTERS |= {"T": ENDED, "F": FAILED}

# name in FMI 2, name in FMI 3, phases of co-simulation, phases of model exchange; whole numbers of
# this unit are fixed parameters, all, which are set before its run
_CALLS = list(csv.reader(Path(__file__).with_name("phases.csv").read_text().splitlines()[1:]))


class Interface(NamedTuple):
    """A version of FMI, for model exchange or for co-simulation, of FMI 3 with event mode."""

    version: int
    exchanges: bool

    @property
    def phases(self) -> list[str]:
        """Those that an instance can be in."""
        if self.exchanges:
            return [_LETTERS[each] for each in "INECTF"]
        return [_LETTERS[each] for each in ("INSTF" if self.version == 2 else "INSETF")]

    @property
    def taken(self) -> dict[str, set[str]]:
        """Function, without "fmi2" or "fmi3" -> phases that take it."""
        here = set(self.phases)
        return {
            row[self.version - 2]: here & {_LETTERS[each] for each in row[2 + self.exchanges]}
            for row in _CALLS
            if row[self.version - 2]
        }


CO_SIMULATION_2, EXCHANGE_2 = Interface(2, False), Interface(2, True)
CO_SIMULATION_3, EXCHANGE_3 = Interface(3, False), Interface(3, True)
INTERFACES = (CO_SIMULATION_2, EXCHANGE_2, CO_SIMULATION_3, EXCHANGE_3)
STATES = [(each, phase) for each in INTERFACES for phase in each.phases]
#: Where a call that is taken leads; others stay where they are.
LEADS = {
    "EnterInitializationMode": INITIALISING,
    "ExitInitializationMode": EVENT,  # of FMI 2 in co-simulation: stepping
    "EnterStepMode": STEPPING,
    "EnterEventMode": EVENT,
    "EnterContinuousTimeMode": CONTINUOUS,
    "Terminate": ENDED,
    "Reset": NEW,
}
SIZE, COUNT = 0.01, len(states())  # s; numbers of a state


def said(value):
    """Of a test's parameter."""
    if isinstance(value, str):
        return value
    return f"{'exchange' if value.exchanges else 'co-simulation'} {value.version}"


class Walk:
    """An instance with what the standard says of it: its phase, its time, what has been set up."""

    def __init__(self, units, interface):
        self.interface, self.unit = interface, units[interface.version]
        more = {} if interface.version == 2 else {"events": True, "early": True}
        self.block = self.unit.instance(exchanges=interface.exchanges, **more)
        self.known = (NEW, 0.0, False)

    def call(self, function):
        """Make a call that makes sense, and look at the answer; whether it was taken."""
        phase, time, is_set_up = self.known
        is_twice = function == "SetupExperiment" and is_set_up
        expected = phase in self.interface.taken[function] and not is_twice
        given, reached = self._arguments(function, time)
        self.block.messages.clear()
        answer = self.block.call(function, *given)
        assert answer == (OK if expected else ERROR), (function, self.known, self.block.messages)
        assert len(self.block.messages) == (answer == ERROR)
        if not expected:
            phase = FAILED
        elif function == "ExitInitializationMode" and self.interface is CO_SIMULATION_2:
            phase = STEPPING
        else:
            phase = LEADS.get(function, phase)
        if function == "Reset":
            time, is_set_up = 0.0, False
        elif expected and function == "DoStep":
            time = reached.value if self.interface.version == 3 else time + SIZE
        self.known = (phase, time, is_set_up or (expected and function == "SetupExperiment"))
        return expected

    def _arguments(self, function, time):
        old, reached = self.interface.version == 2, c_double()
        flags = [byref(c_bool()) for _ in range(5)]
        room, whole = (c_double * 99)(), (c_int32 * 1)()
        places = self.unit.references
        numbers, inputs = (room, COUNT), (byref(c_uint(places["surface_speed"])), 1, room)
        count = () if old else (1,)
        of_states = "SetContinuousStates", "GetContinuousStates", "GetNominalsOfContinuousStates"
        given = {
            "SetupExperiment": (0, 0.0, 0.0, 0, 0.0),
            "EnterInitializationMode": () if old else (False, 0.0, 0.0, False, 0.0),
            "SetDebugLogging": (0, 0, None),
            "NewDiscreteStates": (byref(fmi2EventInfo()),),
            "UpdateDiscreteStates": (*flags, byref(c_double())),
            "DoStep": (time, SIZE, 1) if old else (time, SIZE, True, *flags[:3], byref(reached)),
            "SetTime": (0.001,),
            "CompletedIntegratorStep": (1, byref(c_int()), byref(c_int())) if old
            else (True, *flags[:2]),
            "GetEventIndicators": (room, INDICATORS),
            "GetNumberOfContinuousStates": (byref(c_size_t()),),
            "GetNumberOfEventIndicators": (byref(c_size_t()),),
            **dict.fromkeys(("GetReal", "SetReal"), inputs),
            **dict.fromkeys(("GetFloat64", "SetFloat64"), (*inputs, 1)),
            **dict.fromkeys(
                ("GetInteger", "GetInt32"), (byref(c_uint(places["mode"])), 1, whole, *count)
            ),
            **dict.fromkeys(
                ("SetInteger", "SetInt32"), (byref(c_uint(places["rig.free_y"])), 1, whole, *count)
            ),
            "GetOutputDerivatives": (None, 0, None, None, 0),
            **dict.fromkeys((*of_states, "GetDerivatives"), numbers),
            "GetContinuousStateDerivatives": numbers,
        }  # fmt: skip
        return given.get(function, ()), reached

    def come_to(self, wanted):
        """The shortest way there."""
        on_the_way = ["EnterInitializationMode", "ExitInitializationMode"]
        ways = {NEW: [], INITIALISING: on_the_way[:1], FAILED: on_the_way[1:]}
        further = {
            ENDED: ["Terminate"],
            CONTINUOUS: ["EnterContinuousTimeMode"],
            STEPPING: ["EnterStepMode"] * (self.interface is CO_SIMULATION_3),
        }
        for function in ways.get(wanted, on_the_way + further.get(wanted, [])):
            self.call(function)
        assert self.known[0] == wanted


@pytest.fixture(scope="module")
def units(unit, unit3):
    return {2: unit, 3: unit3}


@pytest.mark.parametrize(("interface", "phase"), STATES, ids=said)
def test_each_phase_takes_the_calls_of_the_standard(units, interface, phase):
    for function in interface.taken:
        walk = Walk(units, interface)
        with walk.block:
            walk.come_to(phase)
            if not walk.call(function):
                reasons = (f"fmi{interface.version}{function}", "this instance", "rig.free_y is fi")
                assert walk.block.messages[0][2].startswith(reasons)


@pytest.mark.parametrize("interface", (CO_SIMULATION_3, EXCHANGE_3), ids=said)
def test_every_variable_can_be_read_and_is_a_number(units, interface):
    for phase in interface.taken["GetFloat64"]:
        walk = Walk(units, interface)
        with walk.block as block:
            walk.come_to(phase)
            for name in walk.unit.references:
                assert np.all(np.isfinite(block.get(name))), name
            numbers, last = (c_double * 3)(), walk.unit.references["time"]
            block.done("GetFloat64", (c_uint * 3)(last + 1, last + 2, last + 3), 3, numbers, 3)
            assert all(numbers)  # indicators
