"""Processes of this machine: for calls that may crash or hang, and for many calls at once.

Each is a Python of its own at the other end of a line: calls go there with their arguments, answers
come back, and what the work there says meanwhile. It never gets the signals that ask to end: they
are for us. It ends as soon as nobody needs it any more, or this process is gone, whatever it does,
and what it has put into its folder for temporary files goes with it.
"""

import math
import os
import pickle
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import weakref
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from itertools import starmap
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from queue import SimpleQueue
from typing import Any, TypeVar

from cosim.interrupts import REQUESTS, held_interrupts, unheard_by_children

if sys.platform != "win32":
    import resource
    import select

__all__ = ["BrokenProcessPool", "Map", "apart", "as_finished", "pool", "processes"]

#: Time (s) within which one that has hung up has died of it, if it has.
HUNG_UP_SECONDS = 1.0
#: How often (s) it looks whether the process that it serves is still there, and how long it then
#: lets its work end.
LOOK_SECONDS = 0.25
#: Of many processes each has one: two of BLAS on two cores would else be four.
_BLAS = ("OMP", "OPENBLAS", "MKL", "BLIS")
ONE_THREAD = dict.fromkeys(
    (*(f"{name}_NUM_THREADS" for name in _BLAS), "VECLIB_MAXIMUM_THREADS"), "1"
)
DONE, FAILED, SAID = "done", "failed", "said"
PROGRAM = (
    "import sys; sys.path[:] = {path!r}; from cosim.processes import serve; "
    "serve({handle}, {parent}, {scratch!r})"
)
STANDARD_ERROR = 2

Result = TypeVar("Result")
#: Every call's result, in the order of the arguments.
Map = Callable[[Callable[..., Any], Iterable[tuple[Any, ...]]], Iterator[Any]]


class Ended(RuntimeError):
    """No answer comes: what became of the process."""


class OutOfTime(Ended):
    """No answer came in time; the process was ended."""


class Process:
    """One process, which does what it is asked for, call by call.

    what: in the name of its folder. output: where it writes to, what else is standard output
    included. environment: variables that it has beside ours.
    """

    def __init__(
        self, what: str, output: int = STANDARD_ERROR, environment: Mapping[str, str] | None = None
    ) -> None:
        from stickslip.scratch import scratch_folder  # whoever couples units loads no model

        self._scratch = scratch_folder(what)
        self._line, theirs = Pipe()
        self._wait = _waiter(self._line)
        with held_interrupts(), unheard_by_children():
            self._process = _started(theirs, self._scratch.name, output, environment or {})
        theirs.close()
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
        self,
        function: Callable[..., Any],
        *arguments: Any,
        limit: float = math.inf,
        heard: Callable[[Any], object] = lambda what: None,
    ) -> Any:
        """What a function of a module returns there, or raises; Ended where no answer comes.

        limit: s. heard: called with what the work there says by `say`, as it comes.
        """
        request, deadline = packed((function, arguments)), time.monotonic() + limit
        try:
            self._line.send_bytes(request)
            while True:
                if not self._wait(deadline - time.monotonic()):
                    raise OutOfTime
                kind, what = pickle.loads(self._line.recv_bytes())
                if kind != SAID:
                    break
                heard(what)
        except (EOFError, OSError, pickle.UnpicklingError, ValueError) as error:
            raise Ended(self._obituary()) from error
        except BaseException:  # an interrupt: the answer would be taken for that to the next call
            self.end()
            raise
        if kind == DONE:
            return what
        raise what

    def _obituary(self) -> str:
        """How it ended; it is ended where it only hung up."""
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(HUNG_UP_SECONDS)
        status = self._process.poll()
        self.end()
        if status is None:
            return "its process closed the line to this one"
        if status >= 0:
            return f"its process ended with status {status}"
        number = signal.Signals(-status)
        return f"its process was ended by {number.name} ({signal.strsignal(number)})"

    def kill(self) -> None:
        """At once, in the middle of a call; to be ended all the same."""
        self._process.kill()

    def end(self) -> None:
        """At once; nothing of it is left."""
        self._end()


def _started(
    theirs: Connection, scratch: str, output: int, environment: Mapping[str, str]
) -> subprocess.Popen[bytes]:
    # modules are looked for as here; not in a unit, whose pythonfmu is without its libraries
    path = [place for place in sys.path if os.path.basename(place) != "resources"]
    handle = theirs.fileno()
    program = PROGRAM.format(path=path, handle=handle, parent=os.getpid(), scratch=scratch)
    how: dict[str, Any] = {}
    if sys.platform == "win32":
        os.set_handle_inheritable(handle, True)
        how["startupinfo"] = subprocess.STARTUPINFO(lpAttributeList={"handle_list": [handle]})
    else:
        how["pass_fds"] = (handle,)
    # so that this process can remove what that one leaves behind when it is killed
    own = {"TMPDIR": scratch, "TEMP": scratch, "TMP": scratch, **environment}
    return subprocess.Popen(
        [sys.executable, "-c", program],
        stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
        env={**os.environ, **own}, **how,
    )  # fmt: skip


def _end(
    process: subprocess.Popen[bytes], line: Connection, scratch: tempfile.TemporaryDirectory[str]
) -> None:
    if process.poll() is None:
        process.kill()
    process.wait()
    line.close()
    scratch.cleanup()


