"""Scheme and step control from what a table [coupling] says."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from cosim.coupling.schemes import (
    Aitken,
    GaussSeidel,
    Iterated,
    Jacobi,
    QuasiNewton,
    Relaxation,
    Scheme,
)
from cosim.coupling.step_control.adaptive import (
    AdaptiveStep,
    Defect,
    Doubling,
    EnergyResidual,
    Estimate,
    PowerBond,
)
from cosim.coupling.step_control.control import FixedStep, StepControl
from cosim.coupling.tolerance import Tolerance

if TYPE_CHECKING:
    from cosim.scenario.method import Method

#: Parts and multiples of macro_step that a step control keeps to where nothing is said.
SMALLEST, LARGEST = 1e-3, 100.0


def scheme_of(settings: "Method", order: tuple[str, ...]) -> Scheme:
    """The scheme; order: participant names, each once."""
    if settings.scheme == "gauss_seidel":
        return GaussSeidel(order, settings.extrapolation)
    if settings.scheme == "jacobi":
        return Jacobi(order, settings.extrapolation)
    return Iterated(
        order,
        waveform=settings.waveform,
        sweep=settings.sweep,
        acceleration=_acceleration(settings),
        tolerance=Tolerance(settings.relative_tolerance, settings.absolute_tolerances),
        most_iterations=settings.max_iterations,
    )


def control_of(
    settings: "Method", macro_step: float, bonds: Sequence[tuple[str, str]] = ()
) -> StepControl:
    """The step control; macro_step: of fixed steps, else the first one, s.

    bonds: pairs of outputs whose product is a power, for control by energy.
    """
    if settings.step_control == "fixed":
        return FixedStep(macro_step)
    return AdaptiveStep(
        _estimate(settings, bonds),
        first=macro_step,
        smallest=smallest_step(settings, macro_step),
        largest=settings.largest_step or LARGEST * macro_step,
        safety=settings.safety,
    )


def smallest_step(settings: "Method", macro_step: float) -> float:
    """The shortest step, s, of a control or of halving."""
    return settings.smallest_step or SMALLEST * macro_step


def _acceleration(settings: "Method") -> Relaxation:
    if settings.acceleration == "none":
        return Relaxation()
    kinds = {"constant": Relaxation, "aitken": Aitken, "iqn_ils": QuasiNewton}
    return kinds[settings.acceleration](settings.relaxation)


def _estimate(settings: "Method", bonds: Sequence[tuple[str, str]]) -> Estimate:
    tolerance = Tolerance(settings.step_tolerance, settings.absolute_tolerances)
    if settings.step_control == "doubling":
        return Doubling(tolerance)
    if settings.step_control == "defect":
        return Defect(tolerance)
    pairs = [PowerBond(effort, flow) for effort, flow in bonds]
    return EnergyResidual(pairs, relative=settings.step_tolerance)
