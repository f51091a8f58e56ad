"""What a step control is: it says where the next step ends, and whether a step may stand.

And the plainest, steps of one size.
"""

import math
from abc import ABC, abstractmethod
from contextlib import nullcontext
from dataclasses import dataclass
from typing import ClassVar

from cosim.coupling.exchange import Exchange
from cosim.coupling.messages import UNCONVERGED
from cosim.coupling.participant import CouplingError
from cosim.coupling.schemes import EndedEarly, Remembers, Scheme, StepDone
from cosim.coupling.system import CoupledSystem

STOP, HALVE, ACCEPT = "stop", "halve", "accept"
#: What is done where an iteration does not converge.
POLICIES = (STOP, HALVE, ACCEPT)
#: A remainder below this part of a macro step is rounding in (stop - start) / H, not a step that
#: somebody asked for: 1e6 steps leave some 1e-10.
SLIVER = 1e-9
#: A step that is made again more often than this is worth a remark: something is not as it should.
OFTEN = 5


class ConvergenceError(RuntimeError):
    """A step that did not converge, or could not be made small enough; one line with a remedy."""


@dataclass
class Stepper:
    """Makes one step by a scheme, repeated where a participant ends it early or it diverges.

    on_divergence : of `POLICIES`; "halve" goes down to `smallest` (s), then it stops. marks :
    whether it may have to go back.
    """

    exchange: Exchange
    scheme: Scheme
    on_divergence: str = STOP
    smallest: float = 0.0
    marks: bool = False

    def __post_init__(self) -> None:
        if self.on_divergence not in POLICIES:
            allowed = ", ".join(POLICIES)
            raise CouplingError(f"on_divergence = {self.on_divergence!r}: must be one of {allowed}")

    def make(self, end: float) -> float:
        """Step from the exchange's time to an end (s), or less far; the time reached, s.

        The step is accepted: a control that takes it back has marked where it began.
        """
        exchange = self.exchange
        began = exchange.now
        size, by_event, halved = end - began, False, 0
        with exchange.marked() if self.marks else nullcontext() as mark:
            while True:
                try:
                    done = self.scheme.step(exchange, size)
                except EndedEarly as event:
                    exchange.statistics.events += 1
                    size, by_event = event.size, True
                else:
                    told = exchange.statistics
                    told.iterations += done.iterations
                    told.most_iterations = max(told.most_iterations, done.iterations)
                    if done.converged or not self._is_halved(done, size):
                        break
                    size, halved = size / 2.0, halved + 1
                assert mark is not None  # `run` has seen to it
                exchange.back(mark)
        if halved > OFTEN:
            exchange.remark(f"did not converge until it was halved {halved} times", began)
        # the end itself where it was reached: began + size may miss it by a rounding
        reached = end if done.size == end - began else began + done.size
        exchange.statistics.events += done.size < size  # of one that nobody had to step back for
        exchange.accept(reached)
        if by_event or done.size < size:
            exchange.history.forget_past()
        return reached

    def _is_halved(self, done: StepDone, size: float) -> bool:
        if self.on_divergence == ACCEPT:
            self.exchange.statistics.unconverged.append(self.exchange.now)
            self.exchange.remark(
                f"a step of {size:.3g} s has not converged in {done.iterations} iterations and "
                f"is accepted: {done.worst} still changes by {done.residual:.3g} times what is "
                "allowed",
                self.exchange.time,
                UNCONVERGED,
            )
            return False
        if self.on_divergence == HALVE and size / 2.0 >= self.smallest:
            self.exchange.statistics.rejected += 1
            return True
        raise ConvergenceError(
            f"the step from t = {self.exchange.time:.9g} s of {size:.3g} s has not converged in "
            f"{done.iterations} iterations: {done.worst} still changes by {done.residual:.3g} "
            "times what is allowed; a smaller macro_step, another acceleration or relaxation, or "
            "more max_iterations may help"
        )


class StepControl(Remembers, ABC):
    """How long the steps are.

    needs_restore: whether steps are taken back.
    """

    needs_restore: ClassVar[bool] = False

    @property
    @abstractmethod
    def first_size(self) -> float:
        """Size of the first step, s."""

    def check(self, system: CoupledSystem) -> list[str]:
        """What could not be checked, a line each; CouplingError for a system that does not fit."""
        return []

    @abstractmethod
    def begin(self, start: float, stop: float, scheme: Scheme) -> None:
        """Get ready for a run from start to stop (s)."""

    @abstractmethod
    def step(self, stepper: Stepper, stop: float) -> float:
        """Make a step that stands, at most to `stop` (s); the time reached, s."""

    def is_row(self) -> bool:
        """Whether the time reached counts as a communication point of its own for the record."""
        return True


@dataclass
class FixedStep(StepControl):
    """Communication points on a grid, and at known events between them.

    The grid is t_n = start + n macro_step (s), computed from n, never by adding up, so that nothing
    drifts; its end is hit exactly, by a last step that may be shorter.
    """

    macro_step: float

    remembered = ("_made", "_on_grid")

    @property
    def first_size(self) -> float:
        """That of all, s."""
        return self.macro_step

    def begin(self, start: float, stop: float, scheme: Scheme) -> None:
        """The grid from start to stop (s)."""
        size = self.macro_step
        for key, value in (("start", start), ("stop", stop), ("macro_step", size)):
            if not math.isfinite(value):
                raise CouplingError(f"{key} = {value}: must be a finite number of seconds")
        if size <= 0:
            raise CouplingError(f"macro_step = {size:g} s: must be greater than 0")
        if stop <= start:
            raise CouplingError(f"stop = {stop:g} s: must be later than start = {start:g} s")
        self._start, self._stop = start, stop
        self._steps = max(1, math.ceil((stop - start) / size - SLIVER))
        # steps are the smaller, the later, in what a number of that size can tell apart
        late = start + (self._steps - 1) * size
        if start + size <= start or late >= stop or late + size <= late:
            raise CouplingError(f"macro_step = {size:g} s: too small to advance {start:g} s")
        self._made, self._on_grid = 0, True

    def step(self, stepper: Stepper, stop: float) -> float:
        """To the next time of the grid, or as far as `stop` or an event lets it."""
        n = self._made + 1
        goal = self._stop if n == self._steps else self._start + n * self.macro_step
        if abs(goal - stop) <= SLIVER * self.macro_step:
            goal = stop  # an event at 0.6 is that of 6 steps of 0.1, which are 0.6000000000000001
        reached = stepper.make(min(goal, stop))
        self._on_grid = reached >= goal
        self._made += self._on_grid
        return reached

    def is_row(self) -> bool:
        """On the grid it is."""
        return self._on_grid
