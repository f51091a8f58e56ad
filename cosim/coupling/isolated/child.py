"""The process that an isolated participant lives in, and what the two say to each other.

A request is `(told, call, arguments)`: calls without an answer that were put off until now, each
`(call, arguments)`, then the one that is answered. Answers are `MESSAGE` as often as there is one,
then `DONE` with what the call returned or `FAILED` with what it raised. One request, one answer: a
round trip costs more than all else, so a step brings the outputs along.
"""

import os
import pickle
import shutil
import signal
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.connection import Connection
from typing import Any

from cosim.coupling.messages import Messages
from cosim.coupling.participant import capabilities
from cosim.interrupts import REQUESTS

if sys.platform != "win32":
    import select

DONE, FAILED, MESSAGE = "done", "failed", "message"
#: Calls that are answered with the outputs beside what they return.
WITH_OUTPUTS = ("exit_initialisation", "step")
#: The first call: makes the participant; its answer describes it.
START = "start"
#: The last one.
CLOSE = "close"
BEGIN = "enter_initialisation"
#: How often (s) it looks whether the process that it serves is still there, and how long it then
#: lets its participant close.
LOOK_SECONDS = 0.25


def packed(what: Any) -> bytes:
    """For the line."""
    return pickle.dumps(what, protocol=pickle.HIGHEST_PROTOCOL)


def waiter(line: Connection) -> Callable[[float], bool]:
    """A function that waits so many seconds at most, and says whether there is something to read.

    `Connection.poll` makes a selector anew each time, which is a good part of a round trip.
    """
    if sys.platform == "win32":
        return line.poll
    poll = select.poll()
    poll.register(line.fileno(), select.POLLIN)
    return lambda seconds: bool(poll.poll(1e3 * max(seconds, 0.0)))


def serve(handle: int, parent: int, scratch: str) -> None:
    """Do what is asked over a line until it ends; then end the process.

    handle: of the line. parent: process at its other end. scratch: folder for temporary files,
    which is removed where the parent cannot do it any more.
    """
    for number in REQUESTS:  # they are for the parent
        signal.signal(number, signal.SIG_IGN)
    _without_core_files()
    line = _line(handle)
    threading.Thread(target=_watch, args=(parent, scratch), daemon=True).start()
    status = 0
    try:
        Served(line).run()
    except (EOFError, OSError):
        status = 1
        shutil.rmtree(scratch, ignore_errors=True)
    with suppress(OSError, ValueError, AttributeError):  # the other end is gone; closed, or none
        sys.stdout.flush()
        sys.stderr.flush()
    os._exit(status)  # a library that is still loaded may crash where all ends in good order


def _line(handle: int) -> Connection:
    if sys.platform == "win32":
        from multiprocessing.connection import PipeConnection

        return PipeConnection(handle)
    os.set_inheritable(handle, False)
    return Connection(handle)


def _watch(parent: int, scratch: str) -> None:
    """End also in the middle of a call where the parent is gone."""
    while os.getppid() == parent:
        time.sleep(LOOK_SECONDS)
    time.sleep(LOOK_SECONDS)
    shutil.rmtree(scratch, ignore_errors=True)
    os._exit(1)


def _without_core_files() -> None:
    if sys.platform != "win32":
        import resource

        with suppress(ValueError, OSError):
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class Served:
    """Answers to requests."""

    def __init__(self, line: Connection) -> None:
        self._line = line
        self._lock = threading.Lock()  # a library may log from a thread of its own
        self._participant: Any = None
        self._states: dict[int, Any] = {}

    def run(self) -> None:
        """Until the participant is closed; EOFError or OSError where the line ends before."""
        call = None
        while call != CLOSE:
            request = self._line.recv_bytes()
            try:
                told, call, arguments = pickle.loads(request)
                for each, given in told:
                    self._do(each, given)
                kind, answer = DONE, self._do(call, arguments)
            except Exception as error:
                kind, answer = FAILED, error
                if call == CLOSE:
                    self._participant = None
            self._say(kind, answer)
        if self._participant is not None:
            self._participant.close()

    def _say(self, kind: str, what: Any) -> None:
        try:
            content = packed((kind, what)) if kind != FAILED else _failure(what)
        except Exception as error:  # nothing that a participant of this shape gives
            content = _failure(error)
        with self._lock:
            self._line.send_bytes(content)

    def _do(self, call: str, arguments: Any) -> Any:
        if call == START:
            return self._start(*arguments)
        if call == CLOSE:
            participant, self._participant = self._participant, None
            return None if participant is None else participant.close()
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
            messages.listeners.append(lambda message: self._say(MESSAGE, message))
        return participant.name, tuple(participant.ports.values()), capabilities(participant)

    # states stay here; what crosses is their number

    def _get_state(self, number: int) -> None:
        self._states[number] = self._participant.get_state()

    def _set_state(self, number: int) -> None:
        self._participant.set_state(self._states[number])

    def _free_state(self, number: int) -> None:
        self._participant.free_state(self._states.pop(number))


def _failure(error: Exception) -> bytes:
    """An exception as it is, where it crosses whole; else what it says."""
    with suppress(Exception):
        content = packed((FAILED, error))
        if str(pickle.loads(content)[1]) == str(error):
            return content
    return packed((FAILED, RuntimeError(str(error) or type(error).__name__)))
