"""An iterated (implicit) step: made again until what is handed over at its end is consistent."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import CouplingError, ParticipantError
from cosim.coupling.schemes.acceleration import QuasiNewton, Relaxation, Vector
from cosim.coupling.schemes.scheme import EndedEarly, Scheme, StepDone, degree_of
from cosim.coupling.system import Address, CoupledSystem
from cosim.coupling.tolerance import Tolerance, bounds, nominals
from cosim.coupling.waveform import Waveform

SWEEPS = ("gauss_seidel", "jacobi")


#: Of a step's iteration: outputs that are guessed, and, (n,) each, absolute tolerances, nominal
#: values, and what they may be.
Plan = tuple[tuple[Address, ...], Vector, Vector, tuple[Vector, Vector]]


@dataclass
class Iterated(Scheme):
    """Participants go back and repeat the step until its end values change no more than allowed.

    An input over the step is the value at its end ("held"), or runs "linear" from start to end, or
    "quadratic" through the point before: of order 1, 2 and 3 where the participants follow it.
    order : participant names, each once; sweep : "gauss_seidel", in which later ones of the order
    have what the earlier ones have just come to, and only what goes against the order is guessed,
    or "jacobi", in which all is guessed; acceleration : makes the next guess.
    """

    order: tuple[str, ...]
    waveform: str = "linear"
    sweep: str = "gauss_seidel"
    acceleration: Relaxation = field(default_factory=QuasiNewton)
    tolerance: Tolerance = field(default_factory=Tolerance)
    most_iterations: int = 20

    needs_restore = True

    def __post_init__(self) -> None:
        # depends on the system alone: found once
        self._plan: tuple[CoupledSystem, Plan] | None = None

    @property
    def degree(self) -> int:
        """That of the waveform."""
        return degree_of(self.waveform)

    def check(self, system: CoupledSystem) -> None:
        """Refuse a system that this order does not fit, and settings that cannot be."""
        super().check(system)
        self.tolerance.check(system)
        if self.sweep not in SWEEPS:
            raise CouplingError(f"sweep = {self.sweep!r}: must be one of {', '.join(SWEEPS)}")
        if self.most_iterations < 1:
            raise CouplingError(f"max_iterations = {self.most_iterations}: must be at least 1")

    def step(self, exchange: Exchange, size: float) -> StepDone:
        """One macro step of the whole system, of length size (s)."""
        guessed, least, scale, within = self._planned(exchange.system)
        ends = [exchange.extrapolated(source, self.degree, size).end for source in guessed]
        guess = np.array(ends).clip(*within)
        plain = None
        self.acceleration.begin()
        with exchange.marked() as mark:
            for iteration in range(1, self.most_iterations + 1):
                if iteration > 1:
                    exchange.back(mark)
                try:
                    found = self._sweep(exchange, guessed, guess, size)
                except ParticipantError:
                    if plain is None:
                        raise
                    # an accelerated guess may be what cannot be: joules handed over and taken back
                    exchange.back(mark)
                    guess = plain
                    found = self._sweep(exchange, guessed, guess, size)
                changes = np.abs(found - guess) / self.tolerance.allowed(least, found)
                if not guessed or changes.max() <= 1.0:
                    return _done(size, iteration, changes, guessed, True)
                if iteration < self.most_iterations:
                    plain = found
                    guess = scale * self.acceleration.next(guess / scale, found / scale)
                    guess = guess.clip(*within)
        return _done(size, self.most_iterations, changes, guessed, False)

    def state(self) -> list[Any]:
        """What is remembered from step to step, as nested lists of numbers."""
        return self.acceleration.state()

    def restore(self, state: list[Any]) -> None:
        """Go on from what `state` gave."""
        self.acceleration.restore(state)

    def _planned(self, system: CoupledSystem) -> Plan:
        if self._plan is None or self._plan[0] is not system:
            guessed = self.unknown(system)
            least, scale = self.tolerance.least(system, guessed), nominals(system, guessed)
            self._plan = system, (guessed, least, scale, bounds(system, guessed))
        return self._plan[1]

    def unknown(self, system: CoupledSystem) -> tuple[Address, ...]:
        """What is guessed: all connected outputs, or those that go against the order."""
        return system.sources if self.sweep == "jacobi" else super().unknown(system)

    def _sweep(
        self, exchange: Exchange, guessed: tuple[Address, ...], guess: Vector, size: float
    ) -> Vector:
        """Let everybody make the step; what then comes of the guessed values."""
        ends, degree = dict(zip(guessed, guess.tolist(), strict=True)), self.degree

        def course(source: Address) -> Waveform:
            end = ends.get(source)
            if end is None:
                end = exchange.outputs[source.participant][source.port]
            return exchange.history.interpolated(source, degree, size, end)

        for name in self.order:
            exchange.deliver_over_step(name, course)
            made = exchange.step(name, size)
            if made < size:
                raise EndedEarly(name, made)
            exchange.collect(name)
        return exchange.values(guessed)


def _done(
    size: float, iterations: int, changes: Vector, guessed: tuple[Address, ...], converged: bool
) -> StepDone:
    if not guessed:
        return StepDone(size)
    worst = int(changes.argmax())
    return StepDone(size, iterations, float(changes[worst]), str(guessed[worst]), converged)
