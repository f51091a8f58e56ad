"""How the experiment is run: ramp, constant speed, pause, next run."""

from __future__ import annotations

import math
from dataclasses import dataclass


class StudyError(ValueError):
    """A case that cannot be; one line: what, value, what is allowed."""


#: Most runs in a row: each is followed.
_MOST_RUNS = 100


@dataclass(frozen=True)
class Protocol:
    """One or more runs, the first from belt and ice as cold as the air.

    ramp: from standstill to the speed, evenly, s; run: at constant speed, s; pause: between two
    runs, s, the belt stands still and the ice rests on it, or is lifted off. The study: 10 s and
    20 s; it tells no pause.
    """

    ramp: float = 10.0
    run: float = 20.0
    pause: float = 0.0
    runs: int = 1
    lifted: bool = False

    def __post_init__(self) -> None:
        for name, least in (("ramp", 0.0), ("pause", 0.0)):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= least):
                raise StudyError(f"--{name} = {value:g} s: must be at least 0")
        if not (math.isfinite(self.run) and self.run > 0.0):
            raise StudyError(f"--run = {self.run:g} s: must be above 0")
        if not 1 <= self.runs <= _MOST_RUNS:
            raise StudyError(f"--runs = {self.runs}: must be 1 to {_MOST_RUNS}")

    @property
    def moving(self) -> float:
        """Time at full speed in which the belt goes as far as in one run with its ramp, s."""
        return 0.5 * self.ramp + self.run

    def in_words(self) -> str:
        """As verdicts and figures say it."""
        ramp = f"{self.ramp:g} s of ramp and " if self.ramp > 0.0 else ""
        each = f"{ramp}{self.run:g} s at constant speed"
        if self.runs == 1:
            return each
        return f"{self.runs} runs of {each}, {self.pause:g} s between two"