def packed(what: Any) -> bytes:
    """For the line."""
    return pickle.dumps(what, protocol=pickle.HIGHEST_PROTOCOL)


def _waiter(line: Connection) -> Callable[[float], bool]:
    """A function that waits so many seconds at most, and says whether there is something to read.

    `Connection.poll` makes a selector anew each time, which is a good part of a round trip.
    """
    if sys.platform == "win32":
        return lambda seconds: line.poll(seconds if seconds < math.inf else None)
    poll = select.poll()
    poll.register(line.fileno(), select.POLLIN)
    return lambda seconds: bool(poll.poll(1e3 * max(seconds, 0.0) if seconds < math.inf else None))


# --- many calls ---


@contextmanager
def processes(jobs: int) -> Iterator[Map]:
    """A map over ``jobs`` processes; over this one for 1."""
    if jobs <= 1:
        yield starmap
        return
    with pool(jobs) as submit:

        def mapped(
            function: Callable[..., Any], arguments: Iterable[tuple[Any, ...]]
        ) -> Iterator[Any]:
            futures = [submit(function, *each) for each in arguments]
            return (future.result() for future in futures)

        yield mapped


def as_finished(
    jobs: int, function: Callable[..., Result], arguments: Sequence[tuple[Any, ...]]
) -> Generator[Result, None, None]:
    """Every call's result as soon as there is one, from ``jobs`` processes as `processes` has them.

    BrokenProcessPool where one of them died.
    """
    if jobs <= 1:
        yield from starmap(function, arguments)
        return
    finished: SimpleQueue[Future[Result]] = SimpleQueue()
    with pool(jobs) as submit:
        for each in arguments:
            submit(function, *each).add_done_callback(finished.put)
        for _ in arguments:
            yield finished.get().result()


@contextmanager
def pool(jobs: int) -> Iterator[Callable[..., Future[Any]]]:
    """What submits work to processes; all of them have ended after the block, however it is left.

    A thread waits for each of them.
    """
    with held_interrupts():
        workers = [Process("pool", environment=ONE_THREAD) for _ in range(jobs)]
        threads = ThreadPoolExecutor(jobs)
    idle: SimpleQueue[Process] = SimpleQueue()
    for worker in workers:
        idle.put(worker)

    def call(function: Callable[..., Any], *arguments: Any) -> Any:
        worker = idle.get()
        try:
            return _called(worker, function, *arguments)
        finally:
            idle.put(worker)

    def submit(*work: Any) -> Future[Any]:
        with held_interrupts():
            return threads.submit(call, *work)

    try:
        yield submit
    finally:
        with held_interrupts():
            threads.shutdown(wait=False, cancel_futures=True)
            for worker in workers:
                worker.kill()
            threads.shutdown()
            for worker in workers:
                worker.end()


def apart(function: Callable[..., Result], *arguments: Any) -> Result:
    """What function(*arguments) returns or raises, from a process of its own.

    For one long call of a library, for whose end Ctrl-C would wait: here it ends the wait, and the
    process with it. ``function`` is one of a module, and all that is handed over can be pickled.
    RuntimeError where the process ended without an answer.
    """
    worker = Process("apart", environment=ONE_THREAD)
    try:
        result: Result = _called(worker, function, *arguments)
        return result
    finally:
        worker.end()


def _called(worker: Process, function: Callable[..., Any], *arguments: Any) -> Any:
    """Its result; BrokenProcessPool, a RuntimeError, where the process has ended."""
    try:
        return worker.ask(function, *arguments)
    except Ended as error:
        raise BrokenProcessPool(
            f"the process of {function.__name__} ended without an answer ({error}): was there not "
            "enough memory?"
        ) from None


# --- in the process ---

_theirs: Connection
_sending = threading.Lock()  # a library may log from a thread of its own


def serve(handle: int, parent: int, scratch: str) -> None:
    """Do what is asked over a line until it ends; then end the process.

    handle: of the line. parent: process at its other end. scratch: folder for temporary files,
    which is removed where the parent cannot do it any more.
    """
    global _theirs
    for number in REQUESTS:  # where they could not be blocked
        signal.signal(number, signal.SIG_IGN)
    if sys.platform != "win32":
        with suppress(ValueError, OSError):  # no core files
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    _theirs = _line(handle)
    threading.Thread(target=_watch, args=(parent, scratch), daemon=True).start()
    with suppress(EOFError, OSError):
        while True:
            _send(_answer(_theirs.recv_bytes()))
    shutil.rmtree(scratch, ignore_errors=True)
    os._exit(1)  # a library that is still loaded may crash where all ends in good order


def say(what: Any) -> None:
    """Tell whoever waits for the answer."""
    _send(packed((SAID, what)))


def _send(content: bytes) -> None:
    with _sending:
        _theirs.send_bytes(content)


def _answer(request: bytes) -> bytes:
    try:
        function, arguments = pickle.loads(request)
        return packed((DONE, function(*arguments)))
    except Exception as error:
        return _failure(error)


def _failure(error: Exception) -> bytes:
    """An exception as it is, where it crosses whole; else what it says."""
    with suppress(Exception):
        content = packed((FAILED, error))
        if str(pickle.loads(content)[1]) == str(error):
            return content
    return packed((FAILED, RuntimeError(str(error) or type(error).__name__)))


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
