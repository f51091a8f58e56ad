"""How an iterated step goes on from one guess to the next: all of fixed-point iterations x = h(x).

Values come in parts of their nominals: ports of several units meet in one vector.
"""

import math
from collections import deque
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cosim.coupling.participant import CouplingError

Vector = NDArray[np.float64]
#: Directions that differ by less than this part of themselves count as one (Haelterman et al.,
#: "Improving the performance of the partitioned QN-ILS procedure", Computers and Structures 2016).
SAME_DIRECTION = 1e-10


class Forgetful:
    """Remembers nothing from step to step."""

    def state(self) -> list[Any]:
        """Nothing."""
        return []

    def restore(self, state: list[Any]) -> None:
        """Nothing to go on from."""


@dataclass
class Relaxation(Forgetful):
    """x + relaxation (h(x) - x): plain iteration for 1, damped below. The others are more of it."""

    relaxation: float = 1.0

    def __post_init__(self) -> None:
        if not 0.0 < self.relaxation <= 2.0:
            raise CouplingError(f"relaxation = {self.relaxation:g}: must be above 0 and at most 2")

    def begin(self) -> None:
        """A step's iteration begins."""

    def next(self, guess: Vector, found: Vector) -> Vector:
        """The next guess (n,), after a guess gave `found`, (n,)."""
        return guess + self.relaxation * (found - guess)


@dataclass
class Aitken(Relaxation):
    """Relaxation by a factor that follows from the last two changes.

    Kuettler and Wall, "Fixed-point fluid-structure interaction solvers with dynamic relaxation",
    Computational Mechanics 43 (2008). relaxation: the factor of a step's first iteration.
    """

    _factor: float = field(default=1.0, repr=False)
    _before: Vector | None = field(default=None, repr=False)

    def begin(self) -> None:
        """Start from `relaxation`."""
        self._factor, self._before = self.relaxation, None

    def next(self, guess: Vector, found: Vector) -> Vector:
        """The guess that a secant through the last two would give for one value."""
        change = found - guess
        if self._before is not None:
            bend = change - self._before
            size = float(bend @ bend)
            if size > 0.0:
                self._factor *= -float(self._before @ bend) / size
        self._before = change
        return guess + self._factor * change


@dataclass
class QuasiNewton(Relaxation):
    """IQN-ILS: Newton with an inverse Jacobian by least squares on the differences of the guesses.

    Degroote, Bathe and Vierendeels, "Performance of a new partitioned procedure versus a monolithic
    procedure in fluid-structure interaction", Computers and Structures 87 (2009).
    relaxation: of the first iteration, while there is no difference. reused: last steps whose
    differences are used too.
    """

    reused: int = 1
    _now: list[tuple[Vector, Vector]] = field(default_factory=list, repr=False)
    _last: tuple[Vector, Vector] | None = field(default=None, repr=False)
    _steps: deque[list[tuple[Vector, Vector]]] = field(default_factory=deque, repr=False)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.reused < 0:
            raise CouplingError(f"reused_steps = {self.reused}: must be 0 or more")
        self._steps = deque(maxlen=self.reused)

    def begin(self) -> None:
        """Keep the differences of the step before."""
        if self._now:
            self._steps.append(self._now)
        self._now, self._last = [], None

    def next(self, guess: Vector, found: Vector) -> Vector:
        """h(x) corrected by the combination of differences that takes most of the change away."""
        change = found - guess
        if self._last is not None:
            self._now.append((change - self._last[0], found - self._last[1]))
        self._last = (change, found)
        # the newest first: what is nearly a combination of newer ones is dropped
        columns = [*reversed(self._now), *(c for step in reversed(self._steps) for c in step)]
        changes, founds = independent(columns)
        if not changes:
            return guess + self.relaxation * change
        weights, *_ = np.linalg.lstsq(np.column_stack(changes), -change, rcond=None)
        return found + np.column_stack(founds) @ weights

    def state(self) -> list[Any]:
        """The differences of the steps that are used again."""
        kept = [*self._steps, self._now] if self._now else list(self._steps)
        return [[(c.tolist(), f.tolist()) for c, f in step] for step in kept]

    def restore(self, state: list[Any]) -> None:
        """Go on with them."""
        self._now, self._last = [], None
        steps = [[(np.array(c), np.array(f)) for c, f in step] for step in state]
        self._steps = deque(steps, maxlen=self.reused)


def independent(columns: list[tuple[Vector, Vector]]) -> tuple[list[Vector], list[Vector]]:
    """Of pairs (change, found), those whose change is no combination of those before.

    By modified Gram-Schmidt; the pairs come back as they were.
    """
    basis: list[Vector] = []
    changes, founds = [], []
    for change, found in columns:
        if len(basis) == change.size:
            break
        rest, size = change.copy(), math.sqrt(float(change @ change))
        for direction in basis:
            rest -= (direction @ rest) * direction
        left = math.sqrt(float(rest @ rest))
        if left > SAME_DIRECTION * size:
            basis.append(rest / left)
            changes.append(change)
            founds.append(found)
    return changes, founds
