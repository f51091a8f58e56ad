"""A sweep: what is missing is computed, each finished chunk is kept, all rows are one dataset."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from stickslip import Parameters

from cosim.report.files import provenance
from cosim.scenario import Scenario

from .axis import SweepError
from .combination import (
    COMPLETE,
    STATUS_MEANINGS,
    Row,
    Run,
    SweepStopped,
    Task,
    Work,
    model_version,
)
from .grid import Grid, product_grid
from .result import Sweep
from .store import Store
from .workers import Chunks, Rows, WorkersLost, workers

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

Progress = Callable[[int, int], None]


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
) -> Sweep:
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

    Returns a `Sweep`: a dataset with one dimension for each varied key, one variable for each of
    `FEATURES`, `status` and `reason`. A run that failed is NaN there and ends nothing.

    Raises SweepError before anything is computed when the combinations cannot be, SweepStopped
    when the workers are lost for good; what was finished until then is kept.

    >>> from stickslip import Parameters
    >>> done = sweep(Parameters(), {"rig.mass": [0.67, 2.03]}, duration=2.0, jobs=1)
    >>> bool(done.x_mean[1] > 2.5 * done.x_mean[0])
    True
    """
    grid = product_grid(parameters, vary, coupled)
    given = {"duration": duration, "output_interval": output_interval}
    found = run_grid(
        grid,
        grid.run_of({name: value for name, value in given.items() if value is not None}),
        jobs=jobs,
        dask=dask,
        folder=folder,
        progress=progress,
    )
    if not isinstance(parameters, Parameters):
        first = parameters if isinstance(parameters, Scenario) else parameters[0]
        found.attrs["scenario"] = first.to_toml()
    return found


def run_grid(
    grid: Grid,
    run: Run,
    *,
    jobs: int | None = None,
    dask: str | None = None,
    folder: str | Path | None = None,
    progress: Progress | None = None,
) -> Sweep:
    """`sweep` over combinations that are made already."""
    for name, value in (("duration", run.duration), ("output_interval", run.output_interval)):
        if not (math.isfinite(value) and value > 0.0):
            raise SweepError(f"{name}: out of range ({value:g}), allowed is above 0 s")
    if jobs is not None and jobs < 1:
        raise SweepError(f"jobs: out of range ({jobs}), allowed is a whole number from 1")
    keys = grid.keys(run)
    version = model_version(grid.base.catalogue)
    store = Store(None if folder is None else Path(folder), version)
    rows = store.read()
    # equal combinations have one key, and are run once
    tasks = {key: Task(key, changes) for key, changes in zip(keys, grid.changes, strict=True)}

    done = len(tasks.keys() & rows.keys())

    def keep(new: Sequence[Row]) -> None:
        nonlocal done
        store.write(new)
        rows.update((row.key, row) for row in new)
        done += len(new)
        if progress is not None:
            progress(done, len(tasks))

    def missing() -> list[Task]:
        return [task for key, task in tasks.items() if key not in rows]

    keep(())
    if todo := len(missing()):
        few = not run.coupled and todo * run.duration < NOT_WORTH_PROCESSES * CHUNK_TIME
        with workers(1 if few else jobs, dask) as (count, compute):
            work = partial(compute, Work(grid.base, run, version))
            _finish(count, work, run, missing, keep)
    return _dataset(grid, run, [rows[key] for key in keys])


def _finish(
    count: int,
    compute: Callable[[Chunks], Rows],
    run: Run,
    missing: Callable[[], list[Task]],
    keep: Callable[[Sequence[Row]], None],
) -> None:
    """Compute what is missing, ``count`` at once, with fresh workers when some were lost."""
    lost: WorkersLost | None = None
    for attempt in range(ATTEMPTS):
        tasks = missing()
        most = math.ceil(len(tasks) / (SHARES * count))
        size = 1 if run.coupled else min(round(CHUNK_TIME / run.duration), most, MOST_IN_CHUNK)
        # shorter chunks after a loss: what is lost with a worker is less
        size = max(max(size, 1) // 4**attempt, 1)
        chunks = [tasks[i : i + size] for i in range(0, len(tasks), size)]
        try:
            # closed at once where it is left in the middle, not when it is collected
            with closing(compute(chunks)) as results:
                for rows in results:
                    keep(rows)
            return
        except WorkersLost as error:
            lost = error
    raise SweepStopped(
        f"workers died {ATTEMPTS} times ({lost}), {len(missing())} combinations are missing: try"
        " fewer jobs"
    ) from lost


def _dataset(grid: Grid, run: Run, rows: Sequence[Row]) -> Sweep:
    """``rows``, in the grid's order, as variables over the grid's dimensions."""

    def over_grid(values: Sequence[Any], dtype: Any, attributes: dict[str, Any]) -> Any:
        return grid.dims, np.array(values, dtype=dtype).reshape(grid.shape), attributes

    blank = (math.nan,) * len(run.features)
    columns = zip(*(row.values or blank for row in rows), strict=True)
    variables = {
        name: over_grid(column, float, {"units": of.unit, "long_name": of.long_name})
        for column, (name, of) in zip(columns, run.features.items(), strict=True)
    }
    how: dict[str, Any] = {"units": "1", "long_name": "how the run ended"}
    how["flag_values"] = np.arange(len(STATUS_MEANINGS.split()), dtype=np.int8)
    how["flag_meanings"] = STATUS_MEANINGS
    why = {"units": "1", "long_name": "why the run is not complete; empty when it is"}
    variables["status"] = over_grid([row.status for row in rows], np.int8, how)
    variables["reason"] = over_grid([row.reason for row in rows], object, why)
    coordinates = {
        name: (axis.name, values, attributes)
        for axis in grid.axes
        for name, (values, attributes) in axis.coordinates.items()
    }
    failed = sum(row.status != COMPLETE for row in rows)
    attributes = {
        "title": " x ".join(f"{axis.name} ({len(axis)})" for axis in grid.axes),
        "status": "complete" if not failed else f"{failed} of {len(rows)} combinations failed",
        "coupled": int(run.coupled),
        "duration": run.duration,
        "output_interval": run.output_interval,
        "parameters": json.dumps(grid.base.model_dump(mode="json")),
        "model_version": model_version(grid.base.catalogue),
        "stickslip": version("stickslip"),
        **provenance(),
    }
    return Sweep(variables, coordinates, attributes)
