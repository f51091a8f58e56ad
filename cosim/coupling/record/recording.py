"""The rows of a coupled run, one for each recorded time."""

import json
from contextlib import suppress

import numpy as np

from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import Causality
from cosim.coupling.record.checkpoint import CheckpointError
from cosim.coupling.record.folder import RunFolder
from cosim.coupling.record.table import GrowingTable
from cosim.coupling.system import CoupledSystem
from cosim.files import OutputError, write_text

#: Rows on disk, None before there is a table, and the newest where it is none of them.
Place = tuple[int | None, list[float] | None]


class Recording:
    """All outputs and the connected inputs of a system, one row per recorded time, on disk.

    The newest row gives way to the next one where it is not kept, so that a run that ends early
    still has the point it came to; until then it is in memory. An input's row holds the value that
    the step ending there was made with.
    folder: where the rows are for everybody to read; None: in a file without a name. place: as an
    earlier process left it, to go on there in its file.
    units: `participant.port` -> unit, in the order of participants and ports.
    Raises OutputError where the disk refuses, CheckpointError where that file is another.
    """

    def __init__(
        self,
        system: CoupledSystem,
        folder: RunFolder | None = None,
        place: Place | None = None,
    ):
        participants = system.participants
        self._outputs = [
            (name, port.name)
            for name, participant in participants.items()
            for port in participant.ports.values()
            if port.causality is Causality.OUTPUT
        ]
        self._inputs = [(each.sink.participant, each.sink.port) for each in system.connections]
        channels = [*self._outputs, *self._inputs]
        self.units = {
            f"{name}.{port}": participants[name].ports[port].unit for name, port in channels
        }
        rows, self._newest = place or (None, None)
        path = None if folder is None else folder.record
        try:
            self.table = GrowingTable(1 + len(channels), path, rows=rows)
        except OutputError as error:
            if place is None:
                raise
            raise CheckpointError(f"{error}: its run cannot be resumed") from error
        if folder is not None:
            columns = [{"name": n, "unit": u} for n, u in ({"time": "s"} | self.units).items()]
            write_text(json.dumps({"columns": columns}, indent=1) + "\n", folder.columns)

    def add(self, time: float, exchange: Exchange, keep: bool = True) -> None:
        """Take the values of now as the row of a time (s); keep: on disk, for good."""
        row = [time, *(exchange.outputs[name][port] for name, port in self._outputs)]
        row += [exchange.inputs[name][port] for name, port in self._inputs]
        self._newest = None if keep else row
        if keep:
            self.table.append(row)

    @property
    def place(self) -> Place:
        """Where the rows have come to, for one that goes on from there."""
        return len(self.table), self._newest

    def end(self) -> None:
        """Nothing follows: the newest row stays, if the disk takes it."""
        if self._newest is not None:
            with suppress(OutputError):
                self.table.append(self._newest)
            self._newest = None

    @property
    def time(self) -> np.ndarray:
        """Recorded times, s, (n,)."""
        return self.table.rows()[:, 0]

    def values(self) -> dict[str, np.ndarray]:
        """`participant.port` -> (n,), read-only: memory is taken when they are looked at."""
        return dict(zip(self.units, self.table.rows().T[1:], strict=True))
