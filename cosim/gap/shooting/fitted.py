"""Where a fit stands, and where it ended."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .columns import Columns
from .flight import Flight
from .knob import Knob


@dataclass(frozen=True)
class Point:
    """Where a fit stands.

    Attributes
    ----------
    shared : (g,) knobs of the campaign, scaled
    own : per run (k,) knobs of the run, scaled
    states : per run (windows, 6)
    """

    shared: np.ndarray
    own: tuple[np.ndarray, ...]
    states: tuple[np.ndarray, ...]


def start(flights: Sequence[Flight], knobs: Sequence[Knob]) -> Point:
    """All knobs at their starts, all windows at the states read off the data."""
    shared = np.array([k.scaled(k.start) for k in knobs if not k.per_run])
    own = np.array([k.scaled(k.start) for k in knobs if k.per_run])
    return Point(shared, tuple(own.copy() for _ in flights), tuple(f.starts for f in flights))


@dataclass(frozen=True)
class Fitted:
    """A fit.

    Attributes
    ----------
    knobs : what was turned
    point : where it ended
    residuals : per run (rows,) in units of the noise
    columns : per run, derivatives at the end (None unless asked for)
    """

    knobs: tuple[Knob, ...]
    point: Point
    residuals: tuple[np.ndarray, ...]
    columns: tuple[Columns, ...] | None = None

    @property
    def values(self) -> dict[str, float]:
        """Fitted parameters of the campaign."""
        return _named(self.knobs, self.point.shared, per_run=False)

    def own_values(self, run: int) -> dict[str, float]:
        """Fitted parameters of one run."""
        return _named(self.knobs, self.point.own[run], per_run=True)

    @property
    def cost(self) -> float:
        """Sum of squares."""
        return float(sum(r @ r for r in self.residuals))

    def gap(self, runs: Sequence[int] | None = None) -> float:
        """Root mean square residual in units of the noise."""
        chosen = self.residuals if runs is None else [self.residuals[i] for i in runs]
        return float(np.sqrt(sum(r @ r for r in chosen) / max(1, sum(r.size for r in chosen))))


def _named(knobs: Sequence[Knob], scaled: np.ndarray, per_run: bool) -> dict[str, float]:
    chosen = [knob for knob in knobs if knob.per_run == per_run]
    return {knob.key: knob.value(s) for knob, s in zip(chosen, scaled, strict=True)}
