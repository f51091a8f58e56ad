"""What is kept of a coupled run while it goes on, and what it returns, also before its end.

To every result belongs its energy ledger: what was handed over, what was taken up, what is missing.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from operator import itemgetter
from typing import TYPE_CHECKING, Literal

import numpy as np

from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import Causality
from cosim.coupling.record.checkpoint import CheckpointError
from cosim.coupling.record.folder import RunFolder
from cosim.coupling.record.table import GrowingTable, Place, write_columns
from cosim.coupling.statistics import Statistics
from cosim.coupling.system import Connection, CoupledSystem, find_port
from cosim.files import OutputError
from cosim.names import unknown_name

if TYPE_CHECKING:
    import xarray

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
        found: np.ndarray = self.handed - self.taken
        return found


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


@dataclass(frozen=True, repr=False)
class CoupledResult:
    """A coupled run up to where it came.

    time: recorded times in s, (n,). values: `participant.port` -> (n,), all outputs and the
    connected inputs. units: same keys -> unit. ledger: energy at the same times.
    status: "complete"; "interrupted" (by the user); "failed" (error holds the exception).
    reason: one line on why it is not complete, else "". wall_time: of the steps, s.
    sweeps: how many sweeps the initial exchange took. steps: macro steps accepted. statistics: of
    the participants and the scheme. remarks: what of the settings could not be checked or comes to
    something else than they say, a line each.
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
    statistics: Statistics
    remarks: tuple[str, ...] = ()

    @property
    def converged(self) -> bool:
        """Whether no step was accepted whose iteration had not converged."""
        return not self.statistics.unconverged

    def __getitem__(self, name: str) -> np.ndarray:
        """The recorded values of `participant.port`, (n,)."""
        if name not in self.values:
            raise KeyError(unknown_name("recorded variable", name, self.values))
        return self.values[name]

    def __repr__(self) -> str:
        """What it is of, in one line."""
        reached = f"{self.time[-1]:.6g} s" if self.time.size else "no time"
        ended = f" ({self.reason})" if self.reason else ""
        return (
            f"<CoupledResult, {self.status}{ended}: {reached} in {self.steps} macro steps, "
            f"{self.time.size} rows of {len(self.values)} variables>"
        )

    def to_xarray(self) -> "xarray.Dataset":
        """Every recorded variable over ``time`` (n,), by its name `participant.port`, with units;
        ``energy_residual``: that of the ledger, J."""
        import xarray  # only for who asks for it

        variables = {
            name: ("time", values, {"units": self.units[name]})
            for name, values in self.values.items()
        } | {"energy_residual": ("time", self.ledger.residual, {"units": "J"})}
        time = ("time", self.time, {"units": "s", "long_name": "time"})
        return xarray.Dataset(
            variables, {"time": time}, {"status": self.status, "reason": self.reason}
        )


class Recording:
    """All outputs and the connected inputs of a system, one row per recorded time, on disk.

    The newest row is replaced by the next one until it is kept, so that a run that ends early
    still has the point it came to. An input's row holds the value that the step ending there was
    made with.
    folder: where the rows are for everybody to read; None: in a file without a name. place: go on
    there in the file that an earlier process has left.
    names: `participant.port`, in the order of participants and ports; units: name -> unit.
    Raises OutputError where the disk refuses, CheckpointError where that file is another.
    """

    def __init__(
        self, system: CoupledSystem, folder: RunFolder | None = None, place: Place | None = None
    ):
        channels = _channels(system)
        self.units = {
            f"{name}.{port}": system.participants[name].ports[port].unit
            for name, port, _ in channels
        }
        self.names = list(self.units)
        self._readers = _readers(channels)
        columns = 1 + len(channels)
        if folder is None or place is None:
            self.table = GrowingTable(columns, None if folder is None else folder.record)
        else:
            self.table = _resumed(columns, folder, place)
        if folder is not None:
            write_columns(folder.columns, {"time": "s"} | self.units)

    def add(self, time: float, exchange: Exchange, keep: bool = True) -> None:
        """Write the values of now as the row of a time (s); keep: do not replace it later."""
        row = [time]
        outputs, inputs = exchange.outputs, exchange.inputs
        for given, name, values in self._readers:
            row += values((outputs if given else inputs)[name])
        self.table.append(row, keep)

    @property
    def time(self) -> np.ndarray:
        """Recorded times, s, (n,)."""
        return self.table.rows()[:, 0]

    def values(self) -> dict[str, np.ndarray]:
        """`participant.port` -> (n,), read-only: memory is taken when they are looked at."""
        rows = self.table.rows()
        return {name: rows[:, column] for column, name in enumerate(self.names, 1)}


def _resumed(columns: int, folder: RunFolder, place: Place) -> GrowingTable:
    try:
        return GrowingTable.resumed(columns, folder.record, place)
    except OutputError as error:
        raise CheckpointError(f"{error}: its run cannot be resumed") from error


#: Whether outputs or inputs, of whom, and what takes a row's values from them.
Reader = tuple[bool, str, Callable[[Mapping[str, float]], Sequence[float]]]


def _readers(channels: Sequence[tuple[str, str, Causality]]) -> list[Reader]:
    """One for each run of channels of a participant."""
    return [
        (causality is Causality.OUTPUT, name, _taking([port for _, port, _ in group]))
        for (name, causality), group in groupby(channels, key=lambda one: (one[0], one[2]))
    ]


def _taking(ports: Sequence[str]) -> Callable[[Mapping[str, float]], Sequence[float]]:
    if len(ports) > 1:
        return itemgetter(*ports)
    (port,) = ports  # of one name, itemgetter gives the value itself
    return lambda values: [values[port]]


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
            # what goes over this connection, where a factor splits a source among several
            system.conversions[connection].factor * _since_start(values[str(connection.source)]),
            _since_start(values[str(connection.taken)]),
        )
        for connection in system.connections
        if connection.taken is not None
    )
    return Ledger(flows, {str(address): values[str(address)] for address in system.residuals})


def _since_start(values: np.ndarray) -> np.ndarray:
    return values - values[0] if values.size else values
