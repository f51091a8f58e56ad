"""What is kept of a coupled run while it goes on, and what it returns, also before its end.

To every result belongs its energy ledger: what was handed over, what was taken up, what is missing.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import Causality
from cosim.coupling.system import Connection, CoupledSystem, find_port
from cosim.names import unknown_name

Status = Literal["complete", "interrupted", "failed"]


@dataclass(frozen=True)
class EnergyFlow:
    """The joules that crossed one connection since the run's start, at the recorded times.

    handed, taken: arrays (n,) in J, both 0 at the start.
    """

    connection: Connection
    handed: np.ndarray
    taken: np.ndarray

    @property
    def in_transit(self) -> np.ndarray:
        """Handed over and not yet taken up, J, (n,)."""
        return self.handed - self.taken


@dataclass(frozen=True)
class Ledger:
    """Energy of the whole coupled system at the recorded times.

    flows: one for each connection that carries energy.
    residuals: `participant.port` -> what the participant's own ledger is off by, J, (n,).
    """

    flows: tuple[EnergyFlow, ...]
    residuals: Mapping[str, np.ndarray]

    @property
    def residual(self) -> np.ndarray:
        """What is in transit plus what the participants are off by, J, (n,); () with no record."""
        parts = [flow.in_transit for flow in self.flows] + list(self.residuals.values())
        return np.sum(parts, axis=0) if parts else np.zeros(0)


@dataclass(frozen=True)
class CoupledResult:
    """A coupled run up to where it came.

    time: recorded times in s, (n,). values: `participant.port` -> (n,), all outputs and the
    connected inputs. units: same keys -> unit. ledger: energy at the same times.
    status: "complete"; "interrupted" (by the user); "failed" (error holds the exception).
    reason: one line on why it is not complete, else "". wall_time: of the steps, s.
    sweeps: how many sweeps the initial exchange took. steps: macro steps made.
    """

    time: np.ndarray
    values: Mapping[str, np.ndarray]
    units: Mapping[str, str]
    ledger: Ledger
    status: Status
    reason: str
    error: Exception | None
    wall_time: float
    sweeps: int
    steps: int

    def __getitem__(self, name: str) -> np.ndarray:
        """The recorded values of `participant.port`, (n,)."""
        if name not in self.values:
            raise KeyError(unknown_name("recorded variable", name, self.values))
        return self.values[name]


class Recording:
    """All outputs and the connected inputs of a system, one row per recorded time.

    The newest row is replaced by the next one until it is kept, so that a run that ends early
    still has the point it came to. An input's row holds the value that the step ending there was
    made with.
    names: `participant.port`, in the order of participants and ports; units: name -> unit.
    """

    def __init__(self, system: CoupledSystem, rows: int):
        self._channels = _channels(system)
        self.names = [f"{participant}.{port}" for participant, port, _ in self._channels]
        self.units = {
            f"{name}.{port}": system.participants[name].ports[port].unit
            for name, port, _ in self._channels
        }
        self._time = np.empty(rows)
        self._rows = np.empty((rows, len(self._channels)))
        self._kept = 0
        self._count = 0

    def add(self, time: float, exchange: Exchange, keep: bool = True) -> None:
        """Write the values of now as the row of a time (s); keep: do not replace it later."""
        row = self._kept
        self._time[row] = time
        for column, (name, port, causality) in enumerate(self._channels):
            side = exchange.outputs if causality is Causality.OUTPUT else exchange.inputs
            self._rows[row, column] = side[name][port]
        self._count = row + 1
        if keep:
            self._kept = self._count

    @property
    def time(self) -> np.ndarray:
        """Recorded times, s, (n,)."""
        return self._time[: self._count].copy()

    def values(self) -> dict[str, np.ndarray]:
        """`participant.port` -> (n,)."""
        return {
            name: self._rows[: self._count, column].copy() for column, name in enumerate(self.names)
        }


def _channels(system: CoupledSystem) -> list[tuple[str, str, Causality]]:
    channels: list[tuple[str, str, Causality]] = [
        (name, port.name, port.causality)
        for name, participant in system.participants.items()
        for port in participant.ports.values()
        if port.causality is Causality.OUTPUT
    ]
    for connection in system.connections:
        port = find_port(system.participants, connection.sink)
        channels.append((connection.sink.participant, port.name, port.causality))
    return channels


def ledger_of(system: CoupledSystem, values: Mapping[str, np.ndarray]) -> Ledger:
    """The ledger that the recorded values (`participant.port` -> (n,)) contain."""
    flows = tuple(
        EnergyFlow(
            connection,
            _since_start(values[str(connection.source)]),
            _since_start(values[str(connection.taken)]),
        )
        for connection in system.connections
        if connection.taken is not None
    )
    return Ledger(flows, {str(address): values[str(address)] for address in system.residuals})


def _since_start(values: np.ndarray) -> np.ndarray:
    return values - values[0] if values.size else values
