"""The scenario that the maps are drawn around."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from stickslip import Parameters
from stickslip.steady_motion import RunEnded, Stability, regimes, stability
from stickslip.steady_motion.pretension import PretensionBorders, pretension_borders
from stickslip.steady_motion.regimes import Regime

from cosim.scenario import Scenario

#: Length of a run after the surface has its speed, s, and in natural periods.
SECONDS, PERIODS = 20.0, 40.0


class NotAMotion(ValueError):
    """A scenario that has no stick-slip motion to be looked at; one line: what, what is allowed."""


@dataclass(frozen=True)
class Case:
    """A scenario's mechanics, how long its runs are (s), and what they come to.

    temperature: of the interface, degC.
    """

    name: str
    parameters: Parameters
    duration: float
    temperature: float
    stability: Stability
    borders: PretensionBorders
    regimes: dict[str, Regime]


def case_of(scenario: Scenario) -> Case:
    """The scenario, looked at for itself. NotAMotion where there is nothing to look at."""
    parameters, temperature = scenario.mechanics, scenario.ambient.temperature_degC
    if parameters.surface.speed == 0.0:
        raise NotAMotion(f"{scenario.name}: surface.speed = 0: needed is a surface that moves")
    if parameters.springs.stiffness == 0.0:
        raise NotAMotion(f"{scenario.name}: springs.stiffness = 0: needed are springs")
    duration = run_length(parameters)
    try:
        return Case(
            scenario.name, parameters, duration, temperature,
            stability(parameters, duration, temperature),
            _borders(parameters, duration, temperature),
            regimes(parameters, duration, temperature),
        )
    except RunEnded as ended:
        raise NotAMotion(f"{scenario.name}: {ended}") from None


def run_length(parameters: Parameters) -> float:
    """Run-up and what follows it, s."""
    return parameters.surface.run_up_time + max(SECONDS, PERIODS / parameters.natural_frequency)


def _borders(parameters: Parameters, duration: float, temperature: float) -> PretensionBorders:
    if parameters.rig.degrees_of_freedom == ("x",):
        return PretensionBorders(())
    return pretension_borders(parameters, duration, temperature)


def at_speed(parameters: Parameters, speed: float) -> Parameters:
    """The same rig on a surface of another speed; a block that starts with the surface's keeps it.

    The direction is that of the scenario.
    """
    speed = float(np.copysign(speed, parameters.surface.speed))
    surface = parameters.surface.model_copy(update={"speed": speed})
    initial = parameters.initial
    if initial.vx == parameters.surface.speed:
        initial = initial.model_copy(update={"vx": speed})
    return parameters.model_copy(update={"surface": surface, "initial": initial})
