"""Steps as long as their error allows; those with a larger one are taken back.

The error of a step is estimated, as a part of what is allowed: from outputs, or from the energy
that goes over pairs of connections.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from cosim.coupling.conversion import POWER, told_dimension
from cosim.coupling.exchange import Exchange
from cosim.coupling.messages import SMALLEST
from cosim.coupling.participant import CouplingError
from cosim.coupling.schemes import Iterated, Remembers, Scheme, Vector
from cosim.coupling.step_control.control import OFTEN, StepControl, Stepper
from cosim.coupling.system import Address, Connection, CoupledSystem, find_port
from cosim.coupling.tolerance import Tolerance

#: Exponents of a unit that count: the radian, the last of them, is a number.
COUNTED = 7


@dataclass(frozen=True)
class PowerBond:
    """A pair of connections whose product is a power.

    effort, flow : outputs (`participant.port`) that feed each other's participants: force and
    velocity, moment and rate of turn. What one side gives in a step the other has to take: with
    inputs that are extrapolated, their difference is energy that comes from nowhere.
    """

    effort: Address
    flow: Address

    def __init__(self, effort: str, flow: str):
        vars(self).update(effort=Address.parse(effort), flow=Address.parse(flow))

    def __str__(self) -> str:
        return f"{self.effort} with {self.flow}"

    def watts(self, system: CoupledSystem) -> tuple[float, str]:
        """W that the product of the two is in, as 1000 of kN and m/s; and a remark, else "", where
        nobody says what a unit means: then it is 1.

        CouplingError for no power bond: both are connected, to each other's participants, and their
        product is a power, by what their units are made of.
        """
        for source, sink in ((self.effort, self.flow), (self.flow, self.effort)):
            find_port(system.participants, source)
            feed = _feed(system, source, sink.participant)
            if system.conversions[feed].factor == 0.0:
                raise CouplingError(
                    f"power bond {self}: {feed} has the factor 0, allowed is another"
                )
        ports = [find_port(system.participants, each) for each in (self.effort, self.flow)]
        units = " times ".join("no unit" if port.unit == "1" else port.unit for port in ports)
        first, second = (port.definition for port in ports)
        if first is None or second is None:
            said = f"power bond {self}: whether {units} is a power is not checked: not defined"
            return 1.0, said
        exponents = [a + b for a, b in zip(first.exponents, second.exponents, strict=True)]
        if tuple(exponents[:COUNTED]) != POWER[:COUNTED] or first.offset or second.offset:
            raise CouplingError(
                f"power bond {self}: {units} ({told_dimension(exponents)}) is no power, allowed "
                "are two outputs whose product is one, as force and velocity, in W or multiples"
            )
        return first.factor * second.factor, ""

    def values(self, exchange: Exchange) -> tuple[float, float, float, float]:
        """Effort given, effort got, flow given, flow got in the step that has just been made."""
        return (
            *_both_ends(exchange, self.effort, self.flow.participant),
            *_both_ends(exchange, self.flow, self.effort.participant),
        )


def _feed(system: CoupledSystem, source: Address, sink: str) -> Connection:
    for each in system.connections:
        if each.source == source and each.sink.participant == sink:
            return each
    raise CouplingError(f"power bond: {source} does not feed {sink}, allowed are outputs that do")


def _both_ends(exchange: Exchange, source: Address, sink: str) -> tuple[float, float]:
    """Value that a source gives, and what the participant at the other end stepped with.

    Both as the source counts: a force that is turned round on its way is the same force.
    """
    feed = _feed(exchange.system, source, sink)
    got = exchange.inputs[sink][feed.sink.port]
    way = exchange.system.conversions[feed]
    given = exchange.outputs[source.participant][source.port]
    return given, (got - way.offset) / way.factor


class Estimate(Remembers):
    """Makes a step and says how large its error is.

    more: powers of the step's size by which the error of a step is smaller than what the scheme is
    off by over a run.
    """

    more: ClassVar[int] = 0

    def check(self, system: CoupledSystem) -> list[str]:
        """What could not be checked, a line each; CouplingError for a system that does not fit."""
        return []

    def begin(self, scheme: Scheme) -> None:
        """A run with a scheme begins."""
        self._accuracy = scheme.accuracy

    @property
    def exponent(self) -> float:
        """Power of the step's size that the error goes with."""
        return float(self._accuracy + self.more)

    def make(self, stepper: Stepper, end: float) -> tuple[float, float]:
        """Step to an end (s) or less far: the time reached, s, and error / allowed."""
        raise NotImplementedError


