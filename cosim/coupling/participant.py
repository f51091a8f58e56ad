"""What the master asks of a participant: ports, values, a step. Any class of this shape will do."""

from collections.abc import Mapping
from typing import Protocol, runtime_checkable

from cosim.coupling.ports import Port


class Participant(Protocol):
    """A simulation that takes part in a coupled run.

    Calls come in this order: `enter_initialisation`; any number of `write` and `read`;
    `exit_initialisation`; then for each macro step `write`, `step`, `read`; at last `close`,
    also after a failure. A failure is an exception with one clear line.
    """

    name: str
    ports: Mapping[str, Port]

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

    def get_state(self) -> object:
        """Everything that the future depends on, as an opaque object."""

    def set_state(self, state: object) -> None:
        """Go back to a state that `get_state` gave; it may be used again."""

    def free_state(self, state: object) -> None:
        """The state is no longer needed."""
