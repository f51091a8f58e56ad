"""Schemes that make each step once: all participants at once, or one after the other."""

from __future__ import annotations

from dataclasses import dataclass

from cosim.coupling.exchange import Course, Exchange
from cosim.coupling.schemes.scheme import (
    StepDone,
    against,
    degree_of,
    ending_early_first,
    sources,
    step_together,
)
from cosim.coupling.system import Address, CoupledSystem
from cosim.coupling.waveform import Waveform


@dataclass(frozen=True)
class OnePass:
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
        return sources(system)

    def step(self, exchange: Exchange, size: float) -> StepDone:
        """One macro step of the whole system, of length size (s)."""
        names = ending_early_first(exchange.system, self.order)
        degree = degree_of(self.extrapolation)
        made = size
        for place, name in enumerate(names):
            if degree:
                exchange.deliver_over_step(
                    name,
                    lambda source: exchange.extrapolated(source, degree, size),
                )
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