@dataclass
class OfOutputs(Estimate):
    """Compares values of outputs, of which any will do."""

    tolerance: Tolerance = field(default_factory=Tolerance)

    def check(self, system: CoupledSystem) -> list[str]:
        """The tolerances are those of its ports."""
        self.tolerance.check(system)
        return []

    def largest(
        self, exchange: Exchange, which: tuple[Address, ...], expected: Vector, times: float = 1.0
    ) -> float:
        """Error of some outputs as a part of what is allowed, the largest.

        times: how often it is in the difference from what was expected, (n,).
        """
        if not which:
            return 0.0
        found = exchange.values(which)
        allowed = self.tolerance.allowed(self.tolerance.least(exchange.system, which), found)
        return float((np.abs(found - expected) / times / allowed).max())


class Doubling(OfOutputs):
    """The step is made once whole and once in two halves, which stand.

    Their difference over 2^p - 1, p the scheme's order, is the error of the halves (Richardson).
    Three steps for two; of all connected outputs.
    """

    more = 1

    def make(self, stepper: Stepper, end: float) -> tuple[float, float]:
        """Whole, back, and in halves."""
        exchange = stepper.exchange
        began, which = exchange.now, exchange.system.sources
        with exchange.marked() as mark:
            end = stepper.make(end)
            whole = exchange.values(which)
            exchange.back(mark)
        for goal in (began + (end - began) / 2.0, end):
            reached = stepper.make(goal)
            if reached < goal:
                return reached, 0.0  # an event came first: a step of less than the size
        return reached, self.largest(exchange, which, whole, 2.0**self._accuracy - 1.0)


class Defect(OfOutputs):
    """What inputs were extrapolated to at the step's end, against what has come of them.

    Costs no further step. Of the outputs that the scheme needs before they are there. Joules handed
    over since the start are held by every scheme, so theirs is what the step has handed over.
    """

    def make(self, stepper: Stepper, end: float) -> tuple[float, float]:
        """One step."""
        exchange, degree = stepper.exchange, self._accuracy - 1
        began, which = exchange.now, stepper.scheme.unknown(exchange.system)
        courses = [exchange.extrapolated(source, degree, end - began) for source in which]
        reached = stepper.make(end)
        expected = np.array([course.at(reached - began) for course in courses])
        return reached, self.largest(exchange, which, expected)


@dataclass
class EnergyResidual(Estimate):
    """Energy that a step makes or loses on power bonds, against what has crossed them.

    dE = h (effort given x flow got - effort got x flow given) at the step's end: Sadjina and
    others, "Energy conservation and power bonds in co-simulations", Engineering with Computers 33
    (2017). Allowed is `absolute` (J) + `relative` of the largest energy that had crossed a bond,
    summed over the steps as a magnitude.
    """

    bonds: Sequence[PowerBond]
    relative: float = 1e-3
    absolute: float = 1e-9
    _crossed: float = 0.0
    _watts: tuple[float, ...] = ()

    remembered = ("_crossed",)
    more = 1  # a step's length times the first power that the polynomial lacks

    def check(self, system: CoupledSystem) -> list[str]:
        """Every bond is one, and its product a power."""
        found = [bond.watts(system) for bond in self.bonds]
        self._watts = tuple(watts for watts, _ in found)
        return [remark for _, remark in found if remark]

    def begin(self, scheme: Scheme) -> None:
        """Nothing has crossed yet."""
        if not self.bonds:
            raise CouplingError("step_control = 'energy': needs at least one power bond")
        if isinstance(scheme, Iterated):
            # both ends agree there, however long the step: nothing would hold it back
            raise CouplingError(
                "step_control = 'energy': measures what extrapolated inputs are off by, and "
                "scheme = 'iterated' has none; allowed are gauss_seidel and jacobi"
            )
        super().begin(scheme)
        self._crossed = 0.0

    def make(self, stepper: Stepper, end: float) -> tuple[float, float]:
        """One step."""
        exchange = stepper.exchange
        began = exchange.now
        reached = stepper.make(end)
        lost, crossed = 0.0, 0.0
        for bond, watts in zip(self.bonds, self._watts, strict=True):
            effort, effort_got, flow, flow_got = bond.values(exchange)
            joules = watts * (reached - began)
            lost += joules * abs(effort * flow_got - effort_got * flow)
            crossed += joules * abs(effort * flow)
        error = lost / (self.absolute + self.relative * max(self._crossed, crossed))
        if error <= 1.0:
            self._crossed = max(self._crossed, crossed)
        return reached, error


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
    remembered = ("_size", "_error", "_above")

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

    def state(self) -> Any:
        """With what the estimate remembers."""
        return [super().state(), self.estimate.state()]

    def restore(self, state: Any) -> None:
        """Go on from there."""
        super().restore(state[0])
        self.estimate.restore(state[1])


def _shared(size: float, left: float) -> float | None:
    """A step's size with what is left (s) in mind; None for all of it: no sliver remains."""
    if left <= size * (1.0 + 1e-9):
        return None
    return min(size, left / 2.0)
