"""Gauss-Seidel coupling: one after the other, the later ones see the new values."""

from dataclasses import dataclass

from cosim.coupling.exchange import Exchange
from cosim.coupling.system import CoupledSystem


@dataclass(frozen=True)
class GaussSeidel:
    """Participants make each macro step in the stated order, inputs held over the step.

    The first steps with the values of the step's start; each later one with the values that
    those before it have reached at the step's end. Of first order in the macro step: Busch,
    "Continuous approximation techniques for co-simulation methods", ZAMM 96 (2016).
    order: participant names, each once.
    """

    order: tuple[str, ...]

    def check(self, system: CoupledSystem) -> None:
        """Refuse a system that this order does not fit."""
        system.check_order(self.order)

    def step(self, exchange: Exchange, size: float) -> None:
        """One macro step of the whole system, of length size (s)."""
        for name in self.order:
            exchange.deliver(name)
            exchange.step(name, size)
            exchange.collect(name)
