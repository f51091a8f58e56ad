"""An instance of FMI 2.0."""

from collections.abc import Mapping, Sequence
from contextlib import suppress
from ctypes import c_char_p, c_double, c_int, c_uint
from typing import Any

from fmpy import fmi2
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.model_description import ModelDescription

from cosim.coupling.fmu.errors import FmuCallError
from cosim.coupling.fmu.instance import Instance
from cosim.coupling.fmu.log import FmuLog
from cosim.coupling.fmu.values import Kind, encoded, truth, whole

_INTEGER = Kind(c_int, "Integer", whole(c_int))
KINDS = {
    "Real": Kind(c_double, "Real", float),
    "Integer": _INTEGER,
    "Enumeration": _INTEGER,
    "Boolean": Kind(c_int, "Boolean", truth),
    "String": Kind(c_char_p, "String", encoded),
}


class Fmi2(Instance):
    """See `Instance`. A step ends where it should, or has failed."""

    kinds, arguments = KINDS, 3

    def __init__(
        self, description: ModelDescription, log: FmuLog, early: bool, given: Mapping[str, str]
    ) -> None:
        fmu = FMU2Slave(**given)
        fmu.instantiate(callbacks=log.callbacks, loggingOn=True)
        super().__init__(fmu, "fmi2")
        self.enter_initialisation = fmu.enterInitializationMode
        self.exit_initialisation = fmu.exitInitializationMode
        self.get_state, self.set_state = fmu.getFMUstate, fmu.setFMUstate
        self.as_bytes, self.from_bytes = fmu.serializeFMUstate, fmu.deSerializeFMUstate
        self.free_state = fmu.freeFMUstate
        self._rates: dict[tuple[int, ...], tuple[Any, Any, Any]] = {}

    def set_up(self, start: float, stop: float, tolerance: float | None) -> None:
        """From start to stop, s; before anything is set: some units then forget what was."""
        self._fmu.setupExperiment(tolerance=tolerance, startTime=start, stopTime=stop)

    def write_rates(self, rates: Mapping[int, Sequence[float]]) -> None:
        """Reference of an input -> its first, second, ... derivative, for the next step."""
        values = [value for each in rates.values() for value in each]
        if not values:
            return
        inputs = tuple(rates)
        plan = self._rates.get(inputs)
        if plan is None or len(plan[-1]) != len(values):
            plan = self._rates[inputs] = _orders(rates)
        references, orders, memory = plan
        memory[:] = values
        self._fmu.fmi2SetRealInputDerivatives(
            self._component, references, len(values), orders, memory
        )

    def step(self, time: float, size: float, may_go_back: bool) -> float | None:
        """Time reached where that is not time + size, s. may_go_back: a state may be set later."""
        try:
            keeps = fmi2.fmi2False if may_go_back else fmi2.fmi2True
            self._fmu.fmi2DoStep(self._component, time, size, keeps)
        except FMICallException as error:
            if error.status != fmi2.fmi2Discard:
                raise
            raise FmuCallError(f"{self._why_discarded()} [{error}]") from error
        return None

    def _why_discarded(self) -> str:
        why, reached = "cannot make the whole step", ""
        with suppress(FMICallException):
            reached = (
                f"; it came to t = {self._fmu.getRealStatus(fmi2.fmi2LastSuccessfulTime):.9g} s"
            )
        with suppress(FMICallException):
            if self._fmu.getBooleanStatus(fmi2.fmi2Terminated):
                why = "wants to end the simulation"
        return why + reached


def _orders(rates: Mapping[int, Sequence[float]]) -> tuple[Any, Any, Any]:
    """Memory of C for derivatives: references of the inputs, orders, values."""
    pairs = [(each, order) for each, some in rates.items() for order in range(1, len(some) + 1)]
    count = len(pairs)
    references = (c_uint * count)(*(each for each, _ in pairs))
    return references, (c_int * count)(*(order for _, order in pairs)), (c_double * count)()
