"""Who computes chunks of a sweep: the cores of this machine, or the workers of a Dask cluster."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from functools import partial
from typing import TYPE_CHECKING, Any

from cosim.cores import CORES
from cosim.processes import BrokenProcessPool, as_finished

from .axis import SweepError
from .combination import Row, Run, SweepStopped, Task, Work, compute_chunk

if TYPE_CHECKING:
    from distributed import Client

#: A scheduler that does not answer in this time (s) is not there; a far one needs a few.
CONNECT_SECONDS = 10.0
#: Simulated time in a chunk of the mechanics, s: half a second of work, which is long against the
#: milliseconds of handing it over, and short to lose. A coupled run is a chunk of its own.
CHUNK_TIME = 1000.0
MOST_IN_CHUNK = 256
#: Chunks per worker at least, so that none waits long for the last one.
SHARES = 4
#: Mechanics that are done, in chunks, before other processes have even been started.
NOT_WORTH_PROCESSES = 3
#: Starts with fresh workers after some were lost, before a sweep gives up.
ATTEMPTS = 3

Rows = Generator[list[Row], None, None]
Chunks = Sequence[Sequence[Task]]


class WorkersLost(RuntimeError):
    """Worker processes ended in mid-work; what they had not returned is to be done again."""


def computed(
    work: Work, tasks: Mapping[str, Mapping[str, Any]], jobs: int | None, dask: str | None
) -> Rows:
    """The rows of all tasks (content key -> changes), chunk by chunk as they are finished.

    ``jobs`` processes with one thread each, all cores where left out; 1 is this process. Or the
    threads behind a scheduler's address. Where workers are lost what is missing is begun again, by
    fresh ones; SweepStopped after the last attempt, and where the scheduler is gone.
    """
    left, lost = dict(tasks), ""
    few = len(tasks) * work.run.duration < NOT_WORTH_PROCESSES * CHUNK_TIME
    with _workers(1 if few and not work.run.coupled else jobs, dask) as (count, compute):
        for attempt in range(ATTEMPTS):
            missing, size = list(left.items()), _chunk_size(work.run, len(left) / count, attempt)
            chunks = [missing[i : i + size] for i in range(0, len(missing), size)]
            try:
                # closed at once where it is left in the middle, not when it is collected
                with closing(compute(work, chunks)) as results:
                    for rows in results:
                        for row in rows:
                            del left[row.key]
                        yield rows
                return
            except WorkersLost as error:
                lost = str(error)
    raise SweepStopped(
        f"workers died {ATTEMPTS} times ({lost}), {len(left)} combinations are missing: try fewer"
        " jobs"
    )


def _chunk_size(run: Run, share: float, attempt: int) -> int:
    """share: tasks for each worker. Shorter chunks after a loss: what is lost with one is less."""
    most = min(round(CHUNK_TIME / run.duration), math.ceil(share / SHARES), MOST_IN_CHUNK)
    return 1 if run.coupled else max(most // 4**attempt, 1)


@contextmanager
def _workers(
    jobs: int | None, dask: str | None
) -> Iterator[tuple[int, Callable[[Work, Chunks], Rows]]]:
    """How many compute at once; and what gives the rows of each chunk as it is finished."""
    if dask is None:
        count = CORES if jobs is None else jobs
        yield count, partial(_in_processes, count)
        return
    with _client(dask) as client:
        from distributed import CancelledError

        try:
            # at least one, for a cluster whose workers are yet to come
            yield max(sum(client.nthreads().values()), 1), partial(_on_cluster, client)
        except (OSError, CancelledError) as error:
            said = f"the connection to the Dask scheduler broke: {_in_a_line(error)}"
            raise SweepStopped(said) from error


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


def _on_cluster(client: Client, work: Work, chunks: Chunks) -> Rows:
    """A chunk whose worker dies is handed on by the scheduler; without workers it waits for one."""
    from distributed import KilledWorker, as_completed

    # the work travels with every chunk: data scattered to workers would die with them.
    # not pure: work that is started again must not be given the futures of before
    lost = ""
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
