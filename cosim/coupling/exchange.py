"""The values at the ports: before the first step, and while a run goes on."""

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

from cosim.coupling.participant import CouplingError, ParticipantError
from cosim.coupling.system import Connection, CoupledSystem


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
        if self.time is None:
            raise CouplingError(f"{name}: asked for a step before its initialisation is done")
        with self.blaming(name):
            self.system.participants[name].step(self.time, size)


def initial_exchange(
    exchange: Exchange, order: Sequence[str], tolerance: float, max_sweeps: int
) -> int:
    """Sweep over the participants in order until no connected output changes any more.

    One sweep carries a value one participant further, so a chain of n settles in n sweeps; a
    loop with direct feedthrough is iterated to a fixed point. `tolerance` is relative to the
    value itself and only there because such an iteration ends in a flicker of the last bits.
    Returns the number of sweeps; raises CouplingError with what still changes after
    `max_sweeps`.
    """
    for name in order:
        exchange.collect(name)
    changes: dict[str, float] = {}
    for sweep in range(1, max_sweeps + 1):
        before = _connected_outputs(exchange)
        for name in order:
            exchange.deliver(name)
            exchange.collect(name)
        changes = _changes(before, _connected_outputs(exchange), tolerance)
        if not changes:
            return sweep
    worst = max(changes, key=changes.__getitem__)
    raise CouplingError(
        f"the initial exchange has not settled after {max_sweeps} sweeps: {worst} still changes "
        f"by {changes[worst]:.3g}; the loop through it amplifies, so break it or start from "
        "consistent values"
    )


def _connected_outputs(exchange: Exchange) -> dict[str, float]:
    sources = [connection.source for connection in exchange.system.connections]
    return {str(source): exchange.outputs[source.participant][source.port] for source in sources}


def _changes(
    before: dict[str, float], after: dict[str, float], tolerance: float
) -> dict[str, float]:
    """`participant.port` -> size of the change, of every output that changed."""
    return {
        port: abs(new - before[port])
        for port, new in after.items()
        if abs(new - before[port]) > tolerance * max(abs(new), abs(before[port]))
    }


def _one_line(error: Exception) -> str:
    text = " ".join(str(error).split())
    return text or type(error).__name__
