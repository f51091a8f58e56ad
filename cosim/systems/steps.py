"""The steps that a run has taken, in so much memory however many there are."""

from __future__ import annotations

import json

import numpy as np
from numpy.typing import NDArray

#: Groups of steps that are kept; of more, neighbours become one.
MOST_GROUPS = 2000


class StepLog:
    """Sizes of the steps over time, each entry of one step or of some neighbouring ones.

    start: of the run, s. `add` is what a run calls with the time that it has reached.
    """

    def __init__(self, start: float):
        self._reached = start
        self._each, self._inside = 1, 0
        #: End, shortest and longest of each group.
        self._groups: list[list[float]] = []
        self.count: int = 0

    def add(self, reached: float) -> None:
        """A step has come to a time, s; the run's start, or that of a part of it, is none."""
        if reached <= self._reached:
            return
        size, self._reached = reached - self._reached, reached
        self.count += 1
        group = [reached, size, size]
        if self._inside:
            group = _as_one(self._groups.pop(), group)
        elif len(self._groups) >= MOST_GROUPS:
            self._groups = [*map(_as_one, self._groups[::2], self._groups[1::2])]
            self._each *= 2
        self._groups.append(group)
        self._inside = (self._inside + 1) % self._each

    def save_state(self) -> bytes:
        """All of it, for a run that is cut off."""
        return json.dumps(vars(self)).encode("utf-8")

    def load_state(self, saved: bytes) -> None:
        """Go on from what `save_state` gave."""
        vars(self).update(json.loads(saved))

    @property
    def groups(self) -> NDArray[np.float64]:
        """Time at which each group of steps ends, its smallest and its largest step, s: (3, k)."""
        return np.reshape(self._groups, (-1, 3)).T


def _as_one(before: list[float], after: list[float]) -> list[float]:
    """Two neighbours."""
    return [after[0], min(before[1], after[1]), max(before[2], after[2])]
