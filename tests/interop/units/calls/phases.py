"""Which phase of an instance takes which call, for both versions of FMI and both interfaces.

Read off the tables of FMI 2.0.4 (3.2.3, 4.2.4) and the states of FMI 3.0 (2.3, 3.2, 4.2). What they
leave to a unit: of a failed instance it gives variables, and no rates.
"""

from typing import NamedTuple

NEW, INITIALISING, STEPPING, EVENT = "new", "initialising", "stepping", "event"
CONTINUOUS, ENDED, FAILED = "continuous", "ended", "failed"
_LETTERS = {"I": NEW, "N": INITIALISING, "S": STEPPING, "E": EVENT, "C": CONTINUOUS}
_LETTERS |= {"T": ENDED, "F": FAILED}

# name in FMI 2, name in FMI 3, phases of co-simulation, phases of model exchange
_CALLS = [
    ("SetupExperiment", None, "I", "I"),
    ("EnterInitializationMode", "EnterInitializationMode", "I", "I"),
    ("ExitInitializationMode", "ExitInitializationMode", "N", "N"),
    ("Terminate", "Terminate", "SE", "EC"),
    ("Reset", "Reset", "INSETF", "INECTF"),
    ("SetDebugLogging", "SetDebugLogging", "INSETF", "INECTF"),
    ("GetReal", "GetFloat64", "NSETF", "NECTF"),
    ("GetInteger", "GetInt32", "NSETF", "NECTF"),
    ("SetReal", "SetFloat64", "INSE", "INEC"),
    ("SetInteger", "SetInt32", "IN", "IN"),  # of this unit these are fixed parameters, all
    ("DoStep", "DoStep", "S", ""),
    ("CancelStep", None, "", ""),
    (None, "EnterStepMode", "E", ""),
    (None, "GetOutputDerivatives", "SET", ""),
    ("EnterEventMode", None, "", "EC"),
    (None, "EnterEventMode", "S", "C"),
    ("NewDiscreteStates", "UpdateDiscreteStates", "E", "E"),
    (None, "EvaluateDiscreteStates", "NE", "NE"),
    ("EnterContinuousTimeMode", "EnterContinuousTimeMode", "", "E"),
    ("CompletedIntegratorStep", "CompletedIntegratorStep", "", "C"),
    ("SetTime", None, "", "EC"),
    (None, "SetTime", "", "C"),
    ("SetContinuousStates", "SetContinuousStates", "", "C"),
    ("GetContinuousStates", "GetContinuousStates", "", "NECT"),
    ("GetDerivatives", "GetContinuousStateDerivatives", "", "NECT"),
    ("GetEventIndicators", "GetEventIndicators", "", "NECT"),
    ("GetNominalsOfContinuousStates", "GetNominalsOfContinuousStates", "", "INECT"),
    (None, "GetNumberOfContinuousStates", "", "INECT"),
    (None, "GetNumberOfEventIndicators", "", "INECT"),
]


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
            if row[self.version - 2] is not None
        }


CO_SIMULATION_2, EXCHANGE_2 = Interface(2, False), Interface(2, True)
CO_SIMULATION_3, EXCHANGE_3 = Interface(3, False), Interface(3, True)
