"""Drift at the end of the runs over lengths and speeds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from joblib import Parallel, delayed
from numpy.typing import NDArray

from .case import Case
from .drift import run_drift

#: Corners of the map: m and m/s.
LENGTHS, SPEEDS = (0.3, 10.0), (0.05, 1.5)


@dataclass(frozen=True)
class DriftMap:
    """drift (lengths, speeds), K; NaN where a map was stopped before it came there."""

    lengths: NDArray[np.float64]
    speeds: NDArray[np.float64]
    drift: NDArray[np.float64]


def _column(case: Case, speeds: NDArray[np.float64]) -> list[float]:
    return [run_drift(replace(case, speed=float(speed))) for speed in speeds]


def empty_map(points: int) -> DriftMap:
    """points x points places, evenly in the logarithm, with nothing known."""
    return DriftMap(
        np.geomspace(*LENGTHS, points),
        np.geomspace(*SPEEDS, points),
        np.full((points, points), np.nan),
    )


def fill_map(
    grid: DriftMap, case: Case, jobs: int, progress: Callable[[int], None] = lambda done: None
) -> None:
    """Drifts of a case on other belts, in `jobs` processes; what interrupts it leaves the rest."""
    columns = Parallel(n_jobs=jobs, return_as="generator")(
        delayed(_column)(case.with_length(float(length)), grid.speeds) for length in grid.lengths
    )
    for i, column in enumerate(columns):
        grid.drift[i] = column
        progress(grid.speeds.size)
