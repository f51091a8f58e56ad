"""Where a fit sets out: a coarse scan of the two friction coefficients.

Residuals over whole cycles have several minima in mu_s and mu_k where an effect is missing: cycles
of one run come in step with the data at the expense of another. One simulation per point, from the
states read off the data, tells the valleys apart.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from .numbers import Unknown

#: Factors on mu_k and on the excess mu_s - mu_k, of the first guess.
LEVELS = np.array([0.5, 0.62, 0.77, 0.9, 1.0, 1.12, 1.3])
EXCESSES = np.array([0.25, 0.45, 0.7, 1.0, 1.5, 2.3, 3.5])
#: Valleys that are followed beside the first guess.
VALLEYS = 2


def valleys(unknowns: Sequence[Unknown], cost: Callable[[np.ndarray], float]) -> list[np.ndarray]:
    """Scaled numbers (k,) to set out from beside the first guess, the best first.

    cost : of scaled numbers, cheap
    """
    places = {unknown.label: place for place, unknown in enumerate(unknowns)}
    level, static = places.get("friction.mu_k"), places.get("friction.mu_s")
    if level is None:
        return []
    points = _grid(unknowns, level, static)
    costs = np.array([[cost(point) for point in row] for row in points])
    padded = np.pad(costs, 1, constant_values=np.inf)
    around = [np.roll(padded, by, axis) for axis in (0, 1) for by in (-1, 1)]
    lowest = costs <= np.min(around, axis=0)[1:-1, 1:-1]
    found = sorted(zip(*np.nonzero(lowest), strict=True), key=lambda place: costs[place])
    return [points[i][j] for i, j in found[:VALLEYS] if points[i][j].any()]


def _grid(unknowns: Sequence[Unknown], level: int, static: int | None) -> list[list[np.ndarray]]:
    """Points by levels and excesses, inside the bounds."""
    mu_k = unknowns[level].number
    rows = []
    for factor in LEVELS:
        row = []
        for excess in EXCESSES if static is not None else (1.0,):
            point = np.zeros(len(unknowns))
            wanted = {level: factor * mu_k.start}
            if static is not None:
                more = unknowns[static].number.start - mu_k.start
                wanted[static] = wanted[level] + excess * more
            for place, value in wanted.items():
                number = unknowns[place].number
                point[place] = number.scaled(min(max(value, number.low), number.high))
            row.append(point)
        rows.append(row)
    return rows
