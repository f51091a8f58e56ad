"""An instance of FMI 3.0: its steps may end early, its events are handled where it has any."""

import ctypes
from collections.abc import Mapping, Sequence
from ctypes import byref, c_bool, c_char_p, c_double, c_float, c_int64
from functools import partial

from fmpy.fmi3 import FMU3Slave
from fmpy.model_description import ModelDescription

from cosim.coupling.fmu.description import may_end_early
from cosim.coupling.fmu.errors import FmuCallError
from cosim.coupling.fmu.instance import Instance
from cosim.coupling.fmu.log import FmuLog
from cosim.coupling.fmu.values import Group, Kind, encoded, truth, whole
from cosim.coupling.fmu.variables import INTEGERS

_MEMORY = {name: getattr(ctypes, f"c_{name.lower()}") for name in INTEGERS}
KINDS = {
    "Float64": Kind(c_double, "Float64", float),
    "Float32": Kind(c_float, "Float32", float),
    **{name: Kind(memory, name, whole(memory)) for name, memory in _MEMORY.items()},
    "Enumeration": Kind(c_int64, "Int64", whole(c_int64)),
    "Boolean": Kind(c_bool, "Boolean", truth),
    "String": Kind(c_char_p, "String", encoded),
}
#: Rounds in which the discrete states of a unit settle at an event, and events at one time.
MOST_ROUNDS = 100
#: Parts of a step that are rounding.
SLIVER = 1e-12


class Fmi3(Instance):
    """See `Instance`.

    memory: `next_event`, s, that the unit has announced, None for none; `discrete`, the newest
    values of discrete inputs.
    """

    kinds, arguments = KINDS, 4

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
        super().__init__(fmu, "fmi3")
        self.memory = {"next_event": None, "discrete": {}}
        self.get_state, self.set_state = fmu.getFMUState, fmu.setFMUState
        self.as_bytes, self.from_bytes = fmu.serializeFMUState, fmu.deserializeFMUState
        self.free_state = fmu.freeFMUState
        self._flags = c_bool(), c_bool(), c_bool()
        self._last = c_double()
        self._told = (*map(byref, self._flags), byref(self._last))

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

    def write(self, groups: Sequence[Group]) -> None:
        if not (self._stepping and self._events):
            super().write(groups)
            return
        changed = []
        for group in groups:
            if not group.discrete:
                self.put(group)
            elif any(self.memory["discrete"].get(k) != v for k, v in group.got().items()):
                changed.append(group)
        if changed:  # discrete inputs may change at an event only: that is one
            self._fmu.enterEventMode()
            for group in changed:
                self.put(group)
            self._end_event()

    def put(self, group: Group) -> None:
        super().put(group)
        if group.discrete and self._events:
            self.memory["discrete"].update(group.got())

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
        self._fmu.fmi3DoStep(self._component, time, size, not may_go_back, *self._told)
        event, ends, early = (flag.value for flag in self._flags)
        reached = self._last.value if early else time + size
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
