"""Runs of a rig: whole ones, and such that can be copied, disturbed and continued for stability.

How much they may compute is counted in steps, not in seconds: a limit in seconds of the clock would
make what a page says depend on what else the machine does.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf

from ..arrays import RunArrays, RunEnded, inputs, interface_temperature
from ..parameters import Parameters
from ..simulation import simulate
from ..trajectory import Trajectory


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


__all__ = ["DRY", "Interface", "RunEnded", "live_run", "simulated", "steps_per_second"]

#: Instants of a run at which the integrator's step is looked at, to know how many there are.
SAMPLES = 200


@dataclass(frozen=True)
class Interface:
    """What friction may feel, constant over a run, and what the runs of an answer may take.

    temperature : degC; None: the reference of temperature_dependence
    film_thickness : mean thickness of the water, m
    work : steps that are left, of which the runs take theirs
    """

    temperature: float | None = None
    film_thickness: float = 0.0
    work: Work = field(default_factory=Work, compare=False)


#: At the reference temperature, without water.
DRY = Interface()


def live_run(parameters: Parameters, interface: Interface = DRY) -> RunArrays:
    """The compiled kernel at the start of a run; interface: its temperature, the water in it."""
    temperature = interface_temperature(parameters, interface.temperature)
    u = inputs(parameters.surface.speed, temperature, interface.film_thickness)
    return RunArrays.begin(parameters.pack(), u, catalogue=parameters.catalogue)


def simulated(
    parameters: Parameters,
    duration: float,
    interval: float,
    interface: Interface,
    whole: bool = True,
) -> Trajectory:
    """A run, whose motion is counted; RunEnded where it is to be whole and ends early."""
    reached = 0.0

    def progress(time: float) -> None:
        nonlocal reached
        interface.work.spend(time - reached)
        reached = time

    run = simulate(
        parameters,
        duration,
        interval,
        interface_temperature=interface.temperature,
        film_thickness=interface.film_thickness,
        progress=progress,
    )
    if whole and not run.complete:
        raise RunEnded(run.reason)
    return run


def steps_per_second(parameters: Parameters, duration: float, interface: Interface = DRY) -> float:
    """Internal steps for a second of a run of ``duration`` (s); RunEnded where it ends early."""
    live = live_run(parameters, interface)
    density = 0.0
    for i in range(SAMPLES):
        live.advance(duration * (i + 1) / SAMPLES)
        density += 1.0 / live.step_size
    return density / SAMPLES
