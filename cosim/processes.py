"""Processes of this machine that end in good order, however the work is left.

By joblib's loky, one thread each: two processes of numba or BLAS on two cores would else be four.
"""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, wait
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection
from queue import Empty, Queue
from typing import Any

from joblib.externals.loky import ProcessPoolExecutor

from cosim.interrupts import REQUESTS, held_interrupts, unheard_by_children

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
        "NUMBA_NUM_THREADS",
    ),
    "1",
)

#: Every call's result, in the order of the arguments.
Map = Callable[[Callable[..., Any], Iterable[tuple]], Iterator[Any]]


@contextmanager
def processes(jobs: int) -> Iterator[Map]:
    """A map over ``jobs`` processes; over this one for 1, or where it must not have children."""
    if jobs <= 1 or multiprocessing.current_process().daemon:
        yield lambda function, arguments: (function(*each) for each in arguments)
        return
    with pool(jobs) as submit:

        def mapped(function: Callable[..., Any], arguments: Iterable[tuple]) -> Iterator[Any]:
            with held_interrupts(), unheard_by_children():
                futures = [submit(function, *each) for each in arguments]
            return (future.result() for future in futures)

        yield mapped


@contextmanager
def pool(processes: int) -> Iterator[Callable[..., Future]]:
    """What submits work to processes; all of them have ended after the block, however it is left.

    Not by joblib.Parallel, whose folders for shared arrays, of no use here, are removed twice when
    it is interrupted, nor by killing processes that could end by themselves: what keeps track of
    their folders and semaphores would complain on the terminal.
    """
    futures: list[Future] = []
    heard, line = multiprocessing.Pipe(duplex=False)
    with held_interrupts():
        pool = ProcessPoolExecutor(
            processes, initializer=_listen, initargs=(heard, os.getpid()), env=ONE_THREAD
        )

    def submit(*call: Any) -> Future:
        futures.append(pool.submit(*call))
        return futures[-1]

    try:
        yield submit
    finally:
        with held_interrupts():
            line.close()  # which stops them
            for future in futures:
                future.cancel()
            late = wait(futures, timeout=STOP_SECONDS).not_done
            _forget_waiting(pool)
            pool.shutdown(kill_workers=bool(late))
            heard.close()


def _forget_waiting(pool: ProcessPoolExecutor) -> None:
    """Drop what no process has: cancelled calls make loky fail where it kills, and then hang."""
    numbers, calls = getattr(pool, "_work_ids", Queue()), getattr(pool, "_pending_work_items", {})
    with suppress(Empty):
        while True:
            calls.pop(numbers.get_nowait(), None)


_STOPPED = threading.Event()


def is_stopped() -> bool:
    """In a process of the pool: whether it is to end."""
    return _STOPPED.is_set()


def _listen(line: Connection, parent: int) -> None:
    """Begin the life of a process of the pool: it stops when the line breaks."""
    for number in REQUESTS:  # where they could not be blocked
        signal.signal(number, signal.SIG_IGN)

    def listen() -> None:
        line.poll(None)  # nothing is ever said
        _STOPPED.set()
        while os.getppid() == parent:
            time.sleep(LOOK_SECONDS)
        os._exit(1)  # the parent was killed; it would be waited for, for ever

    threading.Thread(target=listen, daemon=True).start()
