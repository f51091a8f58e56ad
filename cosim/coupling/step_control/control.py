"""What a step control is: it says where the next step ends, and whether a step may stand."""

from __future__ import annotations

from typing import Any, Protocol

from cosim.coupling.exchange import Exchange
from cosim.coupling.messages import UNCONVERGED
from cosim.coupling.participant import CouplingError
from cosim.coupling.schemes.scheme import EndedEarly, Scheme, StepDone
from cosim.coupling.system import CoupledSystem

STOP, HALVE, ACCEPT = "stop", "halve", "accept"
#: What is done where an iteration does not converge.
POLICIES = (STOP, HALVE, ACCEPT)
#: A step that is made again more often than this is worth a remark: something is not as it should.
OFTEN = 5


class ConvergenceError(RuntimeError):
    """A step that did not converge, or could not be made small enough; one line with a remedy."""


class Stepper:
    """Makes one step by a scheme, repeated where a participant ends it early or it diverges.

    on_divergence : of `POLICIES`; "halve" goes down to `smallest` (s), then it stops.
    """

    def __init__(
        self,
        exchange: Exchange,
        scheme: Scheme,
        *,
        on_divergence: str = STOP,
        smallest: float = 0.0,
        marks: bool = False,
    ):
        if on_divergence not in POLICIES:
            raise CouplingError(
                f"on_divergence = {on_divergence!r}: must be one of {', '.join(POLICIES)}"
            )
        self.exchange: Exchange = exchange
        self.scheme: Scheme = scheme
        self.on_divergence: str = on_divergence
        self.smallest: float = smallest
        self._marks = marks

    def make(self, end: float) -> float:
        """Step from the exchange's time to an end (s), or less far; the time reached, s.

        The step is accepted: a control that takes it back has marked where it began.
        """
        exchange = self.exchange
        began = exchange.time
        assert began is not None
        mark = exchange.mark() if self._marks else None
        size, done, by_event, halved = end - began, None, False, 0
        try:
            while done is None:
                try:
                    done = self.scheme.step(exchange, size)
                except EndedEarly as event:
                    assert mark is not None  # `run` has seen to it
                    exchange.back(mark)
                    exchange.statistics.events += 1
                    size, by_event = event.size, True
                    continue
                exchange.statistics.iterated(done.iterations)
                if not done.converged and self._is_halved(done, size):
                    assert mark is not None
                    exchange.back(mark)
                    size, done, halved = size / 2.0, None, halved + 1
        finally:
            if mark is not None:
                exchange.forget(mark)
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
            self.exchange.statistics.unconverged.append(float(self.exchange.time or 0.0))
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


class StepControl(Protocol):
    """How long the steps are."""

    @property
    def needs_restore(self) -> bool:
        """Whether steps are taken back."""

    @property
    def first_size(self) -> float:
        """Size of the first step, s."""

    def check(self, system: CoupledSystem) -> list[str]:
        """What could not be checked, a line each; CouplingError for a system that does not fit."""

    def begin(self, start: float, stop: float, scheme: Scheme) -> None:
        """Get ready for a run from start to stop (s)."""

    def step(self, stepper: Stepper, stop: float) -> float:
        """Make a step that stands, at most to `stop` (s); the time reached, s."""

    def is_row(self) -> bool:
        """Whether the time reached counts as a communication point of its own for the record."""

    def state(self) -> dict[str, Any]:
        """What the next step depends on, numbers by name."""

    def restore(self, state: dict[str, Any]) -> None:
        """Go on from what `state` gave."""
