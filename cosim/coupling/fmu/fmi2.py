"""An instance of FMI 2.0."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from ctypes import c_char_p, c_double, c_int, c_uint
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2Discard,
    fmi2False,
    fmi2LastSuccessfulTime,
    fmi2Terminated,
    fmi2True,
)
from fmpy.model_description import ModelDescription

from cosim.coupling.fmu.calls import How
from cosim.coupling.fmu.errors import FmuCallError
from cosim.coupling.fmu.values import Group, Kind, encoded, truth, whole

_INTEGER = Kind(c_int, "Integer", whole(c_int))
KINDS = {
    "Real": Kind(c_double, "Real", float),
    "Integer": _INTEGER,
    "Enumeration": _INTEGER,
    "Boolean": Kind(c_int, "Boolean", truth),
    "String": Kind(c_char_p, "String", encoded),
}


def takes_waveforms(description: ModelDescription) -> bool:
    """Whether it interpolates its inputs by their derivatives."""
    return bool(description.coSimulation.canInterpolateInputs)


class Fmi2:
    """See `cosim.coupling.fmu.calls.Calls`. A step ends where it should, or has failed."""

    def __init__(self, how: How) -> None:
        self.memory: dict[str, Any] = {}
        self._fmu = FMU2Slave(**how.arguments())
        self._fmu.instantiate(callbacks=how.log.callbacks, loggingOn=True)
        self._component = self._fmu.component
        self.enter_initialisation = self._fmu.enterInitializationMode
        self.exit_initialisation = self._fmu.exitInitializationMode
        self.get_state, self.set_state = self._fmu.getFMUstate, self._fmu.setFMUstate
        self.as_bytes, self.from_bytes = self._fmu.serializeFMUstate, self._fmu.deSerializeFMUstate
        self.free_state, self.terminate = self._fmu.freeFMUstate, self._fmu.terminate
        self.free = self._fmu.freeInstance
        functions = {kind.function for kind in KINDS.values()}
        self._set = {name: getattr(self._fmu, f"fmi2Set{name}") for name in functions}
        self._rates: dict[tuple[int, ...], tuple[Any, Any, Any]] = {}
        self._get = {name: getattr(self._fmu, f"fmi2Get{name}") for name in functions}

    def set_up(self, start: float, stop: float, tolerance: float | None) -> None:
        self._fmu.setupExperiment(tolerance=tolerance, startTime=start, stopTime=stop)

    def write(self, groups: Sequence[Group]) -> None:
        for group in groups:
            self._set[group.kind.function](
                self._component, group.references, group.count, group.values
            )

    def read(self, group: Group) -> None:
        self._get[group.kind.function](self._component, group.references, group.count, group.values)

    def write_rates(self, rates: Mapping[int, Sequence[float]]) -> None:
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
        try:
            self._fmu.fmi2DoStep(
                self._component, time, size, fmi2False if may_go_back else fmi2True
            )
        except FMICallException as error:
            if error.status != fmi2Discard:
                raise
            raise FmuCallError(f"{self._why_discarded()} [{error}]") from error
        return None

    def _why_discarded(self) -> str:
        why, reached = "cannot make the whole step", ""
        with suppress(FMICallException):
            reached = f"; it came to t = {self._fmu.getRealStatus(fmi2LastSuccessfulTime):.9g} s"
        with suppress(FMICallException):
            if self._fmu.getBooleanStatus(fmi2Terminated):
                why = "wants to end the simulation"
        return why + reached


def _orders(rates: Mapping[int, Sequence[float]]) -> tuple[Any, Any, Any]:
    """Memory of C for derivatives: references of the inputs, orders, values."""
    pairs = [(each, order) for each, some in rates.items() for order in range(1, len(some) + 1)]
    count = len(pairs)
    references = (c_uint * count)(*(each for each, _ in pairs))
    return references, (c_int * count)(*(order for _, order in pairs)), (c_double * count)()
