"""Processes of this machine that end in good order, however the work is left.

Each is a Python of its own, which is told its calls through a pipe and ends with it. It has one
thread: two processes of BLAS on two cores would else be four.
"""

import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from itertools import starmap
from queue import SimpleQueue
from typing import Any, TypeVar

from cosim.interrupts import REQUESTS, held_interrupts, unheard_by_children

__all__ = ["BrokenProcessPool", "Map", "apart", "as_finished", "pool", "processes", "stop_if_told"]

#: A process that has not stopped after this time (s) is killed; one that was just started imports.
STOP_SECONDS = 10.0
#: One whose parent was killed has this time (s) to tidy up: nobody waits for it, or kills it.
ORPHAN_SECONDS = 0.25
ONE_THREAD = dict.fromkeys(
    (
        "OMP_NUM_THREADS",
        "OPENBLAS_NUM_THREADS",
        "MKL_NUM_THREADS",
        "BLIS_NUM_THREADS",
        "VECLIB_MAXIMUM_THREADS",
    ),
    "1",
)

Result = TypeVar("Result")
#: Every call's result, in the order of the arguments.
Map = Callable[[Callable[..., Any], Iterable[tuple[Any, ...]]], Iterator[Any]]


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

    A thread waits for each of them. Calls under way are told to end, see `stop_if_told`.
    """
    with held_interrupts():
        workers = [_Worker() for _ in range(jobs)]
        threads = ThreadPoolExecutor(jobs)
    idle: SimpleQueue[_Worker] = SimpleQueue()
    for worker in workers:
        idle.put(worker)

    def call(function: Callable[..., Any], *arguments: Any) -> Any:
        worker = idle.get()
        try:
            return worker.call(function, *arguments)
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
                worker.stop()
            until = time.monotonic() + STOP_SECONDS
            for worker in workers:
                worker.end(max(until - time.monotonic(), 0.0))
            threads.shutdown()


def apart(function: Callable[..., Result], *arguments: Any) -> Result:
    """What function(*arguments) returns or raises, from a process of its own.

    For one long call of a library, for whose end Ctrl-C would wait: here it ends the wait, and the
    process with it. ``function`` is one of a module, and all that is handed over can be pickled.
    RuntimeError where the process ended without an answer.
    """
    worker = _Worker()
    try:
        result: Result = worker.call(function, *arguments)
        return result
    finally:
        worker.end(0.0)


class _Worker:
    """One process. It never gets the signals that ask to end: they are for us."""

    def __init__(self) -> None:
        # modules are looked for as here; not in a unit, whose pythonfmu is without its libraries
        places = [place for place in sys.path if os.path.basename(place) != "resources"]
        with held_interrupts(), unheard_by_children():
            self._process = subprocess.Popen(
                [sys.executable, "-c", f"from {__name__} import _answer; _answer()"],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                env={**os.environ, **ONE_THREAD, "PYTHONPATH": os.pathsep.join(places)},
            )  # fmt: skip
        assert self._process.stdin is not None and self._process.stdout is not None  # pipes
        self._calls, self._answers = self._process.stdin, self._process.stdout

    def call(self, function: Callable[..., Any], *arguments: Any) -> Any:
        """Its result; BrokenProcessPool, a RuntimeError, where the process has ended."""
        work = pickle.dumps((function, arguments), pickle.HIGHEST_PROTOCOL)
        try:
            pickle.dump(work, self._calls, pickle.HIGHEST_PROTOCOL)
            self._calls.flush()
            done, answer = pickle.load(self._answers)
        except (EOFError, OSError, pickle.UnpicklingError):
            self.end(STOP_SECONDS)
            raise BrokenProcessPool(
                f"the process of {function.__name__} ended without an answer (status "
                f"{self._process.returncode}): was there not enough memory?"
            ) from None
        if not done:
            raise answer
        return answer

    def stop(self) -> None:
        """Ask it to end."""
        with suppress(OSError):
            self._calls.close()

    def end(self, patience: float) -> None:
        """patience : s until it is killed"""
        self.stop()
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(patience)
        self._process.kill()
        self._process.wait()
        self._answers.close()


_STOPPED = threading.Event()


def stop_if_told(time: float = 0.0) -> None:
    """Leave the work, in a process of the pool that is to end. time: of a run, which this hears."""
    if _STOPPED.is_set():
        raise KeyboardInterrupt


def _answer() -> None:
    """The whole life of a process: a call, its answer, the next."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints is no answer
    for number in REQUESTS:  # where they could not be blocked
        signal.signal(number, signal.SIG_IGN)
    calls: SimpleQueue[bytes] = SimpleQueue()
    threading.Thread(target=_listen, args=(calls,), daemon=True).start()
    answer: tuple[bool, Any]
    while call := calls.get():
        try:
            function, arguments = pickle.loads(call)
            answer = True, function(*arguments)
        except Exception as error:  # noqa: BLE001 - raised again where it is waited for
            answer = False, error
        except KeyboardInterrupt:  # told to stop
            break
        pickle.dump(answer, answers, pickle.HIGHEST_PROTOCOL)
        answers.flush()
    os._exit(0)


def _listen(calls: SimpleQueue[bytes]) -> None:
    """Take calls until the pipe breaks; by what is then under way nobody is waited for."""
    parent = os.getppid()
    with suppress(EOFError):
        while True:
            calls.put(pickle.load(sys.stdin.buffer))
    _STOPPED.set()
    calls.put(b"")
    until = time.monotonic() + STOP_SECONDS
    while os.getppid() == parent and time.monotonic() < until:
        time.sleep(ORPHAN_SECONDS)
    time.sleep(ORPHAN_SECONDS)
    os._exit(1)
