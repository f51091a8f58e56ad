"""Chunks of a sweep: who computes them, and where they are kept for the next sweep.

A chunk is one JSON file that appears under its name only when it is complete. Rows are found by
their content key, so it does not matter which sweep they were computed for; chunks of another
version of the model lie in another folder. They are computed by the cores of this machine, or by
the workers of a Dask cluster.
"""

from __future__ import annotations

import hashlib
import json
import math
import warnings
from collections.abc import Generator, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Self

import joblib
from stickslip.compiled import compiled_kernel
from stickslip.plugins.dask_transport import packed, to_send, unpacked_call

from cosim.files import OutputError, OutputRefused, writable, write_text
from cosim.processes import BrokenProcessPool, as_finished, is_stopped
from cosim.studies.sweep.combination import (
    ERROR,
    Row,
    Task,
    Work,
    compute_chunk,
    model_version,
)
from cosim.studies.sweep.errors import SweepError, SweepStopped, WorkersLost

FOLDER = "chunks"
VERSION_DIGITS = 12
#: A scheduler that does not answer in this time (s) is not there; a far one needs a few.
CONNECT_SECONDS = 10.0


class Store:
    """Rows in ``folder``/chunks; without a folder nothing is kept."""

    def __init__(self, folder: Path | None):
        self.folder = None if folder is None else folder / FOLDER / model_version()[:VERSION_DIGITS]
        if self.folder is not None:
            try:
                writable(self.folder)
            except OutputRefused as error:
                raise SweepError(str(error)) from error

    def read(self) -> dict[str, Row]:
        """Key -> row of everything that is kept."""
        rows: dict[str, Row] = {}
        for file in sorted(self.folder.glob("*.json")) if self.folder else ():
            rows |= {row.key: row for row in _read(file)}
        return rows

    def write(self, rows: Sequence[Row]) -> None:
        """Keep the rows of a chunk; those in ERROR are left out and computed again next time."""
        kept = [row for row in rows if row.status != ERROR]
        if self.folder is None or not kept:
            return
        name = hashlib.sha256("".join(row.key for row in kept).encode()).hexdigest()[:24]
        text = json.dumps([_plain(row) for row in kept], allow_nan=False)
        try:
            write_text(text, self.folder / f"{name}.json")
        except OutputError as error:
            raise SweepStopped(str(error)) from error


def _plain(row: Row) -> list:
    values = [value if math.isfinite(value) else None for value in row.values]
    return [row.key, row.status, row.reason, values]


def _read(file: Path) -> list[Row]:
    """A chunk's rows; none, with a warning, when the file is damaged."""
    try:
        entries = json.loads(file.read_text(encoding="utf-8"))
        return [
            Row(key, status, reason, tuple(math.nan if v is None else float(v) for v in values))
            for key, status, reason, values in entries
        ]
    except (ValueError, TypeError) as error:
        warnings.warn(f"{file}: damaged ({error}), its combinations are run again", stacklevel=2)
        return []


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
        compiled_kernel()  # here, once, and not by each process
        try:
            yield from as_finished(min(self.count, len(chunks)), _compute, calls)
        except BrokenProcessPool as error:
            raise WorkersLost(" ".join(str(error).split())) from error


def _compute(work: Work, chunk: Sequence[Task]) -> list[Row]:
    """`compute_chunk`, which ends early where a process of the pool is to stop."""
    return compute_chunk(work, chunk, is_stopped)


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

        # the work travels with every chunk: data scattered to workers would die with them. packed,
        # for what is made of a custom effect can be unpacked only where that effect is.
        # not pure: work that is started again must not be given the futures of before
        calls = [packed(compute_chunk, work, chunk) for chunk in chunks]
        sent = [to_send()] * len(calls)
        futures = self._client.map(unpacked_call, sent, calls, pure=False)
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
                    said = " ".join(str(error).split())
                    raise SweepStopped(f"a worker failed: {said}") from error
        finally:
            self._client.cancel(futures)
        if lost:
            raise WorkersLost(lost)
