"""Chunks on the cores of this machine."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from types import TracebackType
from typing import Self

import joblib

from cosim.processes import BrokenProcessPool, as_finished, is_stopped

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
        calls = [(work, chunk) for chunk in chunks]
        try:
            yield from as_finished(min(self.count, len(chunks)), _compute, calls)
        except BrokenProcessPool as error:
            raise WorkersLost(" ".join(str(error).split())) from error


def _compute(work: Work, chunk: Sequence[Task]) -> list[Row]:
    """`compute_chunk`, which ends early where a process of the pool is to stop."""
    return compute_chunk(work, chunk, is_stopped)
