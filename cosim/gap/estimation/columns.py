"""Derivatives of one run's residuals, and what its own free parameters and states take up of them.

What belongs to one run alone is linear enough near its guess: its part of every step follows from
the rest by a QR factorisation of that run's own columns (variable projection, Golub & Pereyra
1973).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

#: Steps of a segment's state that are as unlikely as a residual of one.
_FAR = 50.0
#: Numbers that the motion answers to alike but for this share their step.
_ALIKE = 1e-12
#: Longest step of what belongs to one run, in steps of a free parameter: the motion may hardly
#: feel it.
_LONGEST_OWN = 1.0


@dataclass(frozen=True)
class Columns:
    """Derivatives of one run's residuals.

    Attributes
    ----------
    residuals : (r,) where they were taken
    shared : (r, g) by the campaign's free parameters
    own : (r, k) by the run's own free parameters
    states : of each segment: rows, derivatives (rows, free) by the free numbers of its state
    longest : (k,) longest steps of the run's own
    """

    residuals: np.ndarray
    shared: np.ndarray
    own: np.ndarray
    states: tuple[tuple[np.ndarray, np.ndarray], ...]
    longest: np.ndarray | None = None

    @cached_property
    def _bases(self) -> tuple[np.ndarray, ...]:
        return tuple(np.linalg.qr(columns)[0] for _, columns in self.states)

    @cached_property
    def _own_left(self) -> np.ndarray:
        return self.without_states(self.own)

    def without_states(self, a: np.ndarray) -> np.ndarray:
        """What of (r, ...) the segments' states cannot take up."""
        rest = a.copy()
        for (rows, _), basis in zip(self.states, self._bases, strict=True):
            rest[rows] -= basis @ (basis.T @ a[rows])
        return rest

    def left(self, a: np.ndarray) -> np.ndarray:
        """What of (r, ...) the run's own free parameters and states cannot take up."""
        rest = self.without_states(a)
        if self.own.shape[1]:
            rest = rest - self._own_left @ (np.linalg.pinv(self._own_left) @ rest)
        return rest

    def local_step(self, shared: np.ndarray) -> tuple[np.ndarray, list[np.ndarray]]:
        """Steps of the run's own (k,) and of each segment's state that go best with shared ones."""
        rest = self.residuals + self.shared @ shared
        own = np.zeros(0)
        if self.own.shape[1]:
            own = -np.linalg.pinv(self._own_left) @ self.without_states(rest)
            longest = _LONGEST_OWN if self.longest is None else self.longest
            own = np.clip(own, -longest, longest)
            rest = rest + self.own @ own
        steps = [_damped(columns, rest[rows]) for rows, columns in self.states]
        return own, steps


def _damped(columns: np.ndarray, rest: np.ndarray) -> np.ndarray:
    """Step of a segment's state; in what the motion hardly feels it stays short."""
    square = columns.T @ columns + np.eye(columns.shape[1]) / _FAR**2
    scale = np.sqrt(np.diag(square))
    even = square / np.outer(scale, scale) + _ALIKE * np.eye(scale.size)
    return -np.linalg.solve(even, columns.T @ rest / scale) / scale
