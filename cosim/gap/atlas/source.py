"""Misfits of one channel in one regime, ready for least squares over bins of any variable."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from cosim.gap.atlas.response import Normal, Stretch, normal_equations


@dataclass(frozen=True)
class Points:
    """Misfits that were seen one by one in a run: (m,) values and errors, indices of samples."""

    track: int
    rows: np.ndarray
    values: np.ndarray
    errors: np.ndarray


@dataclass(frozen=True)
class Source:
    """Where a region's misfit is read from.

    Attributes
    ----------
    channel, regime, quantity, unit : what it is
    pieces : stretches of a run, or the points of a run
    unsuited : variables that say nothing here
    """

    channel: str
    regime: str
    quantity: str
    unit: str
    pieces: Sequence[Stretch | Points] = field(repr=False)
    unsuited: tuple[str, ...] = ()

    @property
    def tracks(self) -> np.ndarray:
        """(p,) number of the run of each piece."""
        return np.array([piece.track for piece in self.pieces], dtype=int)

    def normals(
        self, inputs: Callable[[Stretch | Points], np.ndarray], level: bool = False
    ) -> list[Normal]:
        """Normal equations of each piece, for inputs (n, b) at its samples.

        level : of a stretch, only what changes within it counts
        """
        if not self.pieces or isinstance(self.pieces[0], Stretch):
            return normal_equations(self.pieces, inputs, level)
        return [_normal_of_points(points, inputs(points)) for points in self.pieces]

    def at_samples(self, variables: Sequence[Mapping[str, np.ndarray]], name: str) -> np.ndarray:
        """Values of a variable at all samples of the pieces."""
        parts = [variables[piece.track][name][piece.rows] for piece in self.pieces]
        return np.concatenate([np.empty(0), *parts])


def _normal_of_points(points: Points, inputs: np.ndarray) -> Normal:
    columns = inputs / points.errors[:, None]
    scaled = points.values / points.errors
    return Normal(columns.T @ columns, columns.T @ scaled, float(scaled @ scaled), len(scaled))
