"""What a coupling scheme is, and those that make each step once: all at once, or in turn."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from cosim.coupling.exchange import Course, Exchange
from cosim.coupling.participant import CouplingError, capabilities
from cosim.coupling.schemes.acceleration import Forgetful
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


class Scheme(Protocol):
    """How the participants make a macro step together."""

    @property
    def order(self) -> tuple[str, ...]:
        """Participant names, each once, in the order of the initial exchange."""

    @property
    def accuracy(self) -> int:
        """Order of the error of a step's end values in the step's size, over a run."""

    @property
    def needs_restore(self) -> bool:
        """Whether it makes a step more than once."""

    @property
    def free_order(self) -> bool:
        """Whether participants may make a step in any order: none waits for another."""

    def check(self, system: CoupledSystem) -> None:
        """Refuse a system that the scheme does not fit."""

    def unknown(self, system: CoupledSystem) -> tuple[Address, ...]:
        """Connected outputs that a step needs before they are there: extrapolated, or guessed."""

    def step(self, exchange: Exchange, size: float) -> StepDone:
        """One macro step from exchange.time, of length size (s); may raise EndedEarly."""

    def state(self) -> Any:
        """What is remembered from step to step, as nested lists of numbers."""

    def restore(self, state: Any) -> None:
        """Go on from what `state` gave."""


def degree_of(extrapolation: str) -> int:
    """Degree of the polynomial; CouplingError for an extrapolation that there is not."""
    if extrapolation not in EXTRAPOLATIONS:
        allowed = ", ".join(EXTRAPOLATIONS)
        raise CouplingError(f"extrapolation = {extrapolation!r}: must be one of {allowed}")
    return EXTRAPOLATIONS[extrapolation]


def against(system: CoupledSystem, order: Sequence[str]) -> tuple[Address, ...]:
    """Connected outputs that feed somebody who comes before their participant in an order."""
    place = {name: number for number, name in enumerate(order)}
    found = [
        connection.source
        for connection in system.connections
        if place[connection.source.participant] >= place[connection.sink.participant]
    ]
    return tuple(dict.fromkeys(found))


def step_together(exchange: Exchange, name: str, size: float, first: bool) -> float:
    """Step a participant; the size that it made, which for all but the first is as asked for."""
    made = exchange.step(name, size)
    if made < size and not first:
        raise EndedEarly(name, made)
    return made


def ending_early_first(system: CoupledSystem, names: Sequence[str]) -> tuple[str, ...]:
    """The names, those first that may end a step early: then nobody has to be taken back."""
    return tuple(
        sorted(names, key=lambda name: not capabilities(system.participants[name]).ends_early)
    )


@dataclass(frozen=True)
class OnePass(Forgetful):
    """What the schemes share that make each step once.

    order : participant names, each once; extrapolation : of inputs over a step, of EXTRAPOLATIONS.
    """

    order: tuple[str, ...]
    extrapolation: str = "held"

    needs_restore = False

    @property
    def accuracy(self) -> int:
        """Order of the error in the step's size."""
        return degree_of(self.extrapolation) + 1

    def check(self, system: CoupledSystem) -> None:
        """Refuse a system that this order does not fit."""
        system.check_order(self.order)
        degree_of(self.extrapolation)


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
        degree = degree_of(self.extrapolation)
        made = size
        for place, name in enumerate(names):
            if degree:
                exchange.deliver_over_step(name, course(exchange, set(), degree, size))
            else:
                exchange.deliver(name)
            made = step_together(exchange, name, made, place == 0)
        for name in names:
            exchange.collect(name)
        if self.refresh:
            for name in names:
                exchange.refresh(name)
        return StepDone(made)


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

    free_order = False

    def unknown(self, system: CoupledSystem) -> tuple[Address, ...]:
        """Those that go against the order."""
        return against(system, self.order)

    def step(self, exchange: Exchange, size: float) -> StepDone:
        """One macro step of the whole system, of length size (s)."""
        degree = degree_of(self.extrapolation)
        stepped: set[str] = set()
        for name in self.order:
            if degree:
                exchange.deliver_over_step(name, course(exchange, stepped, degree, size))
            else:
                exchange.deliver(name)
            size = step_together(exchange, name, size, not stepped)
            exchange.collect(name)
            stepped.add(name)
        return StepDone(size)


def course(exchange: Exchange, stepped: set[str], degree: int, size: float) -> Course:
    """Sources that have stepped are interpolated to the step's end, the others extrapolated."""
    history = exchange.history

    def over_step(source: Address) -> Waveform:
        if source.participant in stepped:
            end = exchange.outputs[source.participant][source.port]
            return history.interpolated(source, degree, size, end)
        return exchange.extrapolated(source, degree, size)

    return over_step
