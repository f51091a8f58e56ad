"""Chunks on the cores of this machine, by the processes of joblib's loky."""

from __future__ import annotations

import multiprocessing
from collections.abc import Generator, Sequence
from concurrent.futures import Future
from queue import SimpleQueue
from types import TracebackType
from typing import Self

import joblib
from joblib.externals.loky import BrokenProcessPool

from cosim.interrupts import held_interrupts, unheard_by_children
from cosim.processes import is_stopped, pool

from .combination import Row, SweepError, Task, Work, WorkersLost, compute_chunk


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
            with pool(processes) as submit:
                with held_interrupts(), unheard_by_children():
                    for chunk in chunks:
                        submit(_compute, work, chunk).add_done_callback(finished.put)
                for _ in chunks:
                    yield finished.get().result()
        except BrokenProcessPool as error:
            raise WorkersLost(" ".join(str(error).split())) from error


def _compute(work: Work, chunk: Sequence[Task]) -> list[Row]:
    """Run in a process of the pool: `compute_chunk`, which ends early where that is to stop."""
    return compute_chunk(work, chunk, is_stopped)
