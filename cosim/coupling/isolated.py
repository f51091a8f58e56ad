"""Participants in processes of their own: where one crashes or hangs, a call has failed here.

`Served` and `carry_out` are what happens in the process, `IsolatedParticipant` looks from here as
if there were none; all that the process says and writes is heard. A request has calls without an
answer that were put off until now, each `(call, arguments)`, then the one that is answered: a round
trip costs more than all else, so a step brings the outputs along.
"""

import contextlib
import itertools
import math
import pickle
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from cosim.coupling.messages import KEPT, LONGEST, Messages
from cosim.coupling.participant import Closing, CouplingError, capabilities, port_table
from cosim.coupling.waveform import Waveform
from cosim.processes import Ended, OutOfTime, Process, packed, say

#: Calls that are answered with the outputs beside what they return.
WITH_OUTPUTS = ("exit_initialisation", "step")
#: The first call: makes the participant; its answer describes it. And the last one.
START, CLOSE = "start", "close"
BEGIN = "enter_initialisation"
#: A call that is put off, and its arguments.
Told = tuple[str, tuple[Any, ...]]


class Served:
    """The participant, and its states: what crosses of these is their number."""

    def __init__(self) -> None:
        self._participant: Any = None
        self._states: dict[int, Any] = {}

    def do(self, call: str, arguments: tuple[Any, ...]) -> Any:
        """What a call returns."""
        own: Callable[..., Any] | None = getattr(self, f"_{call}", None)
        if own is not None:
            return own(*arguments)
        if call == BEGIN:
            self._states.clear()  # of the run before
        returned = getattr(self._participant, call)(*arguments)
        return (returned, self._participant.read()) if call in WITH_OUTPUTS else returned

    def _start(
        self, factory: Callable[..., Any], given: tuple[Any, ...], named: dict[str, Any]
    ) -> Any:
        participant = self._participant = factory(*given, **named)
        messages = getattr(participant, "messages", None)
        if isinstance(messages, Messages):
            messages.listeners.append(say)
        return participant.name, tuple(participant.ports.values()), capabilities(participant)

    def _close(self) -> None:
        if self._participant is not None:
            self._participant.close()
        sys.stdout.flush()

    def _get_state(self, number: int) -> None:
        self._states[number] = self._participant.get_state()

    def _set_state(self, number: int) -> None:
        self._participant.set_state(self._states[number])

    def _free_state(self, number: int) -> None:
        self._participant.free_state(self._states.pop(number))


_served = Served()


def carry_out(told: Sequence[Told], call: str, arguments: tuple[Any, ...]) -> Any:
    """What was put off, then the call that is answered."""
    for each, given in told:
        _served.do(each, given)
    return _served.do(call, arguments)


#: Time (s) that Python and the imports of a participant may take, beyond the time limit of a call.
START_SECONDS = 60.0
#: Time (s) within which all that an ended process has written has been read.
END_SECONDS = 5.0


class IsolatedError(RuntimeError):
    """The process of a participant crashed, hung, or was ended from outside."""


class Lines:
    """What a process has written and nobody has taken yet: the newest, and how many more."""

    def __init__(self) -> None:
        self.newest: deque[str] = deque(maxlen=KEPT)
        self.dropped = 0

    def add(self, line: str) -> None:
        self.dropped += len(self.newest) == KEPT
        self.newest.append(line)


class ItsProcess(Process):
    """One process with one participant.

    time_limit: for every call, s. messages: what the participant says, as it comes, and behind each
    call what the process has written to its standard output and error (status "output").
    """

    def __init__(self, time_limit: float, messages: Messages) -> None:
        super().__init__("isolated", subprocess.PIPE)
        self._limit, self._messages, self._lines = time_limit, messages, Lines()
        heard = (self._process, self._lines)
        self._reader = threading.Thread(target=_listen, args=heard, daemon=True)
        self._reader.start()

    def call(self, told: Sequence[Told], call: str, arguments: tuple[Any, ...]) -> Any:
        """What a call returns there, or raises; IsolatedError where no answer comes."""
        limit = self._limit + (START_SECONDS if call == START else 0.0)
        try:
            return self.ask(
                carry_out, told, call, arguments, limit=limit, heard=self._messages.keep
            )
        except OutOfTime:
            raise IsolatedError(
                f"did not answer to the call of {call} within {self._limit:g} s, its time limit; "
                "its process was ended"
            ) from None
        except Ended as error:
            raise IsolatedError(f"{error} in the call of {call}") from error
        finally:
            self._take_lines()

    def close(self) -> None:
        """Let the participant close, and the process end; never raises."""
        if not self.is_over:
            with contextlib.suppress(Exception):
                self.call((), CLOSE, ())
        self.end()

    def end(self) -> None:
        """At once; nothing of it is left."""
        super().end()
        self._reader.join(END_SECONDS)
        self._take_lines()

    def _take_lines(self) -> None:
        """What the process has written becomes messages."""
        lines = self._lines
        for _ in range(len(lines.newest)):  # more may come meanwhile
            if line := lines.newest.popleft():
                self._messages.add("output", "", line)
        self._messages.dropped += lines.dropped
        lines.dropped = 0


def _listen(process: subprocess.Popen[bytes], lines: Lines) -> None:
    """Take what a process writes, so that it never waits for a reader; its line may never end."""
    assert process.stdout is not None
    with process.stdout as stream:
        while line := stream.readline(LONGEST):
            lines.add(line.decode("utf-8", errors="replace").rstrip())


#: Calls without an answer that wait for the next with one; no more than these.
MOST_TOLD = 64
_numbers = itertools.count(1)


