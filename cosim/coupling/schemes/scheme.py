"""What a coupling scheme is: how the participants make a macro step together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import CouplingError, capabilities
from cosim.coupling.system import Address, CoupledSystem

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


def degree_of(extrapolation: str) -> int:
    """Degree of the polynomial; CouplingError for an extrapolation that there is not."""
    if extrapolation not in EXTRAPOLATIONS:
        allowed = ", ".join(EXTRAPOLATIONS)
        raise CouplingError(f"extrapolation = {extrapolation!r}: must be one of {allowed}")
    return EXTRAPOLATIONS[extrapolation]


def sources(system: CoupledSystem) -> tuple[Address, ...]:
    """All connected outputs."""
    return tuple(dict.fromkeys(connection.source for connection in system.connections))


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
