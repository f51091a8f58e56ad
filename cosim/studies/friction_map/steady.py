"""One coupled run of a block that slides steadily: friction, and the temperature it came to.

Where friction falls with the speed, a block on springs swings of itself. Here guides keep it on its
line and a damper against the frame, three times what the falling friction drives, keeps it at rest
there, so that what is seen is the friction of one speed. A block at rest takes nothing from the
damper: neither friction nor its heat is another for it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from stickslip import Parameters, friction_coefficient
from stickslip.packing import GRAVITY

from cosim.coupling.case import run_scenario
from cosim.scenario import Scenario

#: Damping over what the fall of friction with the speed drives.
DAMPING = 3.0
#: Steady is friction that changes by less than this part in the last tenth of a run: the interface
#: warms for ever, like the root of the time.
STEADY = 1e-2
#: Step of speed, part of it, over which the fall of friction is taken.
NUDGE = 1e-4


class NotSteady(ValueError):
    """A case in which the block does not slide steadily; the message is one line."""


@dataclass(frozen=True)
class SteadySliding:
    """Steady sliding at the end of a coupled run.

    speed: of sliding, m/s. ambient_degC: of the air, from which belt and ice started.
    interface_degC: what friction has made of it. friction: coefficient of the run; law: that of the
    friction law at the ambient temperature, without any heating. melt_rate: kg/s. energy_residual:
    of the mechanics, part of the friction heat.
    """

    speed: float
    ambient_degC: float
    interface_degC: float
    friction: float
    law: float
    melt_rate: float
    energy_residual: float


def steady_sliding(
    scenario: Scenario, speed: float, ambient_degC: float, duration: float
) -> SteadySliding:
    """Slide steadily on a belt of ``speed`` (m/s) in air of ``ambient_degC`` for ``duration`` (s).

    Raises NotSteady where the block sticks, swings or is carried away, ScenarioError for a speed,
    temperature or duration that cannot be.
    """
    case = steady_scenario(scenario, speed, ambient_degC, duration)
    run = run_scenario(case)
    where = f"{speed:g} m/s, {ambient_degC:g} degC"
    if run.result.status == "interrupted":
        raise KeyboardInterrupt  # which the coupled run keeps to itself, and a map of many must not
    if run.result.status != "complete":
        raise NotSteady(f"{where}: the coupled run gave up: {run.result.reason}")
    values = run.result
    friction = np.abs(values["mechanics.friction_force_x"]) / (case.rig.mass * GRAVITY)
    last = slice(-max(2, len(friction) // 10), None)
    if np.any(values["mechanics.mode"] == 0):
        raise NotSteady(f"{where}: the block comes to stick, in spite of guides and damper")
    if np.ptp(friction[last]) > STEADY * np.max(friction[last]):
        raise NotSteady(f"{where}: friction still changes after {duration:g} s")
    (law,) = friction_coefficient(case.mechanics, [speed], ambient_degC)
    return SteadySliding(
        speed=float(values["mechanics.sliding_speed"][-1]),
        ambient_degC=ambient_degC,
        interface_degC=float(values["thermal.interface_temperature"][-1]),
        friction=float(friction[-1]),
        law=float(law),
        melt_rate=float(values["thermal.melt_rate"][-1]),
        energy_residual=float(
            values["mechanics.energy_residual"][-1] / values["mechanics.heat"][-1]
        ),
    )


def steady_scenario(
    scenario: Scenario, speed: float, ambient_degC: float, duration: float
) -> Scenario:
    """The case of steady sliding: guided, damped, at its balance from the start."""
    changes: dict[str, Any] = {
        "surface.speed": speed,
        "surface.run_up_time": 0.0,
        "ambient.temperature_degC": ambient_degC,
        "rig.degrees_of_freedom": ("x",),
        "run.duration": duration,
        "run.output_interval": scenario.coupling.macro_step,
    }
    for name in ("x", "y", "phi", "vx", "vy", "omega"):
        changes[f"initial.{name}"] = 0.0
    case = scenario.changed(changes)
    force, fall = _friction(case.mechanics, speed, ambient_degC)
    reach = 4.0 * case.springs.stiffness * case.rig.spring_length
    if force >= reach:
        raise NotSteady(
            f"springs.stiffness = {case.springs.stiffness:g} N/m: friction of {force:.3g} N "
            "carries the block into the springs' anchors; allowed is what holds it within "
            f"rig.spring_length = {case.rig.spring_length:g} m"
        )
    return case.changed(
        {
            "initial.x": force / (4.0 * case.springs.stiffness),
            "structural_damping.coefficient": DAMPING * max(0.0, fall),
        }
    )


def _friction(parameters: Parameters, speed: float, temperature: float) -> tuple[float, float]:
    """Friction force (N) and how fast it falls with the speed (N s/m)."""
    load = parameters.rig.mass * GRAVITY
    step = NUDGE * speed
    here, faster = load * friction_coefficient(parameters, [speed, speed + step], temperature)
    return float(here), float(here - faster) / step
