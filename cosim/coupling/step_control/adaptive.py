"""Steps as long as their error allows; those with a larger one are taken back."""

import math
from dataclasses import dataclass
from typing import Any

from cosim.coupling.exchange import Exchange
from cosim.coupling.messages import SMALLEST
from cosim.coupling.participant import CouplingError
from cosim.coupling.schemes.scheme import Scheme
from cosim.coupling.step_control.control import OFTEN, StepControl, Stepper
from cosim.coupling.step_control.estimates import Estimate
from cosim.coupling.system import CoupledSystem

#: Bounds of the factor from one step to the next.
SHRINK, GROW = 0.2, 5.0
#: Powers of the newest and the last error in a proportional-integral controller, by the exponent of
#: the estimate: PI.4.2 of Soederlind, "Digital filters in adaptive time-stepping", ACM TOMS 29
#: (2003).
NEWEST, LAST = 0.6, 0.2


@dataclass
class AdaptiveStep(StepControl):
    """Each step's error is estimated; the next size follows from it, and one too large is repeated.

    estimate : gives the error as a part of what is allowed. first, smallest, largest : sizes, s.
    safety : part of the size that would just be allowed. A step at the smallest size stands
    whatever its error, and is counted.
    """

    estimate: Estimate
    first: float
    smallest: float
    largest: float
    safety: float = 0.9

    needs_restore = True

    def __post_init__(self) -> None:
        for name in ("smallest", "first", "largest"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise CouplingError(f"{name}_step = {value:g} s: must be a finite number above 0")
        if not self.smallest <= self.first <= self.largest:
            raise CouplingError(
                f"macro_step = {self.first:g} s: must lie between smallest_step = "
                f"{self.smallest:g} s and largest_step = {self.largest:g} s"
            )
        if not 0.0 < self.safety < 1.0:
            raise CouplingError(f"safety = {self.safety:g}: must lie between 0 and 1")

    @property
    def first_size(self) -> float:
        """As it was given, s."""
        return self.first

    def check(self, system: CoupledSystem) -> list[str]:
        """As its estimate does."""
        return self.estimate.check(system)

    def begin(self, start: float, stop: float, scheme: Scheme) -> None:
        """From the first size."""
        if stop <= start:
            raise CouplingError(f"stop = {stop:g} s: must be later than start = {start:g} s")
        self._size, self._error, self._above = self.first, 1.0, 0
        self.estimate.begin(scheme)

    def step(self, stepper: Stepper, stop: float) -> float:
        """Repeat the step until its error is allowed; the time reached, s."""
        exchange = stepper.exchange
        began, refused = exchange.now, 0
        with exchange.marked() as mark:
            while True:
                size = _shared(self._size, stop - began)
                reached, error = self.estimate.make(stepper, stop if size is None else began + size)
                made = reached - began
                if error <= 1.0 or made <= self.smallest * (1.0 + 1e-9):
                    break
                exchange.back(mark)
                exchange.statistics.rejected += 1
                refused += 1
                self._shrink(error, made)
        self._count_above(exchange, error, made, began, stop)
        if refused > OFTEN:
            exchange.remark(f"was taken back {refused} times, to be of {made:.3g} s", began)
        self._follow(error, made, asked=self._size if size is None else size)
        return reached

    def _count_above(
        self, exchange: Exchange, error: float, made: float, began: float, stop: float
    ) -> None:
        """Say where steps begin to be too long and cannot be shorter, and where that is over."""
        if error > 1.0:
            exchange.statistics.above_tolerance.append(began)
            if not self._above:
                exchange.remark(
                    f"a step of {made:.3g} s, the smallest, is accepted with {error:.3g} times the"
                    f" error that is allowed; to t = {stop:.6g} s there would be"
                    f" {(stop - began) / made:.3g} of them",
                    began,
                    SMALLEST,
                )
            self._above += 1
        elif self._above:
            exchange.remark(
                f"{self._above} steps of the smallest size had a larger error than is allowed, of"
                " which this is the first that has not",
                began,
            )
            self._above = 0

    def _shrink(self, error: float, made: float) -> None:
        exponent = self.estimate.exponent
        factor = self.safety * error ** (-1.0 / exponent) if math.isfinite(error) else 0.0
        self._size = max(self.smallest, made * min(max(factor, SHRINK), self.safety))

    def _follow(self, error: float, made: float, asked: float) -> None:
        """The next size; a step that an event or the end has cut says little, and keeps it."""
        error, exponent = max(error, 1e-10), self.estimate.exponent
        factor = self.safety * error ** (-NEWEST / exponent) * self._error ** (LAST / exponent)
        self._error = error
        grown = made * min(max(factor, SHRINK), GROW)
        if made < asked * (1.0 - 1e-9):
            grown = max(grown, self._size) if error <= 1.0 else grown
        self._size = min(max(grown, self.smallest), self.largest)

    def state(self) -> dict[str, Any]:
        """Size, last error, and steps that were too long at last."""
        said = {"size": self._size, "error": self._error, "above": self._above}
        return {**said, "estimate": self.estimate.state()}

    def restore(self, state: dict[str, Any]) -> None:
        """Go on from there."""
        self._size, self._error = float(state["size"]), float(state["error"])
        self._above = int(state.get("above", 0))  # checkpoints of before have none
        self.estimate.restore(state["estimate"])


def _shared(size: float, left: float) -> float | None:
    """A step's size with what is left (s) in mind; None for all of it: no sliver remains."""
    if left <= size * (1.0 + 1e-9):
        return None
    return min(size, left / 2.0)
