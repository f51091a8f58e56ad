"""Where a fit stands, and where it ended."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from stickslip.effects.candidate import FreeParameter

from .columns import Columns
from .flight import Flight


@dataclass(frozen=True)
class Point:
    """Where a fit stands.

    Attributes
    ----------
    shared : (g,) free parameters of the campaign, scaled
    own : per run (k,) free parameters of the run, scaled
    states : per run (windows, 6)
    """

    shared: np.ndarray
    own: tuple[np.ndarray, ...]
    states: tuple[np.ndarray, ...]


def start(flights: Sequence[Flight], free_parameters: Sequence[FreeParameter]) -> Point:
    """All free parameters at their starts, all windows at the states read off the data."""
    shared = np.array([k.scaled(k.start) for k in free_parameters if not k.per_run])
    own = np.array([k.scaled(k.start) for k in free_parameters if k.per_run])
    return Point(shared, tuple(own.copy() for _ in flights), tuple(f.starts for f in flights))


@dataclass(frozen=True)
class Fitted:
    """A fit.

    Attributes
    ----------
    free parameters : what was turned
    point : where it ended
    residuals : per run (rows,) in units of the noise
    columns : per run, derivatives at the end (None unless asked for)
    """

    free_parameters: tuple[FreeParameter, ...]
    point: Point
    residuals: tuple[np.ndarray, ...]
    columns: tuple[Columns, ...] | None = None

    @property
    def values(self) -> dict[str, float]:
        """Fitted parameters of the campaign."""
        return _named(self.free_parameters, self.point.shared, per_run=False)

    def own_values(self, run: int) -> dict[str, float]:
        """Fitted parameters of one run."""
        return _named(self.free_parameters, self.point.own[run], per_run=True)

    @property
    def cost(self) -> float:
        """Sum of squares."""
        return float(sum(r @ r for r in self.residuals))

    def gap(self, runs: Sequence[int] | None = None) -> float:
        """Root mean square residual in units of the noise."""
        chosen = self.residuals if runs is None else [self.residuals[i] for i in runs]
        return float(np.sqrt(sum(r @ r for r in chosen) / max(1, sum(r.size for r in chosen))))


def _named(
    free_parameters: Sequence[FreeParameter], scaled: np.ndarray, per_run: bool
) -> dict[str, float]:
    chosen = [
        free_parameter for free_parameter in free_parameters if free_parameter.per_run == per_run
    ]
    return {
        free_parameter.key: free_parameter.value(s)
        for free_parameter, s in zip(chosen, scaled, strict=True)
    }
