"""A sweep: what is missing is computed, each finished chunk is kept, all rows are one dataset."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import closing
from importlib.metadata import version
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import xarray as xr
from stickslip import Parameters, simulate

from cosim.report.files import provenance
from cosim.scenario import Scenario

from .chunks import DaskWorkers, LocalWorkers, Store
from .combination import (
    COMPLETE,
    STATUS_MEANINGS,
    Row,
    Run,
    Task,
    Work,
    compute_chunk,
    model_version,
)
from .errors import SweepError, SweepStopped, WorkersLost
from .grid import Grid, product_grid

#: Length of a chunk, s: long against the milliseconds of handing it over, short to lose.
CHUNK_SECONDS = 0.5
#: The first combination tells how many fit into that time; it may have failed at once.
MOST_IN_CHUNK = 256
#: Chunks per worker at least, so that none waits long for the last one.
SHARES = 4
#: Work shorter than this (s) is done before other processes have even been started.
NOT_WORTH_PROCESSES = 1.5
#: Starts with fresh workers after some were lost, before a sweep gives up.
ATTEMPTS = 3

#: How a run ended, as numbers.
CODES = np.arange(len(STATUS_MEANINGS.split()), dtype=np.int8)

Progress = Callable[[int, int], None]


class Workers(Protocol):
    """Whoever computes chunks."""

    @property
    def count(self) -> int: ...

    def run(
        self, work: Work, chunks: Sequence[Sequence[Task]]
    ) -> Generator[list[Row], None, None]: ...


def sweep(
    parameters: Parameters | Sequence[Scenario],
    vary: Mapping[Any, Sequence[Any]],
    *,
    coupled: bool | None = None,
    duration: float | None = None,
    output_interval: float | None = None,
    jobs: int | None = None,
    dask: str | None = None,
    folder: str | Path | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """Features of the motion over the product of the varied keys.

    Parameters
    ----------
    parameters : the case that is varied: mechanics, or a scenario, or several of them, which are
        then an axis of their own
    vary : `block.key` -> values; a tuple of keys -> tuples of values for keys that go together;
        `belt.layers[2].conductivity` for the second table of a list
    coupled : whether every run is coupled to the heat in belt and ice; left out, it is where a key
        of belt, ice, contact or coupling is varied, or differs between the scenarios
    duration, output_interval : of every run, s; left out, 30 and 0.01, of scenarios their own
    jobs : processes on this machine (all cores when left out); dask : a scheduler's address instead
    folder : where finished chunks are kept, and found again by the next sweep (none: nothing kept)
    progress : called with the combinations done and their number

    Returns a dataset with one dimension for each varied key, one variable for each of `FEATURES`,
    `status` and `reason`: a run that failed is NaN there and ends nothing.

    Raises SweepError before anything is computed when the combinations cannot be, SweepStopped
    when the workers are lost for good; what was finished until then is kept.

    >>> from stickslip import Parameters
    >>> done = sweep(Parameters(), {"rig.mass": [0.67, 2.03]}, duration=2.0, jobs=1)
    >>> bool(done.x_mean[1] > 2.5 * done.x_mean[0])
    True
    """
    grid = product_grid(parameters, vary, coupled)
    given = {"duration": duration, "output_interval": output_interval}
    return run_grid(
        grid,
        grid.run_of({name: value for name, value in given.items() if value is not None}),
        jobs=jobs,
        dask=dask,
        folder=folder,
        progress=progress,
    )


def run_grid(
    grid: Grid,
    run: Run,
    *,
    jobs: int | None = None,
    dask: str | None = None,
    folder: str | Path | None = None,
    progress: Progress | None = None,
) -> xr.Dataset:
    """`sweep` over combinations that are made already."""
    _check(run)
    keys = grid.keys(run)
    store = Store(None if folder is None else Path(folder))
    rows = store.read()
    work = Work(grid.base, run, model_version())
    # equal combinations have one key, and are run once
    tasks = {key: Task(key, changes) for key, changes in zip(keys, grid.changes, strict=True)}
    sweeper = _Sweeper(work, tasks, rows, store, progress)
    if sweeper.missing():
        with LocalWorkers(jobs) if dask is None else DaskWorkers(dask) as workers:
            sweeper.finish(workers)
    return _dataset(grid, run, [rows[key] for key in keys])


def _check(run: Run) -> None:
    for name, value in zip(run._fields, run[:2], strict=False):
        if not (math.isfinite(value) and value > 0.0):
            raise SweepError(f"{name}: out of range ({value:g}), allowed is above 0 s")


class _Sweeper:
    """Tasks, the rows there are of them, and where to keep new ones."""

    def __init__(
        self,
        work: Work,
        tasks: dict[str, Task],
        rows: dict[str, Row],
        store: Store,
        progress: Progress | None,
    ):
        self.work, self.tasks, self.rows, self.store = work, tasks, rows, store
        self.done = len(tasks) - len(self.missing())
        self.progress = progress or (lambda done, total: None)
        self.progress(self.done, len(tasks))

    def missing(self) -> list[Task]:
        return [task for key, task in self.tasks.items() if key not in self.rows]

    def keep(self, rows: list[Row]) -> None:
        self.store.write(rows)
        self.rows |= {row.key: row for row in rows}
        self.done += len(rows)
        self.progress(self.done, len(self.tasks))

    def finish(self, workers: Workers) -> None:
        """Compute what is missing, with fresh workers when some were lost."""
        seconds = self._first()
        for attempt in range(ATTEMPTS):
            missing = self.missing()
            if len(missing) * seconds < NOT_WORTH_PROCESSES and isinstance(workers, LocalWorkers):
                workers = LocalWorkers(1)
            # shorter chunks after a loss: what is lost with a worker is less
            size = max(_chunk_size(missing, seconds, workers.count) // 4**attempt, 1)
            chunks = [missing[i : i + size] for i in range(0, len(missing), size)]
            try:
                # closed at once where it is left in the middle, not when it is collected
                with closing(workers.run(self.work, chunks)) as results:
                    for rows in results:
                        self.keep(rows)
                return
            except WorkersLost as error:
                lost = error
        raise SweepStopped(
            f"workers died {ATTEMPTS} times ({lost}), {len(self.missing())} of "
            f"{len(self.tasks)} combinations are missing: try fewer jobs"
        ) from lost

    def _first(self) -> float:
        """Run the first combination here: how long one takes, s, the kernel's loading aside.

        A coupled one builds the unit where it is missing, before all workers would.
        """
        task = self.missing()[:1]
        # one row of it: compiles the kernel before the workers would, all at the same time
        interval = self.work.run.output_interval
        if isinstance(self.work.base, Scenario):
            simulate(Parameters(), 1e-3, 1e-3)
        else:
            compute_chunk(self.work._replace(run=Run(interval, interval)), task)
        start = time.perf_counter()
        self.keep(compute_chunk(self.work, task))
        return time.perf_counter() - start


def _chunk_size(missing: Sequence[Task], seconds: float, workers: int) -> int:
    """Combinations in a chunk."""
    most = math.ceil(len(missing) / (SHARES * workers))
    return max(min(round(CHUNK_SECONDS / seconds), most, MOST_IN_CHUNK), 1)


def _dataset(grid: Grid, run: Run, rows: Sequence[Row]) -> xr.Dataset:
    """``rows``, in the grid's order, as variables over the grid's dimensions."""
    blank = (math.nan,) * len(run.features)
    table = np.array([row.values or blank for row in rows])
    variables: dict[str, Any] = {
        name: (grid.dims, table[:, i].reshape(grid.shape), {"units": unit, "long_name": text})
        for i, (name, (unit, text)) in enumerate(run.features.items())
    }
    status = np.array([row.status for row in rows], dtype=np.int8)
    reason = np.array([row.reason for row in rows], dtype=object)
    variables["status"] = (
        grid.dims,
        status.reshape(grid.shape),
        {
            "units": "1",
            "long_name": "how the run ended",
            "flag_values": CODES,
            "flag_meanings": STATUS_MEANINGS,
        },
    )
    variables["reason"] = (
        grid.dims,
        reason.reshape(grid.shape),
        {
            "units": "1",
            "long_name": "why the run is not complete; empty when it is",
        },
    )
    coordinates = {
        name: (axis.name, values, attributes)
        for axis in grid.axes
        for name, (values, attributes) in axis.coordinates.items()
    }
    return xr.Dataset(variables, coordinates, _attributes(grid, run, status))


def _attributes(grid: Grid, run: Run, status: np.ndarray) -> dict[str, object]:
    failed = int(np.count_nonzero(status != COMPLETE))
    return {
        "title": " x ".join(f"{axis.name} ({len(axis)})" for axis in grid.axes),
        "status": "complete" if not failed else f"{failed} of {status.size} combinations failed",
        "coupled": int(run.coupled),
        "duration": run.duration,
        "output_interval": run.output_interval,
        "parameters": json.dumps(grid.base.model_dump(mode="json")),
        "model_version": model_version(),
        "stickslip": version("stickslip"),
        **provenance(),
    }
