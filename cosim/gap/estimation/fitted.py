"""Where a fit stands, and where it ended."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from stickslip.effects.candidate import FreeParameter

from .columns import Columns
from .segmented_run import SegmentedRun


def shared_of(free_parameters: Sequence[FreeParameter]) -> list[FreeParameter]:
    """Those that have one value for the campaign."""
    return [free for free in free_parameters if not free.per_run]


def own_of(free_parameters: Sequence[FreeParameter]) -> list[FreeParameter]:
    """Those that every run has a value of its own of: phases."""
    return [free for free in free_parameters if free.per_run]


@dataclass(frozen=True)
class Point:
    """Where a fit stands.

    Attributes
    ----------
    shared : (g,) free parameters of the campaign, scaled
    own : per run (k,) free parameters of the run, scaled
    states : per run (segments, 8)
    """

    shared: np.ndarray
    own: tuple[np.ndarray, ...]
    states: tuple[np.ndarray, ...]

    def of_run(self, run: int) -> Point:
        """The same of one run alone."""
        return Point(self.shared, (self.own[run],), (self.states[run],))


def start(
    segmented_runs: Sequence[SegmentedRun], free_parameters: Sequence[FreeParameter]
) -> Point:
    """All free parameters at their starts, all segments at the states read off the data."""
    shared = np.array([free.scaled(free.start) for free in shared_of(free_parameters)])
    own = np.array([free.scaled(free.start) for free in own_of(free_parameters)])
    return Point(
        shared, tuple(own.copy() for _ in segmented_runs), tuple(f.starts for f in segmented_runs)
    )


@dataclass(frozen=True)
class Fitted:
    """A fit.

    Attributes
    ----------
    free_parameters : what was fitted
    point : where it ended
    residuals : per run (rows,) in units of the noise
    columns : per run, derivatives at the end (None unless asked for)
    """

    free_parameters: tuple[FreeParameter, ...]
    point: Point
    residuals: tuple[np.ndarray, ...]
    columns: tuple[Columns, ...] | None = None

    @classmethod
    def joined(cls, alone: Sequence[Fitted]) -> Fitted:
        """Of several runs, from fits of each alone with the same shared numbers."""
        own, states = (
            tuple(getattr(a.point, name)[0] for a in alone) for name in ("own", "states")
        )
        columns = [a.columns[0] for a in alone if a.columns is not None]
        return cls(
            alone[0].free_parameters,
            Point(alone[0].point.shared, own, states),
            tuple(a.residuals[0] for a in alone),
            tuple(columns) if len(columns) == len(alone) else None,
        )

    def of_run(self, run: int) -> Fitted:
        """The same of one run alone."""
        columns = None if self.columns is None else (self.columns[run],)
        return Fitted(self.free_parameters, self.point.of_run(run), (self.residuals[run],), columns)

    @property
    def derivatives(self) -> tuple[Columns, ...]:
        """Those at its end; ValueError where they were not taken."""
        if self.columns is None:
            raise ValueError("fitted without derivatives; with_columns adds them")
        return self.columns

    @property
    def values(self) -> dict[str, float]:
        """Fitted parameters of the campaign."""
        return _named(shared_of(self.free_parameters), self.point.shared)

    def own_values(self, run: int) -> dict[str, float]:
        """Fitted parameters of one run."""
        return _named(own_of(self.free_parameters), self.point.own[run])

    @property
    def cost(self) -> float:
        """Sum of squares."""
        return float(sum(r @ r for r in self.residuals))

    def rms_residual(self, runs: Sequence[int] | None = None) -> float:
        """Root mean square residual in units of the noise."""
        chosen = self.residuals if runs is None else [self.residuals[i] for i in runs]
        return float(np.sqrt(sum(r @ r for r in chosen) / max(1, sum(r.size for r in chosen))))


def _named(free_parameters: Sequence[FreeParameter], scaled: np.ndarray) -> dict[str, float]:
    return {free.key: free.value(s) for free, s in zip(free_parameters, scaled, strict=True)}
