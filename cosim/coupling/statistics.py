"""Who did how much in a coupled run."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field


@dataclass
class Effort:
    """Of one participant: steps made, repeated ones included, and the time in them, s."""

    steps: int = 0
    seconds: float = 0.0


@dataclass
class Statistics:
    """Of a coupled run.

    participants: name -> its effort. steps: macro steps accepted; rejected: taken back by the step
    control; iterations: of the scheme, over all steps made; most_iterations: of one step; events:
    steps that a participant ended early; unconverged: starts of accepted steps whose iteration had
    not converged, s; above_tolerance: of those accepted at the smallest size with a larger error.
    """

    participants: dict[str, Effort] = field(default_factory=dict)
    steps: int = 0
    rejected: int = 0
    iterations: int = 0
    most_iterations: int = 0
    events: int = 0
    unconverged: list[float] = field(default_factory=list)
    above_tolerance: list[float] = field(default_factory=list)

    def __init__(self, names: Iterable[str] = ()):
        self.participants = {name: Effort() for name in names}
        self.unconverged, self.above_tolerance = [], []

    def stepped(self, name: str, seconds: float) -> None:
        """A participant has made a step."""
        effort = self.participants[name]
        effort.steps += 1
        effort.seconds += seconds

    def iterated(self, iterations: int) -> None:
        """A scheme has made a step in so many iterations."""
        self.iterations += iterations
        self.most_iterations = max(self.most_iterations, iterations)
