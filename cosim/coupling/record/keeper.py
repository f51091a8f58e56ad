"""Saves a coupled run while it goes, and puts one back to where it was saved.

Its rows, one for each recorded time, and now and then a checkpoint.
"""

import json
import time as clock
import warnings
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from cosim.coupling.exchange import Effort, Exchange, Stand, Statistics
from cosim.coupling.participant import Causality, Saved, capabilities
from cosim.coupling.record.folder import (
    Checkpoint,
    CheckpointError,
    RunFolder,
    load_checkpoint,
    require_same_setup,
    save_checkpoint,
)
from cosim.coupling.record.table import GrowingTable
from cosim.coupling.schemes import Scheme
from cosim.coupling.step_control.control import StepControl
from cosim.coupling.system import CoupledSystem
from cosim.files import OutputError, write_text
from cosim.names import listed

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


#: Of the first checkpoint, s of wall time: what is lost without one is all that a run was.
FIRST_SECONDS = 1.0


@dataclass(frozen=True)
class Keep:
    """What a run leaves on disk while it goes.

    folder: for rows and checkpoints; where it holds a checkpoint, the run goes on from that. None:
    nothing is left.
    seconds: of wall time from one checkpoint to the next, the first after a second; steps: the same
    in accepted macro steps; 0 of either: not by that. setup: key -> text or number, what makes the
    case, so that no other one goes on from its checkpoint. also: what goes on beside the
    participants, by names that none of them has.
    """

    folder: RunFolder | None
    seconds: float = 30.0
    steps: int = 0
    setup: Mapping[str, Any] = field(default_factory=dict)
    also: Mapping[str, Saved] = field(default_factory=dict)


class Keeper:
    """What becomes of the communication points: rows, thinned out, and now and then a checkpoint.

    Where `keep` has a checkpoint, all goes on from it, rows and clock too, which stood still
    meanwhile; else the exchange's time, the start, is the first row.
    control: as it has begun; details: of the run, to tell it from another, beside `keep.setup`;
    `record_every` of them: communication points for a row.
    Raises CheckpointError when the checkpoint is damaged or of another case.
    """

    def __init__(
        self,
        keep: Keep | None,
        exchange: Exchange,
        scheme: Scheme,
        control: StepControl,
        details: Mapping[str, Any],
    ):
        self._exchange, self._scheme, self._control = exchange, scheme, control
        self._every, self._counted = details["record_every"], 0
        self._keep = Keep(None, seconds=0.0) if keep is None else keep
        how = {"scheme": _spelled(scheme), "control": _spelled(control)}
        self._setup = dict(self._keep.setup) | _made_of(exchange.system) | how | dict(details)
        self._steps, self._saved_at = 0, clock.monotonic()
        self._seconds = min(FIRST_SECONDS, self._keep.seconds)
        self._able = bool(self._keep.steps or self._keep.seconds) and _can_be_saved(exchange.system)
        self._began = clock.perf_counter()
        folder, place = self._keep.folder, None
        if folder is not None and folder.checkpoint.is_file():
            place = self._go_on(folder.checkpoint)
        self.recording = Recording(exchange.system, folder, place)
        if place is None:
            self.recording.add(float(exchange.time or 0.0), exchange)

    def _go_on(self, path: Path) -> Place:
        """Put all back to the newest checkpoint; where the rows on disk had come to then."""
        checkpoint = load_checkpoint(path)
        require_same_setup(path, checkpoint, self._setup)
        try:
            for name, state in checkpoint.states.items():
                self._whose(name).load_state(state)
        except Exception as error:
            raise CheckpointError(f"{path}: {name} does not go on from it: {error}") from error
        master = checkpoint.master
        _restore(self._exchange, **master["exchange"])
        self._control.restore(master["control"])
        self._scheme.restore(master["scheme"])
        self._counted = master["rows"]
        self._began = clock.perf_counter() - master["seconds"]
        return checkpoint.record["rows"], checkpoint.record["newest"]

    def add(self, time: float, is_row: bool) -> None:
        """A step was accepted and has come to a time (s)."""
        self._counted += is_row
        keep = is_row and self._counted % self._every == 0
        self.recording.add(time, self._exchange, keep)

    def seconds(self) -> float:
        """How long the run has taken."""
        return clock.perf_counter() - self._began

    def look(self) -> None:
        """Save the run where it is time."""
        self._steps += 1
        keep = self._keep
        due = keep.steps and self._steps >= keep.steps
        if due or (keep.seconds and clock.monotonic() - self._saved_at >= self._seconds):
            self.save()

    def save(self) -> None:
        """Save the run as it stands, at an accepted communication point.

        Raises OutputError when the rows cannot come to the disk. A checkpoint that cannot be made
        is a warning: the run does without.
        """
        self._steps, self._saved_at = 0, clock.monotonic()
        self._seconds = self._keep.seconds
        if not self._able or self._keep.folder is None:
            return
        self.recording.table.sync()
        name = ""
        try:
            states = {}
            for name in (*self._exchange.system.participants, *self._keep.also):
                states[name] = self._whose(name).save_state()
            save_checkpoint(self._keep.folder.checkpoint, self._checkpoint(states))
        except OutputError as error:
            warnings.warn(f"no checkpoint: {error}; the run goes on", UserWarning, stacklevel=2)
        except Exception as error:
            self._able = False
            said = f"no more checkpoints: {name} cannot be saved: {error}; the run goes on"
            warnings.warn(said, UserWarning, stacklevel=2)

    def _whose(self, name: str) -> Saved:
        participant: Any = self._exchange.system.participants.get(name)
        return self._keep.also[name] if participant is None else participant

    def _checkpoint(self, states: Mapping[str, bytes]) -> Checkpoint:
        exchange, (rows, newest) = self._exchange, self.recording.place
        return Checkpoint(
            time=float(exchange.time or 0.0),
            setup=self._setup,
            master={
                "rows": self._counted,
                "seconds": self.seconds(),
                "exchange": exchange.stand._asdict() | {"statistics": asdict(exchange.statistics)},
                "control": self._control.state(),
                "scheme": self._scheme.state(),
            },
            states=states,
            record={"rows": rows, "newest": newest},
        )


def _can_be_saved(system: CoupledSystem) -> bool:
    cannot = [name for name, each in system.participants.items() if not capabilities(each).saves]
    if cannot:
        warnings.warn(
            f"no checkpoints: {listed(cannot)} cannot be saved; should this run be cut off, its "
            "rows are on disk, and it can only be begun anew",
            UserWarning,
            stacklevel=2,
        )
    return not cannot


def _made_of(system: CoupledSystem) -> dict[str, Any]:
    """What tells a coupled system from another one."""
    ports = {
        f"ports of {name}": [f"{p.name} [{p.unit}] {p.causality}" for p in each.ports.values()]
        for name, each in system.participants.items()
    }
    return ports | {"connections": [str(connection) for connection in system.connections]}


def _spelled(thing: object) -> str:
    """A scheme or a step control by its settings; what it remembers is not for others to see."""
    if not hasattr(thing, "__dict__"):
        return repr(thing)
    settings = {key: value for key, value in vars(thing).items() if not key.startswith("_")}
    told = ", ".join(f"{key}={_spelled(value)}" for key, value in settings.items())
    return f"{type(thing).__name__}({told})"


def _restore(exchange: Exchange, statistics: dict[str, Any], **stand: Any) -> None:
    exchange.go_on(Stand(**stand))
    efforts = {name: Effort(**each) for name, each in statistics["participants"].items()}
    exchange.statistics = Statistics(**(statistics | {"participants": efforts}))
