"""Instances of FMI 2.0 and 3.0: how values go in and out, steps, events, states, and what they log.

A participant asks of `Fmi2` and `Fmi3` the same, whichever it has.
"""

import itertools
from collections.abc import Mapping, Sequence
from contextlib import suppress
from ctypes import byref
from functools import partial
from typing import Any, ClassVar

import fmpy
from fmpy import fmi2
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from fmpy.fmi3 import FMU3Slave
from fmpy.logging import addLoggerProxy
from fmpy.model_description import ModelDescription

from cosim.coupling.fmu.description import may_end_early
from cosim.coupling.fmu.errors import FmuCallError
from cosim.coupling.fmu.variables import Filled, Group
from cosim.coupling.messages import FAILURES, Messages

#: By FMI's numbers, the same in 2.0 and 3.0; the last is of 2.0 alone.
STATUSES = ("ok", "warning", "discard", "error", "fatal", "pending")

_numbers = itertools.count(1)
_logs: "dict[int, FmuLog]" = {}


class FmuLog:
    """The messages of one FMU instance.

    messages: where they are kept; those of status "ok" only with `debug`, some units log every
    call. callbacks: for FMI 2.0; log_message: for FMI 3.0.

    The logger behind all instances of FMI 2.0 is one function, since fmpy's proxy, which formats
    the variadic message in C, keeps a single one for the process; the component environment tells
    the instances apart.
    """

    def __init__(self, messages: Messages | None = None, debug: bool = False) -> None:
        self.messages = Messages("") if messages is None else messages
        self.failures: list[str] = []
        self._debug = debug
        self._number = next(_numbers)
        _logs[self._number] = self
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = _logger
        self.callbacks.allocateMemory = _allocate
        self.callbacks.freeMemory = _free
        self.callbacks.componentEnvironment = self._number
        addLoggerProxy(byref(self.callbacks))

    def log_message(
        self, environment: object, status: int, category: bytes | None, message: bytes | None
    ) -> None:
        """Keep a message, and what reports a failure (discard, error or fatal) until it is asked.

        FMI 3.0's callback, called from C, through which no exception finds its way.
        """
        word = STATUSES[status] if 0 <= status < len(STATUSES) else "error"
        if word == "ok" and not self._debug:
            return
        said = self.messages.add(word, _text(category), _text(message))
        if word in FAILURES:
            self.failures.append(said.text)

    def take_errors(self) -> str:
        """The failures reported since the last call, in one line; "" when there were none."""
        text = "; ".join(dict.fromkeys(self.failures))
        self.failures.clear()
        return text

    def close(self) -> None:
        """Stop listening."""
        _logs.pop(self._number, None)


def _text(said: bytes | None) -> str:
    return "" if said is None else said.decode("utf-8", errors="replace")


def _dispatch(
    environment: int | None,
    instance_name: bytes | None,
    status: int,
    category: bytes | None,
    message: bytes | None,
) -> None:
    log = _logs.get(environment or 0)
    if log is not None:
        log.log_message(environment, status, category, message)


# Kept for the life of the process: C code holds pointers to them.
_logger = fmi2CallbackLoggerTYPE(_dispatch)
_allocate = fmi2CallbackAllocateMemoryTYPE(fmpy.calloc)
_free = fmi2CallbackFreeMemoryTYPE(fmpy.free)


#: Rounds in which the discrete states of a unit settle at an event, and events at one time.
MOST_ROUNDS = 100
#: Parts of a step that are rounding.
SLIVER = 1e-12


class Instance:
    """An instance through fmpy. A call that does not succeed raises FMICallException of fmpy, or
    FmuCallError.

    memory: what the host knows of the instance and that goes back with its state; JSON can hold it.
    enumeration: type of an enumeration's values.
    """

    enumeration: ClassVar[str]

    def __init__(self, fmu: Any) -> None:
        self._fmu = fmu
        self.memory: dict[str, Any] = {}
        self.terminate, self.free = fmu.terminate, fmu.freeInstance

    def write(self, filled: Filled) -> None:
        """Set what the groups are filled with."""
        for group, elements in filled:
            self.put(group, elements)

    def put(self, group: Group, elements: Sequence[Any]) -> None:
        """Set a group."""
        getattr(self._fmu, f"set{group.kind}")(group.references, elements)


class Fmi2(Instance):
    """See `Instance`. A step ends where it should, or has failed."""

    enumeration = "Integer"

    def __init__(
        self, description: ModelDescription, log: FmuLog, early: bool, given: Mapping[str, str]
    ) -> None:
        fmu = FMU2Slave(**given)
        fmu.instantiate(callbacks=log.callbacks, loggingOn=True)
        super().__init__(fmu)
        self.enter_initialisation = fmu.enterInitializationMode
        self.exit_initialisation = fmu.exitInitializationMode
        self.get_state, self.set_state = fmu.getFMUstate, fmu.setFMUstate
        self.as_bytes, self.from_bytes = fmu.serializeFMUstate, fmu.deSerializeFMUstate
        self.free_state = fmu.freeFMUstate

    def set_up(self, start: float, stop: float, tolerance: float | None) -> None:
        """From start to stop, s; before anything is set: some units then forget what was."""
        self._fmu.setupExperiment(tolerance=tolerance, startTime=start, stopTime=stop)

    def read(self, group: Group) -> dict[str, Any]:
        """Name -> value of a group."""
        return group.named(getattr(self._fmu, f"get{group.kind}")(group.references))

    def write_rates(self, rates: Mapping[int, Sequence[float]]) -> None:
        """Reference of an input -> its first, second, ... derivative, for the next step."""
        told = [(each, k, rate) for each, some in rates.items() for k, rate in enumerate(some, 1)]
        if told:
            self._fmu.setRealInputDerivatives(*zip(*told, strict=True))

    def step(self, time: float, size: float, may_go_back: bool) -> float | None:
        """Time reached where that is not time + size, s. may_go_back: a state may be set later."""
        try:
            self._fmu.doStep(time, size, fmi2.fmi2False if may_go_back else fmi2.fmi2True)
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


