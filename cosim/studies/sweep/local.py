"""Chunks on the cores of this machine, by the processes of joblib's loky."""

from __future__ import annotations

import multiprocessing
import os
import signal
import threading
import time
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import Future, wait
from contextlib import contextmanager
from multiprocessing.connection import Connection
from queue import SimpleQueue
from types import TracebackType
from typing import Any, Self

import joblib
from joblib.externals.loky import BrokenProcessPool, ProcessPoolExecutor

from cosim.interrupts import REQUESTS, held_interrupts, unheard_by_children

from .chunk import Task, Work, compute_chunk
from .combination import Row
from .errors import SweepError, WorkersLost

#: A process that has not stopped after this time (s) is killed; one that was just started imports.
STOP_SECONDS = 10.0
#: How often (s) a process that has stopped looks whether the one that started it is still there.
LOOK_SECONDS = 1.0
#: Else two processes of numba or BLAS on two cores would be four.
ONE_THREAD = dict.fromkeys(
    ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS",
     "VECLIB_MAXIMUM_THREADS", "NUMBA_NUM_THREADS"), "1",
)


class LocalWorkers:
    """``jobs`` processes with one thread each; 1 is this process itself."""

    def __init__(self, jobs: int | None = None):
        if jobs is not None and jobs < 1:
            raise SweepError(f"jobs: out of range ({jobs}), allowed is a whole number from 1")
        self.count = joblib.cpu_count() if jobs is None else jobs

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """The processes end with each `run`."""

    def run(self, work: Work, chunks: Sequence[Sequence[Task]]) -> Generator[list[Row], None, None]:
        """The rows of each chunk as it is finished; WorkersLost when a process died."""
        processes = min(self.count, len(chunks))
        # a daemon, such as a process of somebody else's pool, must not have children
        if processes <= 1 or multiprocessing.current_process().daemon:
            for chunk in chunks:
                yield compute_chunk(work, chunk)
            return
        finished: SimpleQueue[Future] = SimpleQueue()
        try:
            with _pool(processes) as submit:
                with held_interrupts(), unheard_by_children():
                    for chunk in chunks:
                        submit(_compute, work, chunk).add_done_callback(finished.put)
                for _ in chunks:
                    yield finished.get().result()
        except BrokenProcessPool as error:
            raise WorkersLost(" ".join(str(error).split())) from error


@contextmanager
def _pool(processes: int) -> Iterator[Callable[..., Future]]:
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
            pool.shutdown(kill_workers=bool(late))
            heard.close()


_STOPPED = threading.Event()


def _compute(work: Work, chunk: Sequence[Task]) -> list[Row]:
    """Run in a process of the pool: `compute_chunk`, which ends early where that is to stop."""
    return compute_chunk(work, chunk, _STOPPED.is_set)


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
