"""Regimes over speed and mu_s/mu_k, from three starts, beside what is known in closed form."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from stickslip import Parameters
from stickslip.packing import GRAVITY
from stickslip.parameters import EffectTables
from stickslip.reference.coulomb_oscillator import CoulombOscillator
from stickslip.reference.coulomb_starts import BeltStart
from stickslip.steady_motion import Interface, RunEnded
from stickslip.steady_motion.regimes import (
    RAMP,
    REST,
    RIDING,
    SLIDING,
    STICK_SLIP,
    other_starts,
    regime_of,
)

from .case import Case, at_speed, run_length

STARTS = (REST, RIDING, RAMP)
#: Blocks with which the motion along the line is still that of a Coulomb oscillator.
HARMLESS = {"lateral_friction", "structural_damping", "imperfections"}


@dataclass(frozen=True)
class RegimeMap:
    """Names of regimes (3, n, m) from `STARTS`, at ratios mu_s/mu_k (n,) and speeds (m,) m/s.

    simulated: by the model; an empty name is a run that ended early. closed_form: of the Coulomb
    oscillator with the same numbers; None where the scenario's motion is not that of one.
    """

    ratios: np.ndarray
    speeds: np.ndarray
    simulated: np.ndarray
    closed_form: np.ndarray | None
    fastest_from_rest: float | None

    @property
    def wrong(self) -> int | None:
        """Cells, of all three starts, in which simulation and closed form differ."""
        if self.closed_form is None:
            return None
        return int(np.sum((self.simulated != self.closed_form) & (self.simulated != "")))


def regime_map(
    case: Case, ratios: np.ndarray, speeds: np.ndarray, done: Callable[[int], object]
) -> RegimeMap:
    """The map around a case, whose mu_k is kept; ``done`` is called with 1 after each cell."""
    simulated = np.full((len(STARTS), len(ratios), len(speeds)), "", dtype=object)
    closed = simulated.copy()
    known = is_coulomb_oscillator(case.parameters)
    for i, ratio in enumerate(ratios):
        for j, speed in enumerate(speeds):
            parameters = _with_ratio(at_speed(case.parameters, speed), ratio)
            simulated[:, i, j] = _simulated(parameters, case.interface)
            if known:
                closed[:, i, j] = predicted(parameters)
            done(1)
    fastest = belt_start(case.parameters).fastest_from_rest if known else None
    return RegimeMap(
        np.asarray(ratios), np.asarray(speeds), simulated, closed if known else None, fastest
    )


def _with_ratio(parameters: Parameters, ratio: float) -> Parameters:
    friction = parameters.friction
    changed = friction.model_copy(update={"mu_s": ratio * friction.mu_k})
    return parameters.model_copy(update={"friction": changed})


def _simulated(parameters: Parameters, interface: Interface) -> list[str]:
    starts = other_starts(parameters)
    names = []
    for start in STARTS:
        started = starts[start]
        try:
            names.append(regime_of(started, run_length(started), interface).name)
        except RunEnded:
            names.append("")
    return names


def is_coulomb_oscillator(parameters: Parameters) -> bool:
    """Is the motion along the line that of `BeltStart`?

    Imperfections of a hundredth move the borders by as much.
    """
    plain = Parameters()
    effects = set(EffectTables.model_fields) - HARMLESS
    return (
        all(getattr(parameters, name) == getattr(plain, name) for name in effects)
        and parameters.rig.surface == "belt"
        and not parameters.springs.force_curve_extension
        and parameters.friction.stick_creep == 0.0
        and parameters.structural_damping.coefficient < _critical_damping(parameters)
    )


def _critical_damping(parameters: Parameters) -> float:
    """Above it, N s/m, the block does not vibrate."""
    return 4.0 * math.pi * parameters.natural_frequency * parameters.rig.mass


def belt_start(parameters: Parameters) -> BeltStart:
    """The oscillator of the motion along the line, on a belt that runs up as that of RAMP."""
    rig, friction, load = parameters.rig, parameters.friction, parameters.rig.mass * GRAVITY
    return BeltStart(
        CoulombOscillator(
            rig.mass,
            4.0 * parameters.springs.stiffness,
            abs(parameters.surface.speed),
            max(friction.mu_s, friction.mu_k) * load,
            friction.mu_k * load,
        ),
        parameters.structural_damping.coefficient,
        other_starts(parameters)[RAMP].surface.run_up_time,
    )


def predicted(parameters: Parameters) -> list[str]:
    """Names of the regimes from `STARTS` in closed form."""
    start = belt_start(parameters)
    sticks = {
        REST: start.sticks_from_rest(),
        RIDING: start.sticks_riding(),
        RAMP: start.sticks_after_run_up(),
    }
    return [STICK_SLIP if sticks[name] else SLIDING for name in STARTS]
