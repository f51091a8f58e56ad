"""What the master asks of a participant: ports, values, a step. Any class of this shape will do.

A port is all that the master knows of what a participant takes in or gives out.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType
from typing import Any, Protocol, Self

from cosim.coupling.waveform import Waveform


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
class UnitDefinition:
    """A unit by the base units of the SI: value in them = factor * value + offset.

    exponents: of kg, m, s, A, K, mol, cd, rad.
    """

    exponents: tuple[int, ...]
    factor: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True)
class Port:
    """A scalar that crosses the border of a participant.

    name: unique within the participant; unit: its FMI 2 spelling, "1" for a plain number.
    nominal: a size that is typical of it, in its unit; what it changes by less than a small part of
    that is no change. definition: what its unit is made of, where the participant says so.
    least, most: what it may be, in its unit; a master that guesses values stays within.
    """

    name: str
    unit: str
    causality: Causality
    nominal: float = 1.0
    definition: UnitDefinition | None = None
    least: float = -math.inf
    most: float = math.inf


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
    also after a failure. A failure is an exception with one clear line. What else one can do it
    says by its `Capabilities`.
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

    def step(self, time: float, size: float) -> float | None:
        """Advance from time to time + size (s).

        Returns the time that it has come to (s) where it ended the step early, at an event of its
        own; else None.
        """

    def close(self) -> None:
        """Let go of files, libraries and memory; may be called twice."""


class TakesWaveforms(Protocol):
    """A participant that can follow its inputs through a step."""

    def write_waveforms(self, waveforms: Mapping[str, Waveform]) -> None:
        """Take some inputs over the next step as functions of time; instead of `write`."""


class Restorable(Protocol):
    """A participant that can be put back to where it was, for a step that is repeated."""

    def get_state(self) -> Any:
        """Everything that the future depends on, as an opaque object."""

    def set_state(self, state: Any) -> None:
        """Go back to a state that `get_state` gave; it may be used again."""

    def free_state(self, state: Any) -> None:
        """The state is no longer needed."""


class Saved(Protocol):
    """A participant whose state can be written to disk and read by another process."""

    def save_state(self) -> bytes:
        """Everything that the future depends on."""

    def load_state(self, saved: bytes) -> None:
        """Go on from what `save_state` gave; after `exit_initialisation`."""


@dataclass(frozen=True)
class Capabilities:
    """What a participant can do beyond the least; a participant may say so as `capabilities`.

    waveforms: it is one that `TakesWaveforms`; restores: it is `Restorable`; saves: it is `Saved`;
    ends_early: its `step` may end before the end that it was asked for. input_order: highest
    derivative of its inputs that it follows over a step, None for any.
    """

    waveforms: bool = False
    restores: bool = False
    saves: bool = False
    ends_early: bool = False
    input_order: int | None = None


def capabilities(participant: Participant) -> Capabilities:
    """What a participant says that it can do; where it says nothing, what it has methods for."""
    said = getattr(participant, "capabilities", None)
    if isinstance(said, Capabilities):
        return said
    return Capabilities(
        waveforms=hasattr(participant, "write_waveforms"),
        restores=hasattr(participant, "get_state") and hasattr(participant, "set_state"),
        saves=hasattr(participant, "save_state") and hasattr(participant, "load_state"),
    )


class Closing:
    """Closes itself behind a `with` block."""

    def close(self) -> None:
        """Let go of what is held open."""
        raise NotImplementedError

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()
