"""The rows of a coupled run, one for each recorded time."""

import json
from collections.abc import Sequence

import numpy as np

from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import Causality
from cosim.coupling.record.checkpoint import CheckpointError
from cosim.coupling.record.folder import RunFolder
from cosim.coupling.record.table import GrowingTable
from cosim.coupling.system import CoupledSystem
from cosim.files import OutputError, write_text


class Recording:
    """All outputs and the connected inputs of a system, one row per recorded time, on disk.

    The newest row is replaced by the next one until it is kept, so that a run that ends early
    still has the point it came to. An input's row holds the value that the step ending there was
    made with.
    folder: where the rows are for everybody to read; None: in a file without a name. place: go on
    there in the file that an earlier process has left.
    units: `participant.port` -> unit, in the order of participants and ports.
    Raises OutputError where the disk refuses, CheckpointError where that file is another.
    """

    def __init__(
        self,
        system: CoupledSystem,
        folder: RunFolder | None = None,
        place: Sequence[object] | None = None,
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
        try:
            self.table = GrowingTable(
                1 + len(channels), None if folder is None else folder.record, place=place
            )
        except OutputError as error:
            if place is None:
                raise
            raise CheckpointError(f"{error}: its run cannot be resumed") from error
        if folder is not None:
            columns = [{"name": n, "unit": u} for n, u in ({"time": "s"} | self.units).items()]
            write_text(json.dumps({"columns": columns}, indent=1) + "\n", folder.columns)

    def add(self, time: float, exchange: Exchange, keep: bool = True) -> None:
        """Write the values of now as the row of a time (s); keep: do not replace it later."""
        row = [time, *(exchange.outputs[name][port] for name, port in self._outputs)]
        row += [exchange.inputs[name][port] for name, port in self._inputs]
        self.table.append(row, keep)

    @property
    def time(self) -> np.ndarray:
        """Recorded times, s, (n,)."""
        return self.table.rows()[:, 0]

    def values(self) -> dict[str, np.ndarray]:
        """`participant.port` -> (n,), read-only: memory is taken when they are looked at."""
        return dict(zip(self.units, self.table.rows().T[1:], strict=True))
