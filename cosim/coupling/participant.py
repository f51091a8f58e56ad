"""What the master asks of a participant: ports, values, a step. Any class of this shape will do.

A port is all that the master knows of what a participant takes in or gives out.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType
from typing import Any, Protocol, runtime_checkable


class CouplingError(ValueError):
    """The coupling as described cannot work: a port, a unit, a causality, an order, a step."""


class ParticipantError(RuntimeError):
    """A participant failed while it was being initialised or stepped.

    participant: its name; time: the macro step's start in s (None: before the first step).
    """

    def __init__(self, participant: str, time: float | None, message: str):
        when = "during initialisation" if time is None else f"in the step from t = {time:.9g} s"
        super().__init__(f"{participant}: failed {when}: {message}")
        self.participant = participant
        self.time = time


class Causality(StrEnum):
    """Which way a value crosses a port, seen from its participant."""

    INPUT = "input"
    OUTPUT = "output"


@dataclass(frozen=True)
class Port:
    """A scalar that crosses the border of a participant.

    name: unique within the participant; unit: its FMI 2 spelling, "1" for a plain number.
    """

    name: str
    unit: str
    causality: Causality


def inputs(**units: str) -> tuple[Port, ...]:
    """Input ports from name=unit, in the order given: `inputs(heat="J", x="m")`."""
    return tuple(Port(name, unit, Causality.INPUT) for name, unit in units.items())


def outputs(**units: str) -> tuple[Port, ...]:
    """Output ports from name=unit, in the order given."""
    return tuple(Port(name, unit, Causality.OUTPUT) for name, unit in units.items())


def port_table(ports: Iterable[Port]) -> MappingProxyType[str, Port]:
    """Name -> port, read-only, order kept; ValueError when a name comes twice."""
    table: dict[str, Port] = {}
    for port in ports:
        if port.name in table:
            raise ValueError(f"port {port.name!r} is declared twice")
        table[port.name] = port
    return MappingProxyType(table)


class Participant(Protocol):
    """A simulation that takes part in a coupled run.

    Calls come in this order: `enter_initialisation`; any number of `write` and `read`;
    `exit_initialisation`; then for each macro step `write`, `step`, `read`; at last `close`,
    also after a failure. A failure is an exception with one clear line.
    """

    @property
    def name(self) -> str:
        """Its name in the coupled system, without a dot."""

    @property
    def ports(self) -> Mapping[str, Port]:
        """Name -> port."""

    def enter_initialisation(self, start: float, stop: float) -> None:
        """Get ready for a run from start to stop (s)."""

    def exit_initialisation(self) -> None:
        """The initial exchange is done; steps follow."""

    def write(self, values: Mapping[str, float]) -> None:
        """Take new values at some of the input ports; the others keep theirs."""

    def read(self) -> dict[str, float]:
        """All outputs, as they follow from the state and the inputs now."""

    def step(self, time: float, size: float) -> None:
        """Advance from time to time + size (s), inputs held."""

    def close(self) -> None:
        """Let go of files, libraries and memory; may be called twice."""


@runtime_checkable
class Restorable(Protocol):
    """A participant that can be put back to where it was."""

    def get_state(self) -> Any:
        """Everything that the future depends on, as an opaque object."""

    def set_state(self, state: Any) -> None:
        """Go back to a state that `get_state` gave; it may be used again."""

    def free_state(self, state: Any) -> None:
        """The state is no longer needed."""
