"""A participant that lives in a process of its own, and looks from here as if it did not.

The process is started unheard by signals, heard in all it says, ended whatever happens.
"""

import contextlib
import itertools
import math
import os
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import weakref
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from typing import Any

from cosim.coupling.isolated.child import CLOSE, DONE, MESSAGE, START, packed, waiter
from cosim.coupling.messages import KEPT, LONGEST, Messages
from cosim.coupling.participant import Closing, CouplingError, port_table
from cosim.coupling.waveform import Waveform
from cosim.interrupts import held_interrupts, unheard_by_children

#: Time (s) that Python and the imports of a participant may take, beyond the time limit of a call.
START_SECONDS = 60.0
#: Time (s) that a process has to end by itself after its last answer.
END_SECONDS = 5.0
#: Time (s) within which one that has hung up has died of it, if it has.
HUNG_UP_SECONDS = 1.0
PROGRAM = (
    "import sys; sys.path[:] = {path!r}; from cosim.coupling.isolated.child import serve; "
    "serve({handle}, {parent}, {scratch!r})"
)


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


class Process:
    """One process with one participant.

    time_limit: for every call, s. messages: what the participant says, as it comes, and behind each
    call what the process has written to its standard output and error (status "output").
    """

    def __init__(self, time_limit: float, messages: Messages) -> None:
        from stickslip.scratch import scratch_folder  # whoever couples units loads no model

        self._limit, self._messages = time_limit, messages
        self._scratch = scratch_folder("isolated")
        self._line, theirs = Pipe()
        self._wait = waiter(self._line)
        with held_interrupts(), unheard_by_children():
            self._process = _started(theirs, self._scratch.name)
        theirs.close()
        self._lines = Lines()
        heard = (self._process, self._lines)
        self._reader = threading.Thread(target=_listen, args=heard, daemon=True)
        self._reader.start()
        self._end = weakref.finalize(self, _end, self._process, self._line, self._scratch)

    @property
    def pid(self) -> int:
        """Its number."""
        return self._process.pid

    @property
    def is_over(self) -> bool:
        """Whether it can be asked no more."""
        return not self._end.alive

    def ask(
        self, told: Sequence[tuple[str, tuple[Any, ...]]], call: str, arguments: tuple[Any, ...]
    ) -> Any:
        """What a call returns there, or raises; IsolatedError where no answer comes."""
        deadline = time.monotonic() + self._limit + (START_SECONDS if call == START else 0.0)
        try:
            self._line.send_bytes(packed((told, call, arguments)))
            while True:
                if not self._wait(deadline - time.monotonic()):
                    raise TimeoutError
                kind, what = pickle.loads(self._line.recv_bytes())
                if kind != MESSAGE:
                    break
                self._messages.keep(what)
        except TimeoutError:
            self.end()
            raise IsolatedError(
                f"did not answer to the call of {call} within {self._limit:g} s, its time limit; "
                "its process was ended"
            ) from None
        except (EOFError, OSError, pickle.UnpicklingError, ValueError) as error:
            raise IsolatedError(f"{self._obituary()} in the call of {call}") from error
        except BaseException:  # an interrupt: the answer would be taken for that to the next call
            self.end()
            raise
        finally:
            self._take_lines()
        if kind == DONE:
            return what
        raise what

    def _obituary(self) -> str:
        """How it ended; it is ended where it only hung up."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(HUNG_UP_SECONDS)
        status = self._process.poll()
        self.end()
        if status is None:
            return "its process closed the line to this one"
        if status >= 0:
            return f"its process ended with status {status}"
        number = signal.Signals(-status)
        return f"its process was ended by {number.name} ({signal.strsignal(number)})"

    def close(self) -> None:
        """Let the participant close, and the process end; never raises."""
        if not self.is_over:
            with contextlib.suppress(Exception):
                self.ask((), CLOSE, ())
                self._process.wait(END_SECONDS)
        self.end()

    def end(self) -> None:
        """At once; nothing of it is left."""
        self._end()
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


def _started(theirs: Connection, scratch: str) -> subprocess.Popen[bytes]:
    handle = theirs.fileno()
    program = PROGRAM.format(path=sys.path, handle=handle, parent=os.getpid(), scratch=scratch)
    how: dict[str, Any] = {}
    if sys.platform == "win32":
        os.set_handle_inheritable(handle, True)
        how["startupinfo"] = subprocess.STARTUPINFO(lpAttributeList={"handle_list": [handle]})
    else:
        how["pass_fds"] = (handle,)
    return subprocess.Popen(
        [sys.executable, "-c", program],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        # so that this process can remove what that one leaves behind when it is killed
        env={**os.environ, "TMPDIR": scratch, "TEMP": scratch, "TMP": scratch},
        **how,
    )


def _listen(process: subprocess.Popen[bytes], lines: Lines) -> None:
    """Take what a process writes, so that it never waits for a reader; its line may never end."""
    assert process.stdout is not None
    with process.stdout as stream:
        while line := stream.readline(LONGEST):
            lines.add(line.decode("utf-8", errors="replace").rstrip())


def _end(
    process: subprocess.Popen[bytes], line: Connection, scratch: tempfile.TemporaryDirectory[str]
) -> None:
    if process.poll() is None:
        process.kill()
    process.wait()
    line.close()
    scratch.cleanup()


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
        self._told: list[tuple[str, tuple[Any, ...]]] = []
        self._states: set[State] = set()
        self._gives_states = False
        self._outputs: dict[str, float] | None = None
        self.messages: Messages = Messages("")
        self._process: Process | None = None
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
        self._process = Process(self._limit, self.messages)
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
        return process.ask(told, call, arguments)

    def _alive(self) -> Process:
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
