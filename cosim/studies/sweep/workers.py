"""Who computes chunks of a sweep: the cores of this machine, or the workers of a Dask cluster."""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

import joblib

from cosim.processes import BrokenProcessPool, as_finished

from .axis import SweepError
from .combination import Row, SweepStopped, Task, Work, compute_chunk

if TYPE_CHECKING:
    from distributed import Client

#: A scheduler that does not answer in this time (s) is not there; a far one needs a few.
CONNECT_SECONDS = 10.0

Chunks = Sequence[Sequence[Task]]
Rows = Generator[list[Row], None, None]
Run = Callable[[Work, Chunks], Rows]


class WorkersLost(RuntimeError):
    """Worker processes ended in mid-work; what they had not returned is to be done again."""


@contextmanager
def workers(jobs: int | None, dask: str | None) -> Iterator[tuple[int, Run]]:
    """How many compute at once; and the rows of each chunk as it is finished, of work in chunks.

    ``jobs`` processes with one thread each, all cores where left out; 1 is this process. Or the
    threads behind a scheduler's address, one chunk at a time on each: a chunk whose worker dies is
    handed to another one by the scheduler; without workers it waits for new ones. SweepStopped when
    the scheduler is gone, WorkersLost where chunks are to be handed out again.
    """
    if dask is None:
        count = joblib.cpu_count() if jobs is None else jobs
        yield count, partial(_in_processes, count)
        return
    with _client(dask) as client:
        with _connected():
            # at least one, for a cluster whose workers are yet to come
            count = max(sum(client.nthreads().values()), 1)
        yield count, partial(_on_cluster, client)


def _in_processes(count: int, work: Work, chunks: Chunks) -> Rows:
    if work.run.coupled:
        from cosim.fmu.build import own_fmu

        own_fmu(work.base.catalogue)  # here, once, and not by each process; so the kernel
    _ = work.base.catalogue.compiled
    calls = [(work, chunk) for chunk in chunks]
    try:
        yield from as_finished(min(count, len(chunks)), compute_chunk, calls)
    except BrokenProcessPool as error:
        raise WorkersLost(_in_a_line(error)) from error


def _client(address: str) -> Client:
    try:
        from distributed import Client
    except ImportError as error:
        raise SweepError(
            f"dask: {error.name or 'distributed'} is not installed, "
            "allowed after pip install distributed"
        ) from error
    try:
        return Client(address, timeout=CONNECT_SECONDS, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise SweepError(
            f"dask: no scheduler answers at {address} ({_in_a_line(error)}), allowed is an address "
            "such as tcp://127.0.0.1:8786"
        ) from error


@contextmanager
def _connected() -> Iterator[None]:
    """SweepStopped for what breaks when the scheduler is gone."""
    from distributed import CancelledError

    try:
        yield
    except (OSError, CancelledError) as error:
        said = f"the connection to the Dask scheduler broke: {_in_a_line(error)}"
        raise SweepStopped(said) from error


def _on_cluster(client: Client, work: Work, chunks: Chunks) -> Rows:
    from distributed import KilledWorker, as_completed

    # the work travels with every chunk: data scattered to workers would die with them.
    # not pure: work that is started again must not be given the futures of before
    lost = ""
    with _connected():
        futures = client.map(compute_chunk, [work] * len(chunks), chunks, pure=False)
        try:
            for future in as_completed(futures, loop=client.loop):
                if future.status == "finished":
                    yield future.result()
                    future.release()
                elif future.status != "error":  # cancelled or lost
                    lost = "the scheduler dropped work"
                elif isinstance(error := future.exception(), (KilledWorker, OSError)):
                    lost = _in_a_line(error)
                else:
                    raise SweepStopped(f"a worker failed: {_in_a_line(error)}") from error
        finally:
            client.cancel(futures)
    if lost:
        raise WorkersLost(lost)


def _in_a_line(error: BaseException) -> str:
    return " ".join(str(error).split())
