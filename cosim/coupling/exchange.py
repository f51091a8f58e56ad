"""The values at the ports while a run goes on."""

import math
from collections.abc import Iterator
from contextlib import contextmanager

from cosim.coupling.connections import Connection
from cosim.coupling.errors import ParticipantError
from cosim.coupling.system import CoupledSystem


class Exchange:
    """Carries values along the connections and keeps the newest of every port.

    outputs, inputs: participant -> port -> value; of the inputs only the connected ones.
    time: start of the macro step under way in s, None during initialisation.
    """

    def __init__(self, system: CoupledSystem):
        self.system = system
        self.outputs: dict[str, dict[str, float]] = {name: {} for name in system.participants}
        self.inputs: dict[str, dict[str, float]] = {name: {} for name in system.participants}
        self.time: float | None = None
        self._feeds: dict[str, list[Connection]] = {
            name: [c for c in system.connections if c.sink.participant == name]
            for name in system.participants
        }

    @contextmanager
    def blaming(self, name: str) -> Iterator[None]:
        """Turn whatever a participant raises into a ParticipantError that names it."""
        try:
            yield
        except ParticipantError:
            raise
        except Exception as error:
            raise ParticipantError(name, self.time, _one_line(error)) from error

    def collect(self, name: str) -> None:
        """Read all outputs of a participant; every connected one must be a finite number."""
        with self.blaming(name):
            self.outputs[name] = self.system.participants[name].read()
        for connection in self.system.connections:
            source = connection.source
            if source.participant == name and not math.isfinite(self.outputs[name][source.port]):
                value = self.outputs[name][source.port]
                raise ParticipantError(name, self.time, f"output {source.port} is {value}")

    def deliver(self, name: str) -> None:
        """Write the newest values of the connected sources to the inputs of a participant."""
        values = {
            feed.sink.port: self.outputs[feed.source.participant][feed.source.port]
            for feed in self._feeds[name]
        }
        if values:
            with self.blaming(name):
                self.system.participants[name].write(values)
        self.inputs[name] = values

    def step(self, name: str, size: float) -> None:
        """Let one participant make the macro step that starts at `time`."""
        with self.blaming(name):
            self.system.participants[name].step(self.time, size)


def _one_line(error: Exception) -> str:
    text = " ".join(str(error).split())
    return text or type(error).__name__
