"""A sweep: what is missing is computed, each finished chunk is kept, all rows are one dataset.

A chunk of rows is one JSON file that appears under its name only when it is complete. Rows are
found by their content key, so it does not matter which sweep they were computed for; those of
another version of the model lie in another folder.
"""

import hashlib
import json
import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
from stickslip import Parameters

from cosim.files import OutputError, OutputRefused, writable, write_text
from cosim.report.files import provenance
from cosim.scenario import Scenario, read_scenario

from .axis import SweepError
from .combination import COMPLETE, ERROR, STATUS_MEANINGS, Row, SweepStopped, Work, model_version
from .grid import Grid, product_grid
from .result import Sweep
from .workers import computed

FOLDER = "chunks"
VERSION_DIGITS = 12


class Store:
    """Rows in ``folder``/chunks, of a version of the model; without a folder nothing is kept."""

    def __init__(self, folder: Path | None, version: str):
        self.folder = None if folder is None else folder / FOLDER / version[:VERSION_DIGITS]
        if self.folder is not None:
            try:
                writable(self.folder)
            except OutputRefused as error:
                raise SweepError(str(error)) from error

    def read(self) -> dict[str, Row]:
        """Key -> row of everything that is kept; a warning for a file that is damaged."""
        rows: dict[str, Row] = {}
        for file in sorted(self.folder.glob("*.json")) if self.folder else ():
            try:
                entries = json.loads(file.read_text(encoding="utf-8"))
                rows |= {key: Row(key, *outcome) for key, *outcome in entries}
            except (ValueError, TypeError) as error:
                said = f"{file}: damaged ({error}), its combinations are run again"
                warnings.warn(said, stacklevel=2)
        return rows

    def write(self, rows: Sequence[Row]) -> None:
        """Keep the rows of a chunk; those in ERROR are left out and computed again next time."""
        kept = [row for row in rows if row.status != ERROR]
        if self.folder is None or not kept:
            return
        name = hashlib.sha256("".join(row.key for row in kept).encode()).hexdigest()[:24]
        try:
            write_text(json.dumps(kept), self.folder / f"{name}.json")
        except OutputError as error:
            raise SweepStopped(str(error)) from error


def sweep(
    parameters: Parameters | Sequence[Scenario] | str | Path,
    vary: Mapping[Any, Sequence[Any]],
    *,
    coupled: bool | None = None,
    duration: float | None = None,
    output_interval: float | None = None,
    jobs: int | None = None,
    dask: str | None = None,
    folder: str | Path | None = None,
    progress: Callable[[int, int], object] = lambda done, total: None,
) -> Sweep:
    """Features of the motion over the product of the varied keys.

    Parameters
    ----------
    parameters : the case that is varied: mechanics, or a scenario (or the name of a packaged one,
        or a TOML file), or several of them, which are then an axis of their own
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
    if isinstance(parameters, (str, Path)):
        parameters = read_scenario(parameters)
    given = {"duration": duration, "output_interval": output_interval}
    times = {name: value for name, value in given.items() if value is not None}
    grid = product_grid(parameters, vary, coupled, **times)
    found = run_grid(grid, jobs=jobs, dask=dask, folder=folder, progress=progress)
    first = parameters if isinstance(parameters, Parameters) else parameters[0]
    if isinstance(first, Scenario):
        found.attrs["scenario"] = first.to_toml()
    return found


def run_grid(
    grid: Grid,
    *,
    jobs: int | None = None,
    dask: str | None = None,
    folder: str | Path | None = None,
    progress: Callable[[int, int], object] = lambda done, total: None,
) -> Sweep:
    """`sweep` over combinations that are made already."""
    for name in ("duration", "output_interval"):
        if not (math.isfinite(value := getattr(grid.run, name)) and value > 0.0):
            raise SweepError(f"{name}: out of range ({value:g}), allowed is above 0 s")
    if jobs is not None and jobs < 1:
        raise SweepError(f"jobs: out of range ({jobs}), allowed is a whole number from 1")
    keys = grid.keys()
    work = Work(grid.base, grid.run, model_version(grid.base.catalogue))
    store = Store(None if folder is None else Path(folder), work.version)
    rows = store.read()
    # equal combinations have one key, and are run once
    tasks = dict(zip(keys, grid.changes, strict=True))
    missing = {key: changes for key, changes in tasks.items() if key not in rows}
    done = len(tasks) - len(missing)
    progress(done, len(tasks))
    if missing:
        with closing(computed(work, missing, jobs, dask)) as results:
            for new in results:
                store.write(new)
                rows.update((row.key, row) for row in new)
                done += len(new)
                progress(done, len(tasks))
    return _dataset(grid, [rows[key] for key in keys])


def _dataset(grid: Grid, rows: Sequence[Row]) -> Sweep:
    """``rows``, in the grid's order, as variables over the grid's dimensions."""
    dims, run = [each.name for each in grid.axes], grid.run

    def over_grid(values: Sequence[Any], dtype: Any, long_name: str, unit: str, **more: Any) -> Any:
        attributes = {"units": unit, "long_name": long_name, **more}
        return dims, np.array(values, dtype=dtype).reshape(grid.shape), attributes

    blank = (math.nan,) * len(run.features)
    columns = zip(*(row.values or blank for row in rows), strict=True)
    variables = {
        name: over_grid(column, float, of.long_name, of.unit)
        for column, (name, of) in zip(columns, run.features.items(), strict=True)
    }
    statuses, reasons = zip(*((row.status, row.reason) for row in rows), strict=True)
    flags = np.arange(len(STATUS_MEANINGS.split()), dtype=np.int8)
    how = {"flag_values": flags, "flag_meanings": STATUS_MEANINGS}
    variables["status"] = over_grid(statuses, np.int8, "how the run ended", "1", **how)
    why = "why the run is not complete; empty when it is"
    variables["reason"] = over_grid(reasons, object, why, "1")
    failed = sum(status != COMPLETE for status in statuses)
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
    coordinates = {name: each for axis in grid.axes for name, each in axis.coordinates.items()}
    return Sweep(variables, coordinates, attributes)
