"""What instances of FMI 2.0 and 3.0 have in common: how values go in and out, and states.

A participant asks of `Fmi2` and `Fmi3` the same, whichever it has.
"""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from cosim.coupling.fmu.values import Group, Kind


class Instance:
    """An instance through fmpy. A call that does not succeed raises FMICallException of fmpy, or
    FmuCallError.

    memory: what the host knows of the instance and that goes back with its state; JSON can hold it.
    kinds: type of a variable -> how it is served. arguments: how many those functions take behind
    the instance, of references, their number, values, their number.
    """

    kinds: ClassVar[Mapping[str, Kind]]
    arguments: ClassVar[int]

    def __init__(self, fmu: Any, version: str) -> None:
        """Find the functions that fmpy has for an instance: fmi2... or fmi3..."""
        self._fmu, self._component = fmu, fmu.component
        self.memory: dict[str, Any] = {}
        self.terminate, self.free = fmu.terminate, fmu.freeInstance
        functions = {kind.function for kind in self.kinds.values()}
        self._set = {name: getattr(fmu, f"{version}Set{name}") for name in functions}
        self._get = {name: getattr(fmu, f"{version}Get{name}") for name in functions}

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
