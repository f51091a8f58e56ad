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
        self._ends: list[float] = []
        self._shortest: list[float] = []
        self._longest: list[float] = []
        self.count: int = 0

    def add(self, reached: float) -> None:
        """A step has come to a time, s; the run's start, or that of a part of it, is none."""
        if reached <= self._reached:
            return
        size, self._reached = reached - self._reached, reached
        self.count += 1
        if self._inside == 0:
            if len(self._ends) >= MOST_GROUPS:
                self._merge()
            self._ends.append(reached)
            self._shortest.append(size)
            self._longest.append(size)
        else:
            self._ends[-1] = reached
            self._shortest[-1] = min(self._shortest[-1], size)
            self._longest[-1] = max(self._longest[-1], size)
        self._inside = (self._inside + 1) % self._each

    def save_state(self) -> bytes:
        """All of it, for a run that is cut off."""
        return json.dumps(vars(self)).encode("utf-8")

    def load_state(self, saved: bytes) -> None:
        """Go on from what `save_state` gave."""
        vars(self).update(json.loads(saved))

    def _merge(self) -> None:
        """Two neighbours become one."""
        self._ends = self._ends[1::2]
        pairs = range(0, 2 * len(self._ends), 2)
        self._shortest = [min(self._shortest[n : n + 2]) for n in pairs]
        self._longest = [max(self._longest[n : n + 2]) for n in pairs]
        self._each *= 2

    @property
    def ends(self) -> NDArray[np.float64]:
        """Time at which each group of steps ends, s, (k,)."""
        return np.array(self._ends)

    @property
    def shortest(self) -> NDArray[np.float64]:
        """Smallest step of each group, s, (k,)."""
        return np.array(self._shortest)

    @property
    def longest(self) -> NDArray[np.float64]:
        """Largest step of each group, s, (k,)."""
        return np.array(self._longest)