class Fmi3(Instance):
    """See `Instance`. Its steps may end early, its events are handled where it has any.

    memory: `next_event`, s, that the unit has announced, None for none; `discrete`, the newest
    values of discrete inputs.
    """

    enumeration = "Int64"

    def __init__(
        self, description: ModelDescription, log: FmuLog, early: bool, given: Mapping[str, str]
    ) -> None:
        self._stepping = False
        self._events = early and bool(description.coSimulation.hasEventMode)
        fmu = FMU3Slave(**given)
        how = {
            "loggingOn": True,
            "earlyReturnAllowed": early and may_end_early(description),
            "logMessage": log.log_message,
        }
        self._early = how["earlyReturnAllowed"]
        try:
            fmu.instantiate(eventModeUsed=self._events, **how)
        except Exception:  # fmpy's
            if not self._events:
                raise
            # there are units that declare an event mode and have none (Roberts, of the
            # Reference-FMUs)
            self._events = False
            log.take_errors()
            fmu.instantiate(eventModeUsed=False, **how)
        super().__init__(fmu)
        self.memory = {"next_event": None, "discrete": {}}
        self.get_state, self.set_state = fmu.getFMUState, fmu.setFMUState
        self.as_bytes, self.from_bytes = fmu.serializeFMUState, fmu.deserializeFMUState
        self.free_state = fmu.freeFMUState

    def set_up(self, start: float, stop: float, tolerance: float | None) -> None:
        """From start to stop, s."""
        experiment = {"tolerance": tolerance, "startTime": start, "stopTime": stop}
        self.enter_initialisation = partial(self._fmu.enterInitializationMode, **experiment)
        self.exit_initialisation = self._begin_stepping

    def _begin_stepping(self) -> None:
        self._fmu.exitInitializationMode()
        self._stepping = True
        if self._events:  # which the unit then is at
            self._end_event()

    def read(self, group: Group) -> dict[str, Any]:
        """Name -> value of a group."""
        found = getattr(self._fmu, f"get{group.kind}")(group.references, group.size)
        return group.named(found)

    def write(self, filled: Filled) -> None:
        if not (self._stepping and self._events):
            super().write(filled)
            return
        changed: Filled = []
        for group, elements in filled:
            if not group.discrete:
                self.put(group, elements)
            elif group.named(elements).items() - self.memory["discrete"].items():
                changed.append((group, elements))
        if changed:  # discrete inputs may change at an event only: that is one
            self._fmu.enterEventMode()
            super().write(changed)
            self._end_event()

    def put(self, group: Group, elements: Sequence[Any]) -> None:
        super().put(group, elements)
        if group.discrete and self._events:
            self.memory["discrete"].update(group.named(elements))

    def write_rates(self, rates: object) -> None:
        """There are none in FMI 3.0."""

    def step(self, time: float, size: float, may_go_back: bool) -> float | None:
        """Time reached where that is not time + size, s. may_go_back: a state may be set later."""
        end = time + size
        for _ in range(MOST_ROUNDS):
            reached = self._once(time, size, may_go_back)
            if abs(reached - end) <= SLIVER * max(abs(end), size):
                return None
            if reached > time:
                return reached
        raise FmuCallError(f"does not come beyond t = {time:.9g} s: {MOST_ROUNDS} events there")

    def _once(self, time: float, size: float, may_go_back: bool) -> float:
        """One call, no further than the event that the unit has announced; time reached."""
        event_at = self.memory["next_event"]
        if event_at is not None and time < event_at < time + size:
            size = event_at - time
        event, ends, early, last = self._fmu.doStep(time, size, not may_go_back)
        reached: float = last if early else time + size
        if early and not self._early:
            raise FmuCallError(f"ended its step early at t = {reached:.9g} s, which it may not")
        if ends:
            raise FmuCallError(f"wants to end the simulation, at t = {reached:.9g} s")
        if self._events and (event or (event_at is not None and reached >= event_at)):
            self._fmu.enterEventMode()
            self._end_event()
        return reached

    def _end_event(self) -> None:
        """Let the discrete states settle, and go on with steps."""
        for _ in range(MOST_ROUNDS):
            more, ends, _, _, announced, event_at = self._fmu.updateDiscreteStates()
            if ends:
                raise FmuCallError("wants to end the simulation, at an event")
            if not more:
                self.memory["next_event"] = event_at if announced else None
                self._fmu.enterStepMode()
                return
        raise FmuCallError(f"its discrete states do not settle in {MOST_ROUNDS} rounds")
