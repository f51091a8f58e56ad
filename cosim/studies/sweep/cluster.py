"""Chunks on the workers of a Dask cluster."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from contextlib import contextmanager
from types import TracebackType
from typing import Self

from .combination import Row, SweepError, SweepStopped, Task, Work, WorkersLost, compute_chunk

#: A scheduler that does not answer in this time (s) is not there; a far one needs a few.
CONNECT_SECONDS = 10.0


@contextmanager
def _connected() -> Iterator[None]:
    """SweepStopped for what breaks when the scheduler is gone."""
    from distributed import CancelledError

    try:
        yield
    except (OSError, CancelledError) as error:
        said = " ".join(str(error).split())
        raise SweepStopped(f"the connection to the Dask scheduler broke: {said}") from error


class DaskWorkers:
    """The workers behind a scheduler's address; one chunk at a time on each of their threads.

    A chunk whose worker dies is handed to another one by the scheduler.
    """

    def __init__(self, address: str):
        try:
            from distributed import Client
        except ImportError as error:
            raise SweepError(
                f"dask: {error.name or 'distributed'} is not installed, "
                "allowed after pip install 'stickslip[dask]'"
            ) from error
        try:
            self._client = Client(address, timeout=CONNECT_SECONDS, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            said = " ".join(str(error).split())
            raise SweepError(
                f"dask: no scheduler answers at {address} ({said}), allowed is an address such as "
                "tcp://127.0.0.1:8786"
            ) from error

    @property
    def count(self) -> int:
        """Threads that compute; at least one, for a cluster whose workers are yet to come."""
        with _connected():
            return max(sum(self._client.nthreads().values()), 1)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._client.close()

    def run(self, work: Work, chunks: Sequence[Sequence[Task]]) -> Generator[list[Row], None, None]:
        """The rows of each chunk as it is finished; WorkersLost when Dask gave chunks up.

        SweepStopped when the scheduler is gone. Without workers it waits for new ones.
        """
        with _connected():
            yield from self._results(work, chunks)

    def _results(self, work: Work, chunks: Sequence[Sequence[Task]]) -> Iterator[list[Row]]:
        from distributed import KilledWorker, as_completed

        # the work travels with every chunk: data scattered to workers would die with them.
        # not pure: work that is started again must not be given the futures of before
        futures = self._client.map(compute_chunk, [work] * len(chunks), chunks, pure=False)
        lost = ""
        try:
            for future in as_completed(futures, loop=self._client.loop):
                if future.status == "finished":
                    yield future.result()
                    future.release()
                elif future.status != "error":  # cancelled or lost
                    lost = "the scheduler dropped work"
                elif isinstance(error := future.exception(), (KilledWorker, OSError)):
                    lost = " ".join(str(error).split())
                else:
                    raise SweepStopped(f"a worker failed: {error}") from error
        finally:
            self._client.cancel(futures)
        if lost:
            raise WorkersLost(lost)
