"""Chunks on the cores of this machine, by joblib."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Iterator, Sequence
from functools import cache
from types import TracebackType
from typing import Self

import joblib
from joblib.externals.loky.process_executor import TerminatedWorkerError

from .chunk import Task, Work, compute_chunk
from .combination import Row
from .errors import SweepError, WorkersLost

#: How often (s) a process looks whether the one that started it is still there.
LOOK_SECONDS = 1.0


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
        """joblib keeps and ends its processes by itself."""

    def run(self, work: Work, chunks: Sequence[Sequence[Task]]) -> Iterator[list[Row]]:
        """The rows of each chunk as it is finished; WorkersLost when a process died."""
        if self.count == 1 or len(chunks) == 1:
            for chunk in chunks:
                yield compute_chunk(work, chunk)
            return
        with joblib.parallel_config("loky", n_jobs=self.count, inner_max_num_threads=1):
            parallel = joblib.Parallel(
                return_as="generator_unordered", batch_size=1, pre_dispatch="2 * n_jobs"
            )
            here = os.getpid()
            results = parallel(
                joblib.delayed(compute_in_process)(here, work, chunk) for chunk in chunks
            )
        try:
            yield from results
        except TerminatedWorkerError as error:
            raise WorkersLost(" ".join(str(error).split())) from error
        finally:
            results.close()


def compute_in_process(parent: int, work: Work, chunk: Sequence[Task]) -> list[Row]:
    """`compute_chunk` in a process that ends with its parent."""
    _end_with(parent)
    return compute_chunk(work, chunk)


@cache
def _end_with(parent: int) -> None:
    """End this process when its parent, killed, can no longer do so: joblib's wait for ever."""

    def look() -> None:
        while os.getppid() == parent:
            time.sleep(LOOK_SECONDS)
        os._exit(1)

    if os.getppid() == parent:
        threading.Thread(target=look, daemon=True).start()
