"""Coupling schemes: how the participants make a macro step together.

A scheme is a small class, a `Scheme`: it reads and writes values through the exchange alone, so
that a further one needs no change elsewhere. Some make each step once, with all participants at
once or in turn. An iterated (implicit) step is made again until what is handed over at its end is
consistent, and goes on from one guess to the next as all fixed-point iterations x = h(x) do: values
come in parts of their nominals, so that ports of several units meet in one vector.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence, Set
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from cosim.coupling.exchange import Course, Exchange
from cosim.coupling.participant import CouplingError, ParticipantError, capabilities
from cosim.coupling.system import Address, CoupledSystem
from cosim.coupling.tolerance import Tolerance, bounds, nominals
from cosim.coupling.waveform import Waveform

#: Name of an extrapolation -> degree of the polynomial.
EXTRAPOLATIONS = {"held": 0, "linear": 1, "quadratic": 2}


@dataclass(frozen=True)
class StepDone:
    """How a step came out.

    size: made, s, smaller than asked for where a participant ended it; iterations: 1 without an
    iteration; residual: largest change of the last iteration, as a part of what is allowed;
    worst: the port that it is of; converged: whether all changes were allowed.
    """

    size: float
    iterations: int = 1
    residual: float = 0.0
    worst: str = ""
    converged: bool = True


class EndedEarly(Exception):
    """A participant ended its step when others had made it already; it came to `size` (s).

    The step is to be taken back and made again, as long as that.
    """

    def __init__(self, name: str, size: float):
        super().__init__(f"{name} ended its step early, after {size:.9g} s")
        self.name, self.size = name, size


class Remembers:
    """What is remembered from step to step, `remembered` by its names: nothing, left out.

    A checkpoint has it as JSON.
    """

    remembered: ClassVar[tuple[str, ...]] = ()

    def state(self) -> Any:
        """What a run that goes on needs."""
        return {name: getattr(self, name) for name in self.remembered}

    def restore(self, state: Any) -> None:
        """Go on from what `state` gave."""
        vars(self).update(state)


class Scheme(Remembers, ABC):
    """How the participants make a macro step together.

    order: participant names, each once, in the order of the initial exchange. needs_restore:
    whether it makes a step more than once. free_order: whether participants may make a step in any
    order, as none waits for another.
    """

    order: tuple[str, ...]
    needs_restore: ClassVar[bool] = False
    free_order: ClassVar[bool] = False

    @property
    @abstractmethod
    def degree(self) -> int:
        """Of the polynomial that inputs follow over a step."""

    @property
    def accuracy(self) -> int:
        """Order of the error of a step's end values in the step's size, over a run."""
        return self.degree + 1

    def check(self, system: CoupledSystem) -> None:
        """Refuse a system that this order does not fit, and settings that cannot be."""
        system.check_order(self.order)
        _ = self.degree  # which refuses what there is none of

    def unknown(self, system: CoupledSystem) -> tuple[Address, ...]:
        """Connected outputs that a step needs before they are there: those that feed somebody who
        comes before their participant in the order."""
        place = {name: number for number, name in enumerate(self.order)}
        found = [
            connection.source
            for connection in system.connections
            if place[connection.source.participant] >= place[connection.sink.participant]
        ]
        return tuple(dict.fromkeys(found))

    @abstractmethod
    def step(self, exchange: Exchange, size: float) -> StepDone:
        """One macro step from exchange.time, of length size (s); may raise EndedEarly."""


def degree_of(extrapolation: str) -> int:
    """Degree of the polynomial; CouplingError for an extrapolation that there is not."""
    if extrapolation not in EXTRAPOLATIONS:
        allowed = ", ".join(EXTRAPOLATIONS)
        raise CouplingError(f"extrapolation = {extrapolation!r}: must be one of {allowed}")
    return EXTRAPOLATIONS[extrapolation]


def ending_early_first(system: CoupledSystem, names: Sequence[str]) -> tuple[str, ...]:
    """The names, those first that may end a step early: then nobody has to be taken back."""
    return tuple(
        sorted(names, key=lambda name: not capabilities(system.participants[name]).ends_early)
    )


@dataclass(frozen=True)
class OnePass(Scheme):
    """What the schemes share that make each step once.

    order : participant names, each once; extrapolation : of inputs over a step, of EXTRAPOLATIONS.
    """

    order: tuple[str, ...]
    extrapolation: str = "held"

    @property
    def degree(self) -> int:
        """That of the extrapolation."""
        return degree_of(self.extrapolation)

    def _made(self, exchange: Exchange, name: str, size: float, others: Set[str]) -> float:
        """Let a participant step; the size that it made, which beside others is as asked for.

        others: who has made the step already.
        """
        if self.degree:
            known = set() if self.free_order else others
            exchange.deliver_over_step(name, course(exchange, known, self.degree, size))
        else:
            exchange.deliver(name)
        made = exchange.step(name, size)
        if made < size and others:
            raise EndedEarly(name, made)
        return made


@dataclass(frozen=True)
class Jacobi(OnePass):
    """Nobody waits for anybody: inputs over the step come from the communication points before it.

    extrapolation : "held", "linear" or "quadratic", of order 1, 2 and 3 in the macro step where the
    participants follow it. Busch, "Continuous approximation techniques for co-simulation methods",
    ZAMM 96 (2016).
    order: participant names, each once; only the initial exchange goes by it. refresh: at the end
    of a step let outputs that depend on inputs at once follow from the inputs there. Without,
    such an output is of the step's start: cheaper, and unstable at smaller steps.
    """

    refresh: bool = True

    free_order = True

    def unknown(self, system: CoupledSystem) -> tuple[Address, ...]:
        """All connected outputs."""
        return system.sources

    def step(self, exchange: Exchange, size: float) -> StepDone:
        """One macro step of the whole system, of length size (s)."""
        names = ending_early_first(exchange.system, self.order)
        for place, name in enumerate(names):
            size = self._made(exchange, name, size, {*names[:place]})
        for name in names:
            exchange.collect(name)
        if self.refresh:
            for name in names:
                exchange.refresh(name)
        return StepDone(size)


@dataclass(frozen=True)
class GaussSeidel(OnePass):
    """Participants make each macro step in the stated order.

    The first steps with what is known at the step's start; each later one with the values that
    those before it have reached at the step's end. Held, of first order in the macro step; with
    "linear" or "quadratic" the first extrapolates, and the later ones interpolate: of second and
    third order where they follow it. Busch, "Continuous approximation techniques for
    co-simulation methods", ZAMM 96 (2016).
    order: participant names, each once.
    """

    def step(self, exchange: Exchange, size: float) -> StepDone:
        """One macro step of the whole system, of length size (s)."""
        for place, name in enumerate(self.order):
            size = self._made(exchange, name, size, {*self.order[:place]})
            exchange.collect(name)
        return StepDone(size)


def course(exchange: Exchange, stepped: Set[str], degree: int, size: float) -> Course:
    """Sources that have stepped are interpolated to the step's end, the others extrapolated."""
    history = exchange.history

    def over_step(source: Address) -> Waveform:
        if source.participant in stepped:
            end = exchange.outputs[source.participant][source.port]
            return history.interpolated(source, degree, size, end)
        return exchange.extrapolated(source, degree, size)

    return over_step


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