#: A state lies in the process that it was made in, under a number.
State = int


class IsolatedParticipant(Closing):
    """Any participant, made and run in a process of its own.

    factory: what makes it there, of `arguments` and `named`: a class or function that can be
    imported. time_limit: for every call, s; a call that takes longer has failed.
    messages: what the participant said, if it keeps `messages`, and what its process wrote to the
    terminal (status "output").

    What fails is one call, with IsolatedError: nothing of this process is harmed.
    `enter_initialisation` starts afresh after it, in a new process.

    Inputs, and what is to be done with states, are handed over with the next call that has an
    answer, and are refused there if at all; outputs come with the answer to a step. So a macro
    step is one round trip.

    A unit: `IsolatedParticipant(FmuParticipant, "motor.fmu", "motor", time_limit=5.0)`.
    """

    def __init__(
        self, factory: Callable[..., Any], *arguments: Any, time_limit: float = 60.0, **named: Any
    ):
        if not (math.isfinite(time_limit) and time_limit > 0.0):
            raise CouplingError(f"time_limit = {time_limit:g} s: must be greater than 0, finite")
        self._made_by = _checked(factory, arguments, named)
        self._limit = time_limit
        self._told: list[Told] = []
        self._states: set[State] = set()
        self._gives_states = False
        self._outputs: dict[str, float] | None = None
        self.messages: Messages = Messages("")
        self._process: ItsProcess | None = None
        self.name, ports, self.capabilities = self._begin()
        self.messages.source = self.name
        self.ports = port_table(ports)

    @property
    def pid(self) -> int | None:
        """Number of the process; None where there is none."""
        return None if self._process is None or self._process.is_over else self._process.pid

    def enter_initialisation(self, start: float, stop: float) -> None:
        """As the participant does it; in a new process where there is none any more."""
        self._forget()
        self.messages.time = None
        if self.pid is None:
            self._begin()
        self._ask("enter_initialisation", start, stop)

    def exit_initialisation(self) -> None:
        """As the participant does it."""
        _, self._outputs = self._ask("exit_initialisation")

    def write(self, values: Mapping[str, float]) -> None:
        """Hand over inputs, with the next call that has an answer."""
        self._tell("write", dict(values))

    def write_waveforms(self, waveforms: Mapping[str, Waveform]) -> None:
        """Hand over inputs over the next step."""
        self._tell("write_waveforms", dict(waveforms))

    def read(self) -> dict[str, float]:
        """All outputs."""
        if self._outputs is None:
            self._outputs = self._ask("read")
        return dict(self._outputs)

    def step(self, time: float, size: float) -> float | None:
        """One step from time, of length size (s)."""
        self.messages.time = time
        self._outputs = None
        reached, self._outputs = self._ask("step", time, size)
        found: float | None = reached
        return found

    def get_state(self) -> State:
        """A state; it stays in the process, which takes it before it does anything else.

        The first of a run has an answer, so that who cannot take one says so here.
        """
        self._alive()
        state = next(_numbers)
        if self._gives_states:
            self._told.append(("get_state", (state,)))
        else:
            self._ask("get_state", state)
            self._gives_states = True
        self._states.add(state)
        return state

    def set_state(self, state: State) -> None:
        """Go back to a state."""
        self._check_own(state)
        self._tell("set_state", state)

    def free_state(self, state: State) -> None:
        """Release a state."""
        self._check_own(state)
        self._states.remove(state)
        self._told.append(("free_state", (state,)))
        if len(self._told) > MOST_TOLD:
            self._outputs = self._ask("read")

    def save_state(self) -> bytes:
        """Everything that the future depends on."""
        found: bytes = self._ask("save_state")
        return found

    def load_state(self, saved: bytes) -> None:
        """Go on from what `save_state` gave."""
        self._outputs = None
        self._ask("load_state", saved)

    def close(self) -> None:
        """Close the participant and end its process; never raises."""
        if self._process is not None:
            self._process.close()
            self._process = None
        self._forget()

    def _forget(self) -> None:
        """What belongs to a run that is over."""
        self._told.clear()
        self._states.clear()
        self._gives_states = False
        self._outputs = None

    def _begin(self) -> Any:
        """A new process with the participant in it."""
        self.close()
        self._process = ItsProcess(self._limit, self.messages)
        try:
            return self._ask(START, *self._made_by)
        except BaseException:
            self.close()
            raise

    def _tell(self, call: str, *arguments: Any) -> None:
        self._alive()
        self._told.append((call, arguments))
        self._outputs = None

    def _ask(self, call: str, *arguments: Any) -> Any:
        process = self._alive()
        told, self._told = self._told, []
        return process.call(told, call, arguments)

    def _alive(self) -> ItsProcess:
        if self._process is None or self._process.is_over:
            raise IsolatedError("its process has ended")
        return self._process

    def _check_own(self, state: State) -> None:
        if state not in self._states:
            raise IsolatedError("is given a state that is not its own, or not any more")


def _checked(
    factory: Callable[..., Any], given: tuple[Any, ...], named: dict[str, Any]
) -> tuple[Any, ...]:
    """What another process is to make a participant of; CouplingError where it cannot cross."""
    label = getattr(factory, "__qualname__", repr(factory))
    if getattr(factory, "__module__", None) == "__main__":
        raise CouplingError(
            f"{label}: is defined in the script that runs; what makes a participant in a process "
            "of its own must be importable from a module"
        )
    try:
        packed((factory, given, named))
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise CouplingError(f"{label}: cannot be handed to another process: {error}") from error
    return factory, given, named
