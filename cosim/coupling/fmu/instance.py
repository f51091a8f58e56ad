"""An instance of a unit: what a participant asks of it, whichever version of FMI it is made for."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, ClassVar

from fmpy.model_description import ModelDescription

from cosim.coupling.fmu.log import FmuLog
from cosim.coupling.fmu.values import Group, Kind


class Instance:
    """An instance through fmpy; what the versions of FMI have in common.

    description, log, early: of the unit, of what it says, and whether it may end steps early;
    given: to fmpy. A call that does not succeed raises fmpy's FMICallException or FmuCallError.
    memory: what the host knows of the instance and that goes back with its state; JSON can hold it.
    kinds: type of a variable -> how it is served. arguments: how many those functions take behind
    the instance, of references, their number, values, their number.
    """

    kinds: ClassVar[Mapping[str, Kind]]
    arguments: ClassVar[int]

    enter_initialisation: Callable[[], object]
    exit_initialisation: Callable[[], object]
    get_state: Callable[[], Any]
    set_state: Callable[[Any], object]
    free_state: Callable[[Any], object]
    as_bytes: Callable[[Any], bytes]
    from_bytes: Callable[[bytes], Any]
    terminate: Callable[[], object]
    free: Callable[[], object]

    def __init__(
        self, description: ModelDescription, log: FmuLog, early: bool, given: Mapping[str, str]
    ) -> None:
        raise NotImplementedError

    def _take_up(self, fmu: Any, version: str) -> None:
        """Find the functions that fmpy has for an instance: fmi2... or fmi3..."""
        self._fmu, self._component = fmu, fmu.component
        self.memory: dict[str, Any] = {}
        self.terminate, self.free = fmu.terminate, fmu.freeInstance
        functions = {kind.function for kind in self.kinds.values()}
        self._set = {name: getattr(fmu, f"{version}Set{name}") for name in functions}
        self._get = {name: getattr(fmu, f"{version}Get{name}") for name in functions}

    @staticmethod
    def takes_waveforms(description: ModelDescription) -> bool:
        """Whether a unit interpolates its inputs by their derivatives."""
        return False

    @staticmethod
    def may_end_early(description: ModelDescription) -> bool:
        """Whether a unit can end a step before its end."""
        return False

    def set_up(self, start: float, stop: float, tolerance: float | None) -> None:
        """From start to stop, s; before anything is set: some units then forget what was."""
        raise NotImplementedError

    def write(self, groups: Sequence[Group]) -> None:
        """Set what the groups hold."""
        for group in groups:
            self.put(group)

    def put(self, group: Group) -> None:
        """Set what a group holds."""
        self._set[group.kind.function](self._component, *group.memory[: self.arguments])

    def read(self, group: Group) -> None:
        """Fill a group."""
        self._get[group.kind.function](self._component, *group.memory[: self.arguments])

    def write_rates(self, rates: Mapping[int, Sequence[float]]) -> None:
        """Reference of an input -> its first, second, ... derivative, for the next step."""
        raise NotImplementedError

    def step(self, time: float, size: float, may_go_back: bool) -> float | None:
        """Time reached where that is not time + size, s. may_go_back: a state may be set later."""
        raise NotImplementedError
