"""Processes of this machine that end in good order, however the work is left.

By joblib's loky, one thread each: two processes of BLAS on two cores would else be four.
"""

import multiprocessing
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from concurrent.futures import Future, wait
from contextlib import contextmanager, suppress
from itertools import starmap
from multiprocessing.connection import Connection
from queue import Empty, Queue, SimpleQueue
from typing import Any, TypeVar

from joblib.externals.loky import BrokenProcessPool, ProcessPoolExecutor

from cosim.interrupts import REQUESTS, held_interrupts, unheard_by_children

__all__ = [
    "BrokenProcessPool",
    "Map",
    "apart",
    "as_finished",
    "stop_if_told",
    "pool",
    "processes",
]

#: A process that has not stopped after this time (s) is killed; one that was just started imports.
STOP_SECONDS = 10.0
#: How often (s) a process that has stopped looks whether the one that started it is still there.
LOOK_SECONDS = 1.0
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
    """A map over ``jobs`` processes; over this one for 1, or where it must not have children."""
    if _alone(jobs):
        yield starmap
        return
    with pool(jobs) as submit:

        def mapped(
            function: Callable[..., Any], arguments: Iterable[tuple[Any, ...]]
        ) -> Iterator[Any]:
            with held_interrupts(), unheard_by_children():
                futures = [submit(function, *each) for each in arguments]
            return (future.result() for future in futures)

        yield mapped


def as_finished(
    jobs: int, function: Callable[..., Result], arguments: Sequence[tuple[Any, ...]]
) -> Generator[Result, None, None]:
    """Every call's result as soon as there is one, from ``jobs`` processes as `processes` has them.

    BrokenProcessPool where one of them died.
    """
    if _alone(jobs):
        for each in arguments:
            yield function(*each)
        return
    finished: SimpleQueue[Future[Result]] = SimpleQueue()
    with pool(jobs) as submit:
        with held_interrupts(), unheard_by_children():
            for each in arguments:
                submit(function, *each).add_done_callback(finished.put)
        for _ in arguments:
            yield finished.get().result()


def _alone(jobs: int) -> bool:
    """Whether this process does the work: a daemon, of somebody else's pool, has no children."""
    return jobs <= 1 or multiprocessing.current_process().daemon


@contextmanager
def pool(jobs: int) -> Iterator[Callable[..., Future[Any]]]:
    """What submits work to processes; all of them have ended after the block, however it is left.

    Not by joblib.Parallel, whose folders for shared arrays, of no use here, are removed twice when
    it is interrupted, nor by killing processes that could end by themselves: what keeps track of
    their folders and semaphores would complain on the terminal.
    """
    futures: list[Future[Any]] = []
    heard, line = multiprocessing.Pipe(duplex=False)
    with held_interrupts():
        executor = ProcessPoolExecutor(
            jobs, initializer=_listen, initargs=(heard, os.getpid()), env=ONE_THREAD
        )

    def submit(*call: Any) -> Future[Any]:
        futures.append(executor.submit(*call))
        return futures[-1]

    try:
        yield submit
    finally:
        with held_interrupts():
            line.close()  # which stops them
            for future in futures:
                future.cancel()
            late = wait(futures, timeout=STOP_SECONDS).not_done
            _forget_waiting(executor)
            executor.shutdown(kill_workers=bool(late))
            heard.close()


def _places() -> list[str]:
    """Where modules are looked for; not in a unit, whose own pythonfmu is without its libraries."""
    return [place for place in sys.path if os.path.basename(place) != "resources"]


def apart(function: Callable[..., Result], *arguments: Any) -> Result:
    """What function(*arguments) returns or raises, from a process of its own.

    For one long call of a library, for whose end Ctrl-C would wait: here it ends the wait, and the
    process with it. ``function`` is one of a module, and all that is handed over can be pickled.
    RuntimeError where the process ended without an answer.
    """
    with held_interrupts(), unheard_by_children():
        process = subprocess.Popen(
            [sys.executable, "-c", f"from {__name__} import _answer; _answer()"],
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, env={**os.environ, **ONE_THREAD,
            "PYTHONPATH": os.pathsep.join(_places())},
        )  # fmt: skip
    with process:
        assert process.stdin is not None and process.stdout is not None  # they are pipes
        try:
            pickle.dump((function, arguments), process.stdin)
            process.stdin.flush()  # and stays open: its end is that of whoever waits
            done, answer = pickle.load(process.stdout)
        except (EOFError, BrokenPipeError, pickle.UnpicklingError):
            ended = process.wait()
            raise RuntimeError(
                f"the process of {function.__name__} ended without an answer (status {ended}): was "
                "there not enough memory?"
            ) from None
        finally:
            process.kill()
    if not done:
        raise answer
    result: Result = answer
    return result


def _answer() -> None:
    """The whole life of the process of `apart`."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints is no answer
    for number in REQUESTS:
        signal.signal(number, signal.SIG_IGN)
    function, arguments = pickle.load(sys.stdin.buffer)

    def listen() -> None:
        os.read(0, 1)  # nothing more is said
        os._exit(1)

    threading.Thread(target=listen, daemon=True).start()
    try:
        answer = True, function(*arguments)
    except Exception as error:  # noqa: BLE001 - raised again where it is waited for
        answer = False, error
    pickle.dump(answer, answers, protocol=pickle.HIGHEST_PROTOCOL)
    answers.close()
    os._exit(0)


def _forget_waiting(executor: ProcessPoolExecutor) -> None:
    """Drop what no process has: cancelled calls make loky fail where it kills, and then hang.

    Two attributes of loky's that are not public; `joblib` has an upper bound for their sake.
    """
    numbers: Queue[int] = executor._work_ids
    calls: dict[int, object] = executor._pending_work_items
    with suppress(Empty):
        while True:
            calls.pop(numbers.get_nowait(), None)


_STOPPED = threading.Event()


def stop_if_told(time: float = 0.0) -> None:
    """Leave the work, in a process of the pool that is to end. time: of a run, which this hears."""
    if _STOPPED.is_set():
        raise KeyboardInterrupt


def _listen(line: Connection, parent: int) -> None:
    """Begin the life of a process of the pool: it stops when the line breaks."""
    for number in REQUESTS:  # where they could not be blocked
        signal.signal(number, signal.SIG_IGN)

    def listen() -> None:
        line.poll(None)  # nothing is ever said
        _STOPPED.set()
        _outlive_no(parent)

    threading.Thread(target=listen, daemon=True).start()


def _outlive_no(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(LOOK_SECONDS)
    os._exit(1)  # the parent was killed; it would be waited for, for ever
