"""How much may be computed to say what a motion is worth: counted in steps, not in seconds.

A limit in seconds of the clock would make what a page says depend on what else the machine does.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf

from ..parameters import Parameters
from ..simulation import simulate
from ..trajectory import Trajectory
from .live import DRY, Interface, live_run

#: Instants of a run at which the integrator's step is looked at, to know how many there are.
SAMPLES = 200


class OutOfWork(Exception):
    """What was asked for takes more steps than are allowed."""


class Work:
    """Steps that are left, for runs that take so many for each second of motion.

    look: called now and then, for whoever wants to stop; may raise.
    """

    def __init__(
        self, steps: float = inf, per_second: float = 1.0, look: Callable[[], None] = lambda: None
    ) -> None:
        self.left, self.per_second, self.look = steps, per_second, look

    def spend(self, seconds: float) -> None:
        """Count so much motion (s); OutOfWork where no steps are left."""
        self.look()
        self.left -= float(seconds) * self.per_second
        if self.left < 0.0:
            raise OutOfWork

    def simulate(
        self, parameters: Parameters, duration: float, interval: float, interface: Interface = DRY
    ) -> Trajectory:
        """A run, whose motion is counted."""
        reached = 0.0

        def progress(time: float) -> None:
            nonlocal reached
            self.spend(time - reached)
            reached = time

        return simulate(
            parameters,
            duration,
            interval,
            interface_temperature=interface.temperature,
            film_thickness=interface.film_thickness,
            progress=progress,
        )


def steps_per_second(parameters: Parameters, duration: float, interface: Interface = DRY) -> float:
    """Internal steps for a second of a run of ``duration`` (s); RunEnded where it ends early."""
    live = live_run(parameters, interface)
    density = 0.0
    for i in range(SAMPLES):
        live.advance(duration * (i + 1) / SAMPLES)
        density += 1.0 / live.step_size
    return density / SAMPLES
