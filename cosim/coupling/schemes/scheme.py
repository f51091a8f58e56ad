"""What a coupling scheme is, and those that make each step once: all at once, or in turn."""

from abc import ABC, abstractmethod
from collections.abc import Sequence, Set
from dataclasses import dataclass
from typing import Any, ClassVar

from cosim.coupling.exchange import Course, Exchange
from cosim.coupling.participant import CouplingError, capabilities
from cosim.coupling.system import Address, CoupledSystem
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
