"""How much may be computed to say what a motion is worth: counted in steps, not in seconds.

A limit in seconds of the clock would make what a page says depend on what else the machine does.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf


class OutOfWork(Exception):
    """What was asked for takes more steps than are allowed."""


def unwatched() -> None:
    """Nobody wants to stop."""


@dataclass
class Work:
    """Steps that are left, for runs that take so many for each second of motion.

    look: called now and then, for whoever wants to stop; may raise.
    """

    left: float = inf
    per_second: float = 1.0
    look: Callable[[], None] = unwatched

    def spend(self, seconds: float) -> None:
        """Count so much motion (s); OutOfWork where no steps are left."""
        self.look()
        self.left -= float(seconds) * self.per_second
        if self.left < 0.0:
            raise OutOfWork
