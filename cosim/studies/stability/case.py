"""The scenario that the maps are drawn around."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from stickslip import Parameters
from stickslip.steady_motion import Assessment, Interface, assess

from cosim.scenario import Scenario

#: Length of a run after the surface has its speed, s, and in natural periods.
SECONDS, PERIODS = 20.0, 40.0


class NotAMotion(ValueError):
    """A scenario that has no stick-slip motion to be looked at; one line: what, what is allowed."""


@dataclass(frozen=True)
class Case:
    """A scenario's mechanics and the assessment of its own run.

    interface: what friction feels there, of belt and ice as cold as the air.
    """

    name: str
    parameters: Parameters
    interface: Interface
    assessment: Assessment


def case_of(scenario: Scenario) -> Case:
    """The scenario, looked at for itself. NotAMotion where there is nothing to look at."""
    parameters, interface = scenario.mechanics, Interface(scenario.ambient.temperature_degC)
    if fault := _fault(parameters):
        raise NotAMotion(f"{scenario.name}: {fault}")
    found = assess(parameters, scenario.run.duration, interface, look=lambda: None)
    if found is None:
        raise NotAMotion(
            f"{scenario.name}: run.duration = {scenario.run.duration:g} s: the motion ends early, "
            "or is over before five swings at constant speed; allowed is a longer run that can be "
            "followed"
        )
    return Case(scenario.name, parameters, interface, found)


def _fault(parameters: Parameters) -> str:
    """What keeps a rig from having steady motions that could be told apart, or nothing."""
    law = parameters.rate_and_state
    if parameters.surface.speed == 0.0:
        return "surface.speed = 0: needed is a surface that moves"
    if parameters.natural_frequency == 0.0:
        return "springs.stiffness = 0: needed are springs"
    if parameters.friction.mu_k == 0.0:
        return "friction.mu_k = 0: needed is friction in slip, for a map over mu_s/mu_k"
    if law.direct != 0.0 or law.evolution != 0.0:
        return "rate_and_state: its runs take too long to be repeated; leave it out"
    return ""


def run_length(parameters: Parameters) -> float:
    """Run-up and what follows it, s."""
    return parameters.surface.run_up_time + max(SECONDS, PERIODS / parameters.natural_frequency)


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
