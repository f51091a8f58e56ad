"""What a participant asks of an instance, whichever version of FMI it is made for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from fmpy.model_description import ModelDescription

from cosim.coupling.fmu.log import FmuLog
from cosim.coupling.fmu.values import Group


@dataclass(frozen=True)
class How:
    """What an instance is made of.

    folder: where the unit is unpacked. early: whether it may end steps early.
    """

    description: ModelDescription
    folder: Path
    name: str
    log: FmuLog
    early: bool

    def arguments(self) -> dict[str, str]:
        """For fmpy's classes."""
        return {
            "guid": self.description.guid,
            "unzipDirectory": str(self.folder),
            "modelIdentifier": self.description.coSimulation.modelIdentifier,
            "instanceName": self.name,
        }


class Calls(Protocol):
    """An instance. A call that does not succeed raises fmpy's FMICallException or FmuCallError.

    memory: what the host knows of the instance and that goes back with its state; JSON can hold it.
    """

    memory: dict[str, Any]

    def set_up(self, start: float, stop: float, tolerance: float | None) -> None:
        """From start to stop, s; before anything is set: some units then forget what was."""

    def enter_initialisation(self) -> None:
        """What is constant over the run is set."""

    def exit_initialisation(self) -> None:
        """Steps follow."""

    def write(self, groups: Sequence[Group]) -> None:
        """Set what the groups hold."""

    def read(self, group: Group) -> None:
        """Fill a group."""

    def write_rates(self, rates: Mapping[int, Sequence[float]]) -> None:
        """Reference of an input -> its first, second, ... derivative, for the next step."""

    def step(self, time: float, size: float, may_go_back: bool) -> float | None:
        """Time reached where that is not time + size, s. may_go_back: a state may be set later."""

    def get_state(self) -> Any:
        """A handle."""

    def set_state(self, handle: Any) -> None:
        """Go back."""

    def free_state(self, handle: Any) -> None:
        """Forget."""

    def as_bytes(self, handle: Any) -> bytes:
        """A state for the disk."""

    def from_bytes(self, saved: bytes) -> Any:
        """A handle again."""

    def terminate(self) -> None:
        """The run is over."""

    def free(self) -> None:
        """Let go of the instance and its library."""
