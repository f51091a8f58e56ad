"""Jacobi: all participants step with what was known at the step's start."""

from __future__ import annotations

from dataclasses import dataclass

from cosim.coupling.exchange import Exchange
from cosim.coupling.schemes.scheme import (
    OnePass,
    StepDone,
    degree_of,
    ending_early_first,
    sources,
    step_together,
)
from cosim.coupling.system import Address, CoupledSystem


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
