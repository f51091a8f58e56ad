"""The other process: started unheard by signals, heard in all it says, ended whatever happens."""

import contextlib
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
from collections.abc import Sequence
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from typing import Any

from cosim.coupling.isolated.child import CLOSE, DONE, MESSAGE, START, packed, waiter
from cosim.coupling.messages import KEPT, LONGEST, Messages
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
