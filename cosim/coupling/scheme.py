"""How a coupled run advances: its communication points, and the macro step between two of them.

A scheme is a small class of the shape `Scheme`: it reads and writes values through the exchange
alone, so that a further one needs no change elsewhere. One that makes a step twice asks its
participants for their state (`Restorable`).
"""

import math
from dataclasses import dataclass
from typing import Protocol

from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import CouplingError
from cosim.coupling.system import CoupledSystem

# A remainder below this part of a macro step is rounding in (stop - start) / H, not a step that
# somebody asked for: 1e6 steps leave some 1e-10.
SLIVER = 1e-9


class Scheme(Protocol):
    """How the participants make a macro step together."""

    @property
    def order(self) -> tuple[str, ...]:
        """Participant names, each once, in the order of the initial exchange."""

    def check(self, system: CoupledSystem) -> None:
        """Refuse a system that the scheme does not fit."""

    def step(self, exchange: Exchange, size: float) -> None:
        """One macro step from exchange.time, of length size (s)."""


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


def macro_grid(start: float, stop: float, macro_step: float) -> list[float]:
    """Times t_n = start + n H with the end hit exactly; the last step may be shorter.

    Computed from n, never by adding up, so that nothing drifts.

    >>> macro_grid(0.0, 0.25, 0.1)
    [0.0, 0.1, 0.2, 0.25]
    """
    for key, value in (("start", start), ("stop", stop), ("macro_step", macro_step)):
        if not math.isfinite(value):
            raise CouplingError(f"{key} = {value}: must be a finite number of seconds")
    if macro_step <= 0:
        raise CouplingError(f"macro_step = {macro_step:g} s: must be greater than 0")
    if stop <= start:
        raise CouplingError(f"stop = {stop:g} s: must be later than start = {start:g} s")
    steps = max(1, math.ceil((stop - start) / macro_step - SLIVER))
    times = [start + n * macro_step for n in range(steps)] + [stop]
    if any(late <= early for early, late in zip(times, times[1:], strict=False)):
        raise CouplingError(f"macro_step = {macro_step:g} s: too small to advance {start:g} s")
    return times
