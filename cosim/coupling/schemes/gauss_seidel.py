"""Gauss-Seidel: one participant after the other, each with what those before it have reached."""

from __future__ import annotations

from dataclasses import dataclass

from cosim.coupling.exchange import Course, Exchange
from cosim.coupling.schemes.scheme import OnePass, StepDone, against, degree_of, step_together
from cosim.coupling.system import Address, CoupledSystem
from cosim.coupling.waveform import Waveform


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
