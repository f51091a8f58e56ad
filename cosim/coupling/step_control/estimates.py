"""Estimates of a step's error, as a part of what is allowed."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

import numpy as np

from cosim.coupling.exchange import Exchange
from cosim.coupling.participant import CouplingError
from cosim.coupling.schemes.acceleration import Forgetful, Vector
from cosim.coupling.schemes.iterated import Iterated
from cosim.coupling.schemes.scheme import Scheme
from cosim.coupling.step_control.control import Stepper
from cosim.coupling.step_control.power_bond import PowerBond
from cosim.coupling.system import Address, CoupledSystem
from cosim.coupling.tolerance import Tolerance


class Estimate(Forgetful):
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

    more = 1  # a step's length times the first power that the polynomial lacks

    def check(self, system: CoupledSystem) -> list[str]:
        """Every bond is one, and its product a power."""
        remarks = [bond.check(system) for bond in self.bonds]
        self._watts = tuple(bond.watts(system) for bond in self.bonds)
        return [remark for remark in remarks if remark]

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

    def state(self) -> Any:
        """Energy that has crossed, J."""
        return self._crossed

    def restore(self, state: Any) -> None:
        """Go on with it."""
        self._crossed = float(state)
