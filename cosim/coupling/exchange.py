"""The values at the ports: carried along the connections, and taken back with a step."""

import math
import sys
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import perf_counter
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from cosim.coupling.conversion import Affine, converted
from cosim.coupling.messages import WARNING
from cosim.coupling.participant import CouplingError, ParticipantError, Port, capabilities
from cosim.coupling.system import ENERGY_UNIT, Address, Connection, CoupledSystem
from cosim.coupling.waveform import Waveform, through

#: Times that differ by less than this part of themselves are the same.
SAME_TIME = 8 * sys.float_info.epsilon
#: The source of a connection -> what it gives over the step under way.
Course = Callable[[Address], Waveform]
#: Points that a polynomial of the highest degree here takes.
MOST_POINTS = 3
Answer = TypeVar("Answer")
#: Time in s; participant -> port -> value.
Point = tuple[float, Mapping[str, Mapping[str, float]]]


@dataclass
class Effort:
    """Of one participant: steps made, repeated ones included, and the time in them, s."""

    steps: int = 0
    seconds: float = 0.0


@dataclass
class Statistics:
    """Of a coupled run.

    participants: name -> its effort. steps: macro steps accepted; shortest, longest: their sizes,
    s; rejected: taken back by the step control; iterations: of the scheme, over all steps made;
    most_iterations: of one step; events: steps that a participant ended early; unconverged: starts
    of accepted steps whose iteration had not converged, s; above_tolerance: of those accepted at
    the smallest size with a larger error.
    """

    participants: dict[str, Effort] = field(default_factory=dict)
    steps: int = 0
    shortest: float = 0.0
    longest: float = 0.0
    rejected: int = 0
    iterations: int = 0
    most_iterations: int = 0
    events: int = 0
    unconverged: list[float] = field(default_factory=list)
    above_tolerance: list[float] = field(default_factory=list)

    def count(self, size: float) -> None:
        """A macro step of a size, s, is accepted."""
        self.steps += 1
        self.shortest, self.longest = min(size, self.shortest or size), max(size, self.longest)


class History:
    """The newest communication points: time (s), participant -> port -> value."""

    def __init__(self) -> None:
        self.points: deque[Point] = deque(maxlen=MOST_POINTS)

    def add(self, time: float, outputs: Mapping[str, Mapping[str, float]]) -> None:
        """A further point."""
        self.points.append((time, dict(outputs)))

    def forget_past(self) -> None:
        """At an event values jump or bend: what was before says nothing of what follows."""
        while len(self.points) > 1:
            self.points.popleft()

    def extrapolated(self, source: Address, degree: int, size: float) -> Waveform:
        """The polynomial of a degree through the last points, over the step that begins now.

        Of a lower degree while there are not enough points.
        """
        return through(self._of(source, degree + 1), size)

    def interpolated(self, source: Address, degree: int, size: float, end: float) -> Waveform:
        """The same with a value at the step's end in place of the oldest point."""
        if degree == 0:
            return Waveform((end,), size)
        return through([*self._of(source, degree), (size, end)], size)

    def _of(self, source: Address, count: int) -> list[tuple[float, float]]:
        now = self.points[-1][0]
        chosen = list(self.points)[-count:]
        return [(t - now, values[source.participant][source.port]) for t, values in chosen]


def held(ports: Mapping[str, Port], waves: Mapping[str, Waveform]) -> dict[str, float]:
    """What who cannot follow a waveform gets: its mean, and of joules handed over since the start,
    of which a step takes what was added, the value at the end."""
    return {
        port: wave.end if ports[port].unit == ENERGY_UNIT else wave.mean
        for port, wave in waves.items()
    }


class Stand(NamedTuple):
    """What an exchange knew at a communication point."""

    time: float | None
    outputs: Mapping[str, dict[str, float]]
    inputs: Mapping[str, dict[str, float]]
    history: Sequence[Point]


#: Where a coupled system stood: states of the participants, and the exchange.
Mark = tuple[Mapping[str, Any], Stand]


