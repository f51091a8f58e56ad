"""An iterated (implicit) step: made again until what is handed over at its end is consistent.

And how it goes on from one guess to the next, all of fixed-point iterations x = h(x): values
come in parts of their nominals, so that ports of several units meet in one vector.
"""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import CouplingError, ParticipantError
from cosim.coupling.schemes.scheme import EndedEarly, Remembers, Scheme, StepDone, degree_of
from cosim.coupling.system import Address, CoupledSystem
from cosim.coupling.tolerance import Tolerance, bounds, nominals
from cosim.coupling.waveform import Waveform

Vector = NDArray[np.float64]
#: Directions that differ by less than this part of themselves count as one (Haelterman et al.,
#: "Improving the performance of the partitioned QN-ILS procedure", Computers and Structures 2016).
SAME_DIRECTION = 1e-10


@dataclass
class Relaxation(Remembers):
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
    relaxation: of the first iteration, while there is no difference. The differences of the step
    before are used too.
    """

    _now: list[tuple[Vector, Vector]] = field(default_factory=list, repr=False)
    _before: list[tuple[Vector, Vector]] = field(default_factory=list, repr=False)
    _last: tuple[Vector, Vector] | None = field(default=None, repr=False)

    def begin(self) -> None:
        """Keep the differences of the step before."""
        self._before = self._now or self._before
        self._now, self._last = [], None

    def next(self, guess: Vector, found: Vector) -> Vector:
        """h(x) corrected by the combination of differences that takes most of the change away."""
        change = found - guess
        if self._last is not None:
            self._now.append((change - self._last[0], found - self._last[1]))
        self._last = (change, found)
        # the newest first: what is nearly a combination of newer ones is dropped
        changes, founds = independent([*reversed(self._now), *self._before])
        if not changes:
            return guess + self.relaxation * change
        weights, *_ = np.linalg.lstsq(np.column_stack(changes), -change, rcond=None)
        return found + np.column_stack(founds) @ weights

    def state(self) -> list[Any]:
        """The differences that the next step uses."""
        return [(c.tolist(), f.tolist()) for c, f in self._now or self._before]

    def restore(self, state: Any) -> None:
        """Go on with them."""
        self._now, self._last = [], None
        self._before = [(np.array(c), np.array(f)) for c, f in state]


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

    def state(self) -> Any:
        """That of the acceleration."""
        return self.acceleration.state()

    def restore(self, state: Any) -> None:
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