class Exchange:
    """Carries values along the connections and keeps the newest of every port.

    outputs, inputs: participant -> port -> value; of the inputs only the connected ones.
    time: start of the step under way in s, None during initialisation.
    history: outputs at the communication points that were accepted. statistics: who did how much.
    """

    def __init__(self, system: CoupledSystem):
        self.system = system
        self._participants: Mapping[str, Any] = system.participants
        self.outputs: dict[str, dict[str, float]] = {name: {} for name in system.participants}
        self.inputs: dict[str, dict[str, float]] = {name: {} for name in system.participants}
        self.time: float | None = None
        self.history: History = History()
        self.statistics: Statistics = Statistics({name: Effort() for name in system.participants})
        self._feeds: dict[str, list[tuple[Connection, Affine]]] = {n: [] for n in self.outputs}
        for feed, convert in system.conversions.items():
            self._feeds[feed.sink.participant].append((feed, convert))
        self._sources = {
            name: {each.port for each in system.sources if each.participant == name}
            for name in system.participants
        }
        self._follows = {name: capabilities(p).waveforms for name, p in self._participants.items()}

    @property
    def now(self) -> float:
        """Start of the step under way, s, where the initialisation is done."""
        if self.time is None:
            raise CouplingError("asked for a step before the initialisation is done")
        return self.time

    def asked(self, name: str, call: Callable[..., Answer], *given: Any) -> Answer:
        """What a call to a participant returns; ParticipantError, which names it, for all else."""
        try:
            return call(*given)
        except ParticipantError:
            raise
        except Exception as error:
            said = " ".join(str(error).split()) or type(error).__name__
            raise ParticipantError(name, self.time, said) from error

    def collect(self, name: str) -> None:
        """Read all outputs of a participant; every connected one must be a finite number."""
        found = self.outputs[name] = self.asked(name, self._participants[name].read)
        for port in self._sources[name]:
            if not math.isfinite(found[port]):
                raise ParticipantError(name, self.time, f"output {port} is {found[port]}")

    def deliver(self, name: str) -> None:
        """Write the newest values of the connected sources to the inputs of a participant."""
        outputs = self.outputs
        self._write(
            name,
            {
                feed.sink.port: convert(outputs[feed.source.participant][feed.source.port])
                for feed, convert in self._feeds[name]
            },
        )

    def _write(self, name: str, values: dict[str, float]) -> None:
        if values:
            self.asked(name, self._participants[name].write, values)
        self.inputs[name] = values

    def refresh(self, name: str) -> None:
        """Let the outputs of a participant follow from the newest values of its sources.

        What it stepped with stays on record.
        """
        stepped_with = self.inputs[name]
        self.deliver(name)
        self.inputs[name] = stepped_with
        self.collect(name)

    def values(self, which: Iterable[Address]) -> NDArray[np.float64]:
        """The newest of some outputs, (n,)."""
        return np.array([self.outputs[each.participant][each.port] for each in which], float)

    def extrapolated(self, source: Address, degree: int, size: float) -> Waveform:
        """What a connected output may be over the step that begins, from the points before it.

        Joules handed over since the start are held: what has not been made cannot be handed over,
        and what was handed over in advance would have to be taken back.
        """
        port = self.system.participants[source.participant].ports[source.port]
        return self.history.extrapolated(source, 0 if port.unit == ENERGY_UNIT else degree, size)

    def deliver_over_step(self, name: str, course: Course) -> None:
        """Let the inputs of a participant follow their sources over the step under way."""
        waves = {
            feed.sink.port: converted(convert, course(feed.source))
            for feed, convert in self._feeds[name]
        }
        participant = self._participants[name]
        if not self._follows[name]:
            self._write(name, held(participant.ports, waves))
            return
        if waves:
            self.asked(name, participant.write_waveforms, waves)
        self.inputs[name] = {port: wave.end for port, wave in waves.items()}

    def step(self, name: str, size: float) -> float:
        """Let one participant make the step that starts at `time`; the size that it made, s.

        It is smaller than asked for where an event of the participant ended the step.
        """
        start = self.now
        began = perf_counter()
        reached = self.asked(name, self._participants[name].step, start, size)
        effort = self.statistics.participants[name]
        effort.steps += 1
        effort.seconds += perf_counter() - began
        end = start + size
        if reached is None or reached >= end - SAME_TIME * abs(end):
            return size
        if reached <= start:
            raise ParticipantError(name, start, f"has not advanced: it is at {reached:.9g} s")
        return float(reached - start)

    def remark(self, text: str, time: float | None, category: str = "steps") -> None:
        """Something that the user of the results should know of the step from a time (s)."""
        self.system.messages.time = time
        self.system.messages.add(WARNING, category, text)

    def back(self, mark: Mark) -> None:
        """Go back to a mark, which stays good."""
        states, stand = mark
        for name, participant in self._participants.items():
            self.asked(name, participant.set_state, states[name])
        self.go_on(stand)

    @property
    def stand(self) -> Stand:
        """What it knows now."""
        points = [*self.history.points]
        return Stand(self.time, dict(self.outputs), dict(self.inputs), points)

    def go_on(self, stand: Stand) -> None:
        """From what it knew at another time."""
        self.time, self.outputs, self.inputs = stand.time, dict(stand.outputs), dict(stand.inputs)
        self.history.points = deque(stand.history, maxlen=MOST_POINTS)

    @contextmanager
    def marked(self) -> Iterator[Mark]:
        """Remember where everything stands, to go back there; asks every participant for its state,
        and lets go of it behind the block."""
        states = {n: self.asked(n, each.get_state) for n, each in self._participants.items()}
        try:
            yield states, self.stand
        finally:
            for name, participant in self._participants.items():
                self.asked(name, participant.free_state, states[name])

    def accept(self, time: float) -> None:
        """The step is done and will not be taken back; it has come to a time (s)."""
        self.time = time
        self.history.add(time, self.outputs)
